//! What a file is: by its content first, by its extension where the content does not say.

use super::error::ReadError;
use super::formats::{FileKind, KINDS, Sign};
use super::{text, vtk};

/// A kind of file that holds a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Volume {
    Nifti,
    Nrrd,
    MetaImage,
    Vti,
    Dicom,
}

impl Volume {
    /// That a file is one, where a surface is wanted.
    fn refused(self) -> ReadError {
        let format = match self {
            Self::Nifti => "NIfTI",
            Self::Nrrd => "NRRD",
            Self::MetaImage => "MetaImage",
            Self::Vti => "VTK image data",
            Self::Dicom => "DICOM",
        };
        ReadError::ImageVolume { format }
    }
}

/// What a file packed by gzip begins with.
pub(super) const GZIP: &[u8] = b"\x1f\x8b";

/// Bytes of a file that say what it is, if it is not packed.
pub(super) const SNIFFED: usize = 4096;

/// Finds the kind of file, or says in a sentence why it is none that can be opened.
pub(super) fn detect(bytes: &[u8], name: &str) -> Result<&'static FileKind, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::Empty);
    }
    let by_sign = |wanted: Sign| {
        KINDS.into_iter().find(|kind| kind.signs.iter().any(|&(sign, stands)| sign == wanted && stands(bytes)))
    };
    if let Some(kind) = by_sign(Sign::Sure) {
        return Ok(kind);
    }
    refuse(bytes, name)?;
    if let Some(kind) = by_sign(Sign::Begins) {
        return Ok(kind);
    }
    let extension = name.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_ascii_lowercase());
    if let Some(kind) = KINDS.into_iter().find(|kind| kind.extensions.contains(&extension.as_str())) {
        return Ok(kind);
    }
    match extension.as_str() {
        "vti" => Err(Volume::Vti.refused()),
        "nii" | "hdr" | "img" => Err(Volume::Nifti.refused()),
        "mha" | "mhd" => Err(Volume::MetaImage.refused()),
        "nrrd" | "nhdr" => Err(Volume::Nrrd.refused()),
        "dcm" | "dicom" | "ima" => Err(Volume::Dicom.refused()),
        _ => by_sign(Sign::Resembles).ok_or_else(|| ReadError::unknown(name)),
    }
}

/// Refuses what begins as an archive or a volume.
fn refuse(bytes: &[u8], name: &str) -> Result<(), ReadError> {
    if bytes.starts_with(GZIP) {
        if name.to_ascii_lowercase().ends_with(".nii.gz") {
            return Err(Volume::Nifti.refused());
        }
        return Err(ReadError::Compressed { format: "gzip" });
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(ReadError::Compressed { format: "zip" });
    }
    // VTK's begin as its surfaces do, whose reader knows them apart.
    match volume(bytes).filter(|&found| found != Volume::Vti) {
        Some(found) => Err(found.refused()),
        None => Ok(()),
    }
}

/// Whether a file that begins with `head`, its first 4096 bytes, can hold a volume and no surface. What is packed by gzip
/// may: no surface is. It does without the readers of volumes, which say in the end whether it does.
pub fn may_be_volume(head: &[u8]) -> bool {
    volume(head).is_some() || head.starts_with(GZIP)
}

/// The volume that a file which is not packed begins as, or the header of one.
pub(super) fn volume(bytes: &[u8]) -> Option<Volume> {
    let stands = |magic: &[u8], at: usize| bytes.get(at..at + magic.len()) == Some(magic);
    if stands(b"n+1\0", 344) || stands(b"ni1\0", 344) || stands(b"n+2\0", 4) || stands(b"ni2\0", 4) {
        return Some(Volume::Nifti);
    }
    if analyze(bytes).is_some() {
        return Some(Volume::Nifti);
    }
    if stands(b"NRRD000", 0) {
        return Some(Volume::Nrrd);
    }
    if behind_preamble(bytes).len() < bytes.len() || data_set(bytes).is_some() {
        return Some(Volume::Dicom);
    }
    let head = text::beginning(&bytes[..bytes.len().min(SNIFFED)]);
    let contains = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    if vtk::is_legacy(head) {
        return legacy_kind(head)
            .is_some_and(|kind| kind.eq_ignore_ascii_case(b"structured_points"))
            .then_some(Volume::Vti);
    }
    if vtk::is_xml(head) {
        return xml_kind(head).is_some_and(|kind| kind == b"ImageData").then_some(Volume::Vti);
    }
    let begins = [&b"ObjectType"[..], b"NDims", b"Comment"].iter().any(|word| head.starts_with(word));
    (begins && contains(b"DimSize")).then_some(Volume::MetaImage)
}

/// The type that the element `VTKFile` in the head of an XML file has.
fn xml_kind(head: &[u8]) -> Option<&[u8]> {
    let tag = head.windows(8).position(|part| part == b"<VTKFile")? + 8;
    let tag = head[tag..].split(|&byte| byte == b'>').next()?;
    let words = tag.split(|&byte| matches!(byte, b'"' | b'\'')).collect::<Vec<_>>();
    let named =
        |pair: &&[&[u8]]| pair[0].trim_ascii().strip_suffix(b"=").is_some_and(|name| name.trim_ascii() == b"type");
    words.chunks_exact(2).find(named).map(|pair| pair[1])
}

/// The word behind `DATASET` in the head of a legacy VTK file, whose second line is a title of any words.
fn legacy_kind(head: &[u8]) -> Option<&[u8]> {
    let body = head.splitn(3, |&byte| byte == b'\n').nth(2)?;
    let mut words = body.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.find(|word| word.eq_ignore_ascii_case(b"dataset"))?;
    words.next()
}

/// Whether bytes are a header of Analyze 7.5, which has no word to know it by, and if so whether it is big-endian: its length,
/// dimensions, and bits that fit the type of its numbers.
pub(super) fn analyze(bytes: &[u8]) -> Option<bool> {
    const LENGTH: usize = 348;
    let header = bytes.get(..LENGTH)?;
    let is_big_endian = match header {
        [0x5C, 1, 0, 0, ..] => false,
        [0, 0, 1, 0x5C, ..] => true,
        _ => return None,
    };
    let short = |at: usize| {
        let word = [header[at], header[at + 1]];
        if is_big_endian { i16::from_be_bytes(word) } else { i16::from_le_bytes(word) }
    };
    let axes = short(40);
    let are_sizes = (1..=7).contains(&axes) && (1..=axes).all(|axis| short(40 + 2 * axis as usize) > 0);
    let is_type = matches!((short(70), short(72)), (2 | 256, 8) | (4 | 512, 16) | (8 | 16 | 768, 32) | (64, 64));
    let is_nifti = [&b"n+1\0"[..], b"ni1\0"].contains(&&header[344..]);
    (are_sizes && is_type && !is_nifti).then_some(is_big_endian)
}

/// A DICOM file behind its preamble, which some leave out.
pub(super) fn behind_preamble(bytes: &[u8]) -> &[u8] {
    match bytes {
        [b'D', b'I', b'C', b'M', rest @ ..] => rest,
        _ => bytes.get(128..).and_then(|rest| rest.strip_prefix(b"DICM")).unwrap_or(bytes),
    }
}

/// How the elements of a DICOM data set are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DataSet {
    Explicit,
    BigEndian,
    Implicit,
}

/// How bytes are written that look as the first two elements of a data set, or of what a file says of itself: one of the
/// first groups, in order, and as long as such elements are.
pub(super) fn data_set(bytes: &[u8]) -> Option<DataSet> {
    let element = |way: DataSet, at: usize| {
        let &[a, b, c, d, e, f, g, h] = bytes.get(at..)?.first_chunk()?;
        let short = |two| if way == DataSet::BigEndian { u16::from_be_bytes(two) } else { u16::from_le_bytes(two) };
        let tag = (short([a, b]), short([c, d]));
        let is_named = e.is_ascii_uppercase() && f.is_ascii_uppercase();
        let length = match way {
            DataSet::Implicit => u32::from_le_bytes([e, f, g, h]),
            _ if !is_named => return None,
            // Those whose length takes four bytes are no text, and few of them come first.
            _ if matches!(&[e, f], b"OB" | b"UN") => u32::from(*bytes.get(at + 8)?) + 4,
            _ => short([g, h]).into(),
        };
        (tag.0 <= 0x20 && length < 1 << 10).then_some((tag, at + 8 + length as usize))
    };
    [DataSet::Explicit, DataSet::BigEndian, DataSet::Implicit].into_iter().find(|&way| {
        let first = element(way, 0);
        let second = first.and_then(|(_, next)| element(way, next));
        matches!((first, second), (Some((first, _)), Some((second, _))) if matches!(first.0, 2 | 8) && first < second)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_wins_over_the_extension() {
        let kind = |bytes: &[u8], name: &str| detect(bytes, name).unwrap().label;
        assert_eq!(kind(b"ply\nformat ascii 1.0\n", "a.stl"), "PLY");
        assert_eq!(kind(b"\xef\xbb\xbfSOLID x\n facet", "a.obj"), "STL");
        assert_eq!(kind(b"{\"asset\":{}}", "a"), "glTF");
        assert_eq!(kind(b"# a cube\nv 1 2 3\n", "cube"), "OBJ");
        assert_eq!(kind(b"# vtk DataFile Version 3.0\n", "a.obj"), "VTK");
        assert_eq!(kind(b"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "a"), "VTP");
    }

    #[test]
    fn volumes_are_told_from_surfaces() {
        let mut dicom = [0; 200];
        dicom[128..132].copy_from_slice(b"DICM");
        let image = b"<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\">";
        let nifti_2 = b"\x1c\x02\0\0n+2\0\r\n\x1a\n";
        let meta = b"ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_SHORT";
        for head in [&dicom[..], image, nifti_2, meta, b"NRRD0004\n", b"\x1f\x8b\x08"] {
            assert!(may_be_volume(head), "{head:?}");
        }
        let legacy = |title: &str, kind: &str| format!("# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET {kind}\n");
        assert!(may_be_volume(legacy("", "Structured_Points").as_bytes()));
        for title in ["from structured_points", "DATASET STRUCTURED_POINTS"] {
            assert!(!may_be_volume(legacy(title, "POLYDATA").as_bytes()));
        }
        let surface = b"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">";
        let named = b"<VTKFile type=\"PolyData\"><DataArray Name=\"ImageData\"/>";
        assert!(may_be_volume(b"<VTKFile version='1.0' type = 'ImageData'>"));
        for head in [&surface[..], named, b"ply\nformat ascii 1.0\n", b"solid", b"PK\x03\x04", b"", b"{\"a\": 1}"] {
            assert!(!may_be_volume(head), "{head:?}");
        }
    }

    #[test]
    fn what_is_no_surface_is_named() {
        assert_eq!(detect(b"", "a.stl"), Err(ReadError::Empty));
        assert_eq!(detect(b"Dear colleague", "letter"), Err(ReadError::unknown("letter")));
        assert_eq!(detect(b"\x1f\x8b\x08", "a.nii.gz"), Err(ReadError::ImageVolume { format: "NIfTI" }));
        assert_eq!(detect(b"\x1f\x8b\x08", "a.stl.gz"), Err(ReadError::Compressed { format: "gzip" }));
        assert_eq!(detect(b"PK\x03\x04", "a.stl"), Err(ReadError::Compressed { format: "zip" }));
        let nifti = [&[0u8; 344][..], b"n+1\0"].concat();
        let dicom = [&[0u8; 128][..], b"DICM"].concat();
        let meta = b"NDims = 3\nDimSize = 2 2 2\n".to_vec();
        let nrrd = b"NRRD0005\n".to_vec();
        for (bytes, format) in [(nifti, "NIfTI"), (dicom, "DICOM"), (nrrd, "NRRD"), (meta, "MetaImage")] {
            assert_eq!(detect(&bytes, "a.stl"), Err(ReadError::ImageVolume { format }));
        }
    }
}
