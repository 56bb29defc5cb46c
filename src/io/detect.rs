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
        "vti" => Err(ReadError::ImageVolume { format: "VTK image data" }),
        "nii" | "hdr" | "img" => Err(ReadError::ImageVolume { format: "NIfTI" }),
        "mha" | "mhd" => Err(ReadError::ImageVolume { format: "MetaImage" }),
        "nrrd" | "nhdr" => Err(ReadError::ImageVolume { format: "NRRD" }),
        "dcm" | "dicom" | "ima" => Err(ReadError::ImageVolume { format: "DICOM" }),
        _ if obj::looks_like(bytes) => Ok(Content::Obj),
        _ => Err(ReadError::Unknown { name: name.to_owned() }),
    }
}

/// What the first bytes say, or `None` where they say nothing.
fn by_magic(bytes: &[u8], name: &str) -> Result<Option<Content>, ReadError> {
    if bytes.starts_with(b"glTF") {
        return Ok(Some(Content::Glb));
    }
    if bytes.starts_with(b"\x1f\x8b") {
        if name.to_ascii_lowercase().ends_with(".nii.gz") {
            return Err(ReadError::ImageVolume { format: "NIfTI" });
        }
        return Err(ReadError::Compressed { format: "gzip" });
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(ReadError::Compressed { format: "zip" });
    }
    if bytes.starts_with(b"NRRD000") {
        return Err(ReadError::ImageVolume { format: "NRRD" });
    }
    if bytes.get(128..132) == Some(b"DICM") {
        return Err(ReadError::ImageVolume { format: "DICOM" });
    }
    if matches!(bytes.get(344..348), Some(b"n+1\0" | b"ni1\0")) {
        return Err(ReadError::ImageVolume { format: "NIfTI" });
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
    if (begins_with(b"ObjectType") || begins_with(b"NDims")) && contains(b"ElementType") {
        return Err(ReadError::ImageVolume { format: "MetaImage" });
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
    fn what_is_no_surface_is_named() {
        assert_eq!(detect(b"", "a.stl"), Err(ReadError::Empty));
        assert_eq!(detect(b"Dear colleague", "letter"), Err(ReadError::Unknown { name: "letter".to_owned() }));
        assert_eq!(detect(b"\x1f\x8b\x08", "a.nii.gz"), Err(ReadError::ImageVolume { format: "NIfTI" }));
    }
}
