//! VTK's XML files of polygonal data (.vtp) and unstructured grids (.vtu).
//!
//! Arrays stand in the file as text, in base64, or appended behind the structure, raw or in base64. What is appended raw
//! is no XML: reading stops where it begins.

use glam::DVec3;

use super::super::Axes;
use super::super::error::ReadError;
use super::super::memory_budget::MemoryBudget;
use super::super::pace::Pace;
use super::super::raw::RawSurface;
use super::surface::Surface;
use super::xml_arrays::Arrays;
use super::xml_structure::Structure;
use lumen_mesh::arrays::Association;

/// Whether a text begins as VTK's XML files do.
pub(crate) fn is_xml(text: &[u8]) -> bool {
    let head = &text[..text.len().min(1024)];
    head.starts_with(b"<") && head.windows(8).any(|part| part == b"<VTKFile")
}

/// Reads a file, with positions relative to `origin`.
pub(super) async fn read(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let file = Structure::parse(bytes, pace).await?;
    let mut arrays = Arrays::new(&file, bytes, MemoryBudget::of(bytes.len()).unfolded(), pace);
    let mut surface = Surface::new(file.format, bytes.len(), origin);
    if file.pieces.iter().flat_map(|piece| &piece.data).any(|&(on, _)| on == Association::Triangle) {
        surface.note_cells();
    }
    let mut cells = 0u64;
    for piece in &file.pieces {
        arrays.add_piece(piece, cells, &mut surface).await?;
        cells = cells.saturating_add(piece.cell_count());
    }
    let axes = match &file.space {
        Some(array) => arrays.axes(array).await?,
        None => Axes::Unknown,
    };
    let columns = arrays.columns().await?;
    surface.finish(file.format, axes, columns)
}
