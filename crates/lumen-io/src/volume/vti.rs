//! VTK image data (.vti) and legacy structured points (.vtk), which `vtk` reads.
//!
//! They have a place for directions, or none, but none for what they are directions of: their axes are unknown, and a warning
//! says so. Numbers of cells are taken as those of points in the middle of each.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::text;
use super::super::vtk::{Image, Values, is_legacy, read_image, read_legacy_image};
use super::super::warnings::ScanWarning;
use super::error::ScanError;
use super::numbers::{LARGEST, Layout, MAX_UNFOLDED};
use super::outline::Scan;
use lumen_volume::{Geometry, Grid, VolumeError};

const XML: &str = "VTI";
const LEGACY: &str = "VTK";

/// Reads a file.
pub(super) fn read(bytes: &[u8]) -> Result<Scan, ScanError> {
    if is_legacy(text::beginning(bytes)) {
        return read_legacy_image(bytes, |image| scan(&image, LEGACY))?;
    }
    let room = LARGEST.min(MAX_UNFOLDED * bytes.len() as u64);
    read_image(bytes, room, |image| scan(&image, XML))?
}

fn scan(image: &Image, format: &'static str) -> Result<Scan, ScanError> {
    let size = image.extent.map(|[first, last]| {
        let along = last.checked_sub(first).and_then(|steps| steps.checked_add(i64::from(!image.on_cells)));
        along.and_then(|along| usize::try_from(along).ok()).unwrap_or(0)
    });
    let direction = DMat3::from_cols_array(&image.direction).transpose();
    let steps = direction * DMat3::from_diagonal(DVec3::from(image.spacing));
    let middle = if image.on_cells { 0.5 } else { 0.0 };
    let first = DVec3::from(image.extent.map(|[first, _]| first as f64 + middle));
    let geometry =
        Geometry::from_steps(size, steps, DVec3::from(image.origin) + steps * first).map_err(VolumeError::from)?;
    let layout = |is_big_endian| Layout::new(format, size, image.scalar, is_big_endian);
    let samples = match &image.values {
        Values::Text(text) => layout(false)?.take_text(text)?,
        Values::Little(bytes) => layout(false)?.take(bytes)?,
        Values::Big(bytes) => layout(true)?.take(bytes)?,
    };
    let mut scan = Scan::new(Grid::new(geometry, samples, 1.0, 0.0)?, format, Axes::Unknown);
    scan.warnings.push(ScanWarning::SilentFormat { format: format.to_owned() }.into());
    Ok(scan)
}
