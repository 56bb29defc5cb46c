//! Which format files are, and what the header among them says.

use super::super::detect::{self, Volume as Content};
use super::error::ScanError;
use super::outline::Outline;
use super::parts::Head;
use super::{metaimage, nifti, nrrd, numbers};

/// Whether a file is a volume, or the header of one, by its first bytes.
pub fn is_volume(bytes: &[u8]) -> bool {
    content(bytes).is_some()
}

/// The name of the file in which the numbers of a header stand, if `bytes` is a header that names one.
pub fn data_name(bytes: &[u8], name: &str) -> Option<String> {
    match content(bytes)? {
        Content::MetaImage => metaimage::data_name(bytes),
        Content::Nrrd => nrrd::data_name(bytes),
        Content::Nifti => nifti::data_name(bytes, name),
        Content::Vti | Content::Dicom => None,
    }
}

/// How a volume is read.
pub(super) enum Way {
    /// Piece by piece, by what its header says.
    Pieces(Box<Outline>),
    /// Whole, as VTI.
    Vti,
    /// Whole, slice by slice, as DICOM.
    Dicom,
}

impl Way {
    /// That of the volume whose header is the file `at` of these.
    pub(super) fn of(content: Content, at: usize, heads: &[Head]) -> Result<Self, ScanError> {
        let outline = match content {
            Content::Nifti => nifti::outline(at, heads),
            Content::Nrrd => nrrd::outline(at, heads),
            Content::MetaImage => metaimage::outline(at, heads),
            Content::Vti => return Ok(Self::Vti),
            Content::Dicom => return Ok(Self::Dicom),
        };
        Ok(Self::Pieces(Box::new(outline?)))
    }
}

/// What the first bytes say; of a packed file, those that it unfolds to.
pub(super) fn content(bytes: &[u8]) -> Option<Content> {
    if numbers::is_gzip(bytes) && nifti::is_header(&numbers::first_unfolded(bytes)) {
        return Some(Content::Nifti);
    }
    detect::volume(bytes).filter(|&found| found != Content::Nifti || nifti::is_header(bytes))
}
