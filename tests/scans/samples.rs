//! One small volume, and writers of it that share nothing with the readers but the formats' descriptions.
//!
//! It lies obliquely: its columns run by (3, 4, 0) / 5, its rows by (-4, 3, 0) / 5, its slices up, so that every number can be
//! written down exactly.

use flate2::Compression;
use flate2::read::{GzEncoder, ZlibEncoder};
use lumen::io::LabelName;
use lumen::io::volume::Scan;
use std::io::Read;

/// Points along the axes.
pub(crate) const SIZE: [usize; 3] = [6, 5, 4];
/// The steps along them, in LPS mm: spacings of 0.5, 0.75 and 2 mm.
pub(crate) const STEPS: [[f64; 3]; 3] = [[0.3, 0.4, 0.0], [-0.6, 0.45, 0.0], [0.0, 0.0, 2.0]];
/// The place of the first point, in LPS mm.
pub(crate) const ORIGIN: [f64; 3] = [-10.0, 20.0, 300.0];

/// What a segmentation calls a label.
pub(crate) fn label_name(value: i64, name: &str, colour: Option<[u8; 3]>) -> LabelName {
    LabelName { value, name: name.to_owned(), colour }
}

/// The value of a point.
pub(crate) fn value([i, j, k]: [usize; 3]) -> i16 {
    (i + 10 * j + 100 * k) as i16 - 150
}

/// All points, i running fastest.
pub(crate) fn points() -> impl Iterator<Item = [usize; 3]> {
    let [ni, nj, nk] = SIZE;
    (0..nk).flat_map(move |k| (0..nj).flat_map(move |j| (0..ni).map(move |i| [i, j, k])))
}

/// All values in little-endian order.
pub(crate) fn little() -> Vec<u8> {
    points().flat_map(|point| value(point).to_le_bytes()).collect()
}

/// All values in big-endian order.
pub(crate) fn big() -> Vec<u8> {
    points().flat_map(|point| value(point).to_be_bytes()).collect()
}

pub(crate) fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    GzEncoder::new(bytes, Compression::best()).read_to_end(&mut out).unwrap();
    out
}

pub(crate) fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    ZlibEncoder::new(bytes, Compression::best()).read_to_end(&mut out).unwrap();
    out
}

/// Numbers as text.
pub(crate) fn ascii() -> String {
    points().map(|point| format!("{} ", value(point))).collect()
}

/// Asserts that a volume is the one of this file, in values and in place.
pub(crate) fn assert_is_it(scan: &Scan, what: &str) {
    let geometry = scan.grid.geometry();
    assert_eq!(geometry.size, SIZE, "{what}");
    for point in points() {
        assert_eq!(scan.grid.value(point), f64::from(value(point)), "{what} at {point:?}");
        let [i, j, k] = point.map(|index| index as f64);
        let place = geometry.at(i, j, k).to_array();
        for axis in 0..3 {
            let expected = ORIGIN[axis] + i * STEPS[0][axis] + j * STEPS[1][axis] + k * STEPS[2][axis];
            // NIfTI and some others keep 32 bits.
            assert!((place[axis] - expected).abs() < 1e-4, "{what} at {point:?}: {place:?}");
        }
    }
}

/// A header of MetaImage up to the place of its numbers.
pub(crate) fn metaimage(extra: &str, data: &str) -> String {
    format!(
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nAnatomicalOrientation = RAI\n{extra}TransformMatrix = 0.6 0.8 0 -0.8 0.6 0 0 0 1\n\
         Offset = -10 20 300\nElementSpacing = 0.5 0.75 2\nDimSize = 6 5 4\nElementType = MET_SHORT\n\
         ElementDataFile = {data}\n"
    )
}

/// The same with a fourth axis of so many entries.
pub(crate) fn metaimage_of_four(entries: &str) -> String {
    metaimage("", "LOCAL")
        .replace("NDims = 3", "NDims = 4")
        .replace("0.6 0.8 0 -0.8 0.6 0 0 0 1", "0.6 0.8 0 0 -0.8 0.6 0 0 0 0 1 0 0 0 0 1")
        .replace("-10 20 300", "-10 20 300 0")
        .replace("0.5 0.75 2", "0.5 0.75 2 1")
        .replace("6 5 4", &format!("6 5 4 {entries}"))
}

/// A header of NRRD without its last, empty line.
pub(crate) fn nrrd(encoding: &str, extra: &str) -> String {
    format!(
        "NRRD0004\n# made for a test\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 6 5 4\n\
         space directions: (0.3,0.4,0) (-0.6,0.45,0) (0,0,2)\nkinds: domain domain domain\nendian: little\n\
         encoding: {encoding}\nspace origin: (-10,20,300)\nkey:=value: of a writer\n{extra}"
    )
}

/// The words of a header of NIfTI, in one byte order or the other.
pub(crate) struct Nifti {
    bytes: Vec<u8>,
    is_big: bool,
}

impl Nifti {
    fn put(&mut self, at: usize, little: &[u8]) {
        let target = &mut self.bytes[at..at + little.len()];
        target.copy_from_slice(little);
        if self.is_big {
            target.reverse();
        }
    }

    /// The first version, its place by the matrix or by the quaternion.
    pub(crate) fn first(is_big: bool, by_matrix: bool, magic: &[u8; 4], offset: f32) -> Vec<u8> {
        let mut header = Self { bytes: vec![0; 352], is_big };
        header.put(0, &348i32.to_le_bytes());
        for (index, n) in [3i16, 6, 5, 4, 1, 1, 1, 1].into_iter().enumerate() {
            header.put(40 + 2 * index, &n.to_le_bytes());
        }
        header.put(70, &4i16.to_le_bytes());
        header.put(72, &16i16.to_le_bytes());
        // In metres, to see that the unit is heard.
        let unit = if by_matrix { 1.0 } else { 0.001 };
        for (index, n) in [1.0, 0.5, 0.75, 2.0].into_iter().enumerate() {
            header.put(76 + 4 * index, &(n * unit as f32).to_le_bytes());
        }
        header.put(108, &offset.to_le_bytes());
        header.bytes[123] = if by_matrix { 2 } else { 1 };
        if by_matrix {
            header.put(254, &1i16.to_le_bytes());
            for (index, n) in matrix().into_iter().flatten().enumerate() {
                header.put(280 + 4 * index, &(n as f32).to_le_bytes());
            }
        } else {
            header.put(252, &1i16.to_le_bytes());
            // In RAS the columns are (-3, -4, 0) / 5 and (4, -3, 0) / 5: a turn around z whose cosine is -0.6 and whose sine
            // -0.8; of half of it cos 0.447 and sin 0.894, negative.
            let quaternion = [0.0, 0.0, -(0.8f64.sqrt()), 10.0 * unit, -20.0 * unit, 300.0 * unit];
            for (index, n) in quaternion.into_iter().enumerate() {
                header.put(256 + 4 * index, &(n as f32).to_le_bytes());
            }
        }
        header.bytes[344..348].copy_from_slice(magic);
        header.bytes
    }

    /// The second version.
    pub(crate) fn second() -> Vec<u8> {
        let mut header = Self { bytes: vec![0; 544], is_big: false };
        header.put(0, &540i32.to_le_bytes());
        header.bytes[4..12].copy_from_slice(b"n+2\0\r\n\x1a\n");
        header.put(12, &4i16.to_le_bytes());
        for (index, n) in [3i64, 6, 5, 4, 1, 1, 1, 1].into_iter().enumerate() {
            header.put(16 + 8 * index, &n.to_le_bytes());
        }
        for (index, n) in [1.0f64, 0.5, 0.75, 2.0].into_iter().enumerate() {
            header.put(104 + 8 * index, &n.to_le_bytes());
        }
        header.put(168, &544i64.to_le_bytes());
        header.put(348, &1i32.to_le_bytes());
        for (index, n) in matrix().into_iter().flatten().enumerate() {
            header.put(400 + 8 * index, &n.to_le_bytes());
        }
        header.put(500, &2i32.to_le_bytes());
        header.bytes
    }
}

/// From the axes of the volume to RAS, row by row.
fn matrix() -> [[f64; 4]; 3] {
    let sign = [-1.0, -1.0, 1.0];
    std::array::from_fn(|row| [STEPS[0][row], STEPS[1][row], STEPS[2][row], ORIGIN[row]].map(|n| n * sign[row]))
}

/// A file of VTK's image data; `array` is the attributes of the element of its numbers and what is in it.
pub(crate) fn vti(attributes: &str, array: &str, appended: &[u8]) -> Vec<u8> {
    let mut file = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" {attributes}>\n\
         <ImageData WholeExtent=\"2 7 0 4 0 3\" Origin=\"-10.6 19.2 300\" Spacing=\"0.5 0.75 2\"\n\
         Direction=\"0.6 -0.8 0 0.8 0.6 0 0 0 1\"><Piece Extent=\"2 7 0 4 0 3\">\n\
         <PointData Scalars=\"CT\"><DataArray type=\"UInt8\" Name=\"other\" format=\"ascii\">1 2 3</DataArray>\n\
         <DataArray type=\"Int16\" Name=\"CT\" {array}</DataArray></PointData>\n<CellData></CellData></Piece></ImageData>\n"
    )
    .into_bytes();
    if !appended.is_empty() {
        file.extend(b"<AppendedData encoding=\"raw\">\n _");
        file.extend(appended);
        file.extend(b"\n</AppendedData>\n");
    }
    file.extend(b"</VTKFile>\n");
    file
}

/// Every way to write the volume, each as its files.
pub(crate) fn all() -> Vec<(&'static str, crate::Files)> {
    let joined = |header: &str, data: &[u8]| [header.as_bytes(), data].concat();
    let raw = little();
    let mut ways = vec![
        ("mha", vec![("a.mha", joined(&metaimage("", "LOCAL"), &raw))]),
        ("mha of zlib", vec![("a.mha", joined(&metaimage("CompressedData = True\n", "LOCAL"), &zlib(&raw)))]),
        ("mha of text", {
            let header = metaimage("", "LOCAL").replace("BinaryData = True", "BinaryData = False");
            vec![("a.mha", joined(&header, ascii().as_bytes()))]
        }),
        ("mhd", {
            let header = metaimage("BinaryDataByteOrderMSB = True\nHeaderSize = -1\n", "folder/a.raw");
            vec![("b/a.raw", [b"before".to_vec(), big()].concat()), ("b/a.mhd", header.into_bytes())]
        }),
        ("mha of four axes", vec![("a.mha", joined(&metaimage_of_four("1"), &raw))]),
        ("nrrd", vec![("a.nrrd", joined(&nrrd("raw", "\n"), &raw))]),
        ("nrrd of a list of one", {
            let header = nrrd("raw", "\n").replace("dimension: 3", "dimension: 4").replace("sizes: ", "sizes: 1 ");
            let header = header.replace("directions: ", "directions: none ").replace("kinds: ", "kinds: list ");
            vec![("a.nrrd", joined(&header, &raw))]
        }),
        // As ITK writes four axes.
        ("nrrd of four axes", {
            let header = nrrd("raw", "\n").replace("dimension: 3", "dimension: 4\nspace dimension: 4");
            let header = header
                .replace("sizes: 6 5 4", "sizes: 6 5 4 1")
                .replace("posterior-superior", "posterior-superior-time");
            let header = header
                .replace("(0.3,0.4,0) (-0.6,0.45,0) (0,0,2)", "(0.3,0.4,0,0) (-0.6,0.45,0,0) (0,0,2,0) (0,0,0,1)");
            vec![("a.nrrd", joined(&header.replace("20,300)", "20,300,0)"), &raw))]
        }),
        ("nrrd in RAS", {
            let header = nrrd("gzip", "\n")
                .replace("left-posterior-superior", "RAS")
                .replace("(0.3,0.4,0) (-0.6,0.45,0)", "(-0.3,-0.4,0) (0.6,-0.45,0)")
                .replace("(-10,20,300)", "(10,-20,300)");
            vec![("a.nrrd", joined(&header, &gzip(&raw)))]
        }),
        ("nhdr", {
            let header = nrrd("text", "line skip: 2\ndata file: a.txt\n");
            vec![("a.nhdr", header.into_bytes()), ("a.txt", format!("two\nlines\n{}", ascii()).into_bytes())]
        }),
        ("nhdr, big", {
            let header = nrrd("raw", "byte skip: 3\ndata file: a.raw\n").replace("endian: little", "endian: big");
            vec![("a.nhdr", header.into_bytes()), ("A.RAW", [b"abc".to_vec(), big()].concat())]
        }),
        ("nii", vec![("a.nii", [Nifti::first(false, true, b"n+1\0", 352.0), raw.clone()].concat())]),
        ("nii, big, by quaternion", { vec![("a.nii", [Nifti::first(true, false, b"n+1\0", 352.0), big()].concat())] }),
        ("nii.gz", vec![("a.nii.gz", gzip(&[Nifti::first(false, true, b"n+1\0", 352.0), raw.clone()].concat()))]),
        ("hdr and img", {
            vec![("a.img", raw.clone()), ("a.hdr", Nifti::first(false, true, b"ni1\0", 0.0)[..348].to_vec())]
        }),
        ("nii of version 2", vec![("a.nii", [Nifti::second(), raw.clone()].concat())]),
        ("vti of cells", {
            let text = String::from_utf8(vti("", &format!("format=\"ascii\">{}", ascii()), b"")).unwrap();
            // The same numbers between one point more along each axis, half a step before them.
            let text = text.replace("2 7 0 4 0 3", "2 8 0 5 0 4").replace("-10.6 19.2 300", "-10.45 18.775 299");
            let text = text.replace("<CellData></CellData>", "").replace("PointData", "CellData");
            vec![("a.vti", text.into_bytes())]
        }),
        ("vti of text", vec![("a.vti", vti("", &format!("format=\"ascii\">{}", ascii()), b""))]),
    ];
    let length = (raw.len() as u64).to_le_bytes();
    let appended = [&length[..], &raw].concat();
    ways.push((
        "vti, raw",
        vec![("a.vti", vti("header_type=\"UInt64\"", "format=\"appended\" offset=\"0\">", &appended))],
    ));
    let packed = zlib(&raw);
    let header = [1, raw.len(), 0, packed.len()].map(|n| (n as u32).to_le_bytes()).concat();
    ways.push((
        "vti, packed",
        vec![(
            "a.vti",
            vti(
                "compressor=\"vtkZLibDataCompressor\"",
                "format=\"appended\" offset=\"0\">",
                &[header, packed].concat(),
            ),
        )],
    ));
    ways.extend(crate::dicom::all());
    ways
}

/// Writes the samples of one file into the folder that `LUMEN_SEEDS` names: `cargo xtask fuzz-files` begins with them.
#[test]
fn seeds_are_written_where_they_are_asked_for() {
    let Some(folder) = std::env::var_os("LUMEN_SEEDS") else { return };
    let folder = std::path::Path::new(&folder).join("scan");
    std::fs::create_dir_all(&folder).unwrap();
    for (i, (_, files)) in all().into_iter().enumerate() {
        if let [(_, bytes)] = &files[..] {
            std::fs::write(folder.join(format!("seed-{i:02}")), bytes).unwrap();
        }
    }
}
