//! What a file is: by its content first, by its extension where the content does not say.

use super::error::ReadError;
use super::{obj, stl, text, vtk};

/// A kind of file that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    Stl,
    Ply,
    Obj,
    /// VTK's XML.
    Vtp,
    /// VTK's legacy format.
    Vtk,
    Glb,
    Gltf,
}

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

/// Finds the kind of file, or says in a sentence why it is none that can be opened.
pub(super) fn detect(bytes: &[u8], name: &str) -> Result<Content, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::Empty);
    }
    // A binary STL may begin with anything at all, "solid" and "ply" included; its length gives it away.
    if stl::has_binary_length(bytes) {
        return Ok(Content::Stl);
    }
    if let Some(content) = by_magic(bytes, name)? {
        return Ok(content);
    }
    let extension = name.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_ascii_lowercase());
    match extension.as_str() {
        "stl" => Ok(Content::Stl),
        "ply" => Ok(Content::Ply),
        "obj" => Ok(Content::Obj),
        "glb" => Ok(Content::Glb),
        "gltf" => Ok(Content::Gltf),
        "vtp" | "vtu" => Ok(Content::Vtp),
        "vtk" => Ok(Content::Vtk),
        "vti" => Err(Volume::Vti.refused()),
        "nii" | "hdr" | "img" => Err(Volume::Nifti.refused()),
        "mha" | "mhd" => Err(Volume::MetaImage.refused()),
        "nrrd" | "nhdr" => Err(Volume::Nrrd.refused()),
        "dcm" | "dicom" | "ima" => Err(Volume::Dicom.refused()),
        _ if obj::looks_like(bytes) => Ok(Content::Obj),
        _ => Err(ReadError::Unknown { name: name.to_owned() }),
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
    if stands(b"NRRD000", 0) {
        return Some(Volume::Nrrd);
    }
    if stands(b"DICM", 128) {
        return Some(Volume::Dicom);
    }
    let head = text::without_mark(bytes).trim_ascii_start();
    let head = &head[..head.len().min(4096)];
    let contains = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    if vtk::is_xml(head) {
        return contains(b"\"ImageData\"").then_some(Volume::Vti);
    }
    let begins = [&b"ObjectType"[..], b"NDims", b"Comment"].iter().any(|word| head.starts_with(word));
    (begins && contains(b"DimSize")).then_some(Volume::MetaImage)
}

/// What the first bytes say, or `None` where they say nothing.
fn by_magic(bytes: &[u8], name: &str) -> Result<Option<Content>, ReadError> {
    if bytes.starts_with(b"glTF") {
        return Ok(Some(Content::Glb));
    }
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
    if let Some(found) = volume(bytes).filter(|&found| found != Volume::Vti) {
        return Err(found.refused());
    }
    let text = text::without_mark(bytes).trim_ascii_start();
    let begins_with = |word: &[u8]| text.len() >= word.len() && text[..word.len()].eq_ignore_ascii_case(word);
    let contains = |word: &[u8]| text[..text.len().min(1024)].windows(word.len()).any(|part| part == word);
    if begins_with(b"ply\n") || begins_with(b"ply\r") {
        return Ok(Some(Content::Ply));
    }
    if vtk::is_legacy(text) {
        return Ok(Some(Content::Vtk));
    }
    if vtk::is_xml(text) {
        return Ok(Some(Content::Vtp));
    }
    if begins_with(b"solid") && text::is_text(text) {
        return Ok(Some(Content::Stl));
    }
    if begins_with(b"{") && contains(b"\"") {
        return Ok(Some(Content::Gltf));
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_wins_over_the_extension() {
        assert_eq!(detect(b"ply\nformat ascii 1.0\n", "a.stl"), Ok(Content::Ply));
        assert_eq!(detect(b"\xef\xbb\xbfSOLID x\n facet", "a.obj"), Ok(Content::Stl));
        assert_eq!(detect(b"{\"asset\":{}}", "a"), Ok(Content::Gltf));
        assert_eq!(detect(b"# a cube\nv 1 2 3\n", "cube"), Ok(Content::Obj));
        assert_eq!(detect(b"# vtk DataFile Version 3.0\n", "a.obj"), Ok(Content::Vtk));
        assert_eq!(detect(b"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "a"), Ok(Content::Vtp));
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
        let surface = b"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">";
        for head in [&surface[..], b"ply\nformat ascii 1.0\n", b"solid", b"PK\x03\x04", b"", b"{\"a\": 1}"] {
            assert!(!may_be_volume(head), "{head:?}");
        }
    }

    #[test]
    fn what_is_no_surface_is_named() {
        assert_eq!(detect(b"", "a.stl"), Err(ReadError::Empty));
        assert_eq!(detect(b"Dear colleague", "letter"), Err(ReadError::Unknown { name: "letter".to_owned() }));
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
