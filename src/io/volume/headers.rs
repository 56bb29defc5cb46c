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

/// What the header says that is the file `at` of these, of a format whose numbers can be read piece by piece.
pub(super) fn outline(content: Content, at: usize, heads: &[Head]) -> Option<Result<Outline, ScanError>> {
    match content {
        Content::Nifti => Some(nifti::outline(at, heads)),
        Content::Nrrd => Some(nrrd::outline(at, heads)),
        Content::MetaImage => Some(metaimage::outline(at, heads)),
        Content::Vti | Content::Dicom => None,
    }
}

/// What the first bytes say; of a packed file, those that it unfolds to.
pub(super) fn content(bytes: &[u8]) -> Option<Content> {
    if numbers::is_gzip(bytes) && nifti::is_header(&numbers::first_unfolded(bytes)) {
        return Some(Content::Nifti);
    }
    detect::volume(bytes).filter(|&found| found != Content::Nifti || nifti::is_header(bytes))
}
