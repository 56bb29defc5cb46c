//! What is wrong in a file: said behind a colon, before a full stop.

use lumen_message::messages;

pub use super::gltf::GltfProblem;
pub use super::ply::PlyProblem;
pub use super::stl::StlProblem;
pub use super::vtk::VtkProblem;

messages! {
    /// What is wrong in a place of a file.
    #[derive(Clone, Debug, PartialEq)]
    pub enum Problem {} or {
        /// Of any text.
        Text(TextProblem),
        /// Of STL.
        Stl(StlProblem),
        /// Of PLY.
        Ply(PlyProblem),
        /// Of glTF.
        Gltf(GltfProblem),
        /// Of VTK's surfaces.
        Vtk(VtkProblem),
        /// Of a scan or a mask.
        Scan(ScanProblem),
        /// Of VTK's images.
        Vti(VtiProblem),
        /// Of DICOM.
        Dicom(DicomProblem),
    }
}

messages! {
    /// What is wrong in a text. Words of the file are in quotes.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum TextProblem {
        "errors-no-number" NoNumber { word: String } => "{word} stands where a number should",
        "errors-no-coordinate" NoCoordinate { word: String } => "{word} stands where a coordinate should",
        "errors-no-vertex" NoVertex { word: String } => "{word} stands where a vertex number should",
        "errors-no-count" NoCount { word: String } => "{word} is no count",
        "errors-no-type" NoType { word: String } => "{word} is no type of number",
        "errors-no-text" NoText => "it should be a text and is not",
        "errors-obj-vertex" ShortVertex => "a vertex needs three coordinates",
    }
}

messages! {
    /// What is wrong in the file of a volume.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum ScanProblem {
        "scan-packed" Packed { needed: u64, bytes: u64 } =>
            "it announces {needed} bytes, more than its {bytes} compressed bytes can hold: it is cut short or damaged",
        "scan-packed-damaged" PackedDamaged => "its compressed data are cut short or damaged",
        "scan-header-endless" EndlessHeader => "its header does not end with an empty line",
        "scan-header-lacks" HeaderLacks { key: &'static str } => "its header has no \"{key}\"",
        "scan-header-none" NoHeader => "its header is none",
        "scan-not-numbers" NotNumbers { key: &'static str, count: usize } => "\"{key}\" is not {count} numbers",
        "scan-no-data-file" NoDataFile { key: &'static str } => "its header does not say where the numbers are ({key})",
        "scan-axes" Axes { axes: i64 } => "it has {axes} axes",
        "scan-many-labels" ManyLabels { most: usize } => "its layers hold more than {most} labels, the most that a map can have",
    }
}

messages! {
    /// What is wrong in a file of image data.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum VtiProblem {
        "scan-vti-wrong" Wrong { name: &'static str } => "\"{name}\" is wrong",
        "scan-vti-no-element" NoElement { name: &'static str } => "it has no element \"{name}\"",
        "scan-vti-no-points" NoPoints => "it does not say how many points there are",
        "scan-vti-no-array" NoArray => "it has no array of one number for each point or cell",
    }
}

messages! {
    /// What is wrong in a series of DICOM.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum DicomProblem {
        "scan-dicom-header" Header => "a file ends within its header",
        "scan-dicom-damaged" Damaged => "the elements of a file are damaged",
        "scan-dicom-cut-short" CutShort => "a file ends within one of its elements",
        "scan-dicom-pixels" Pixels => "a slice has fewer pixels than rows times columns",
        "scan-dicom-jpeg" Jpeg => "the JPEG picture of a slice is damaged, or of a kind that is not read",
        "scan-dicom-jpeg-size" JpegSize => "the JPEG picture of a slice is not of the size that the file says",
        "scan-dicom-no-directions" NoDirections => "it does not say which way its slices lie",
        "scan-dicom-no-spacing" NoSpacing => "it does not say how far apart its pixels are",
        "scan-dicom-no-places" NoPlaces => "it does not say where its slices are",
        "scan-dicom-no-slice" NoSlice => "none of its files holds a slice in shades of grey",
        "scan-dicom-colours" Colours => "its pictures are in colours, and a surface takes shades of grey",
        "scan-dicom-single" SingleSlice => "it holds a single slice, and a surface takes two or more",
    }
}
