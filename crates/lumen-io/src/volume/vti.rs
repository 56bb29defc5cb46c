//! VTK image data (.vti), whose XML `vtk` reads.
//!
//! It has a place for directions, but none for what they are directions of: its axes are unknown, and a warning says so.

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::vtk::{Image, Values, read_image};
use super::super::warnings::ScanWarning;
use super::error::ScanError;
use super::numbers::{LARGEST, Layout, MAX_UNFOLDED};
use super::outline::Scan;
use lumen_volume::{Geometry, Grid, VolumeError};

const FORMAT: &str = "VTI";

/// Reads a file.
pub(super) fn read(bytes: &[u8]) -> Result<Scan, ScanError> {
    let room = LARGEST.min(MAX_UNFOLDED * bytes.len() as u64);
    read_image(bytes, room, |image| scan(&image))?
}

fn scan(image: &Image) -> Result<Scan, ScanError> {
    let size = image.extent.map(|[first, last]| {
        let along = last.checked_sub(first).and_then(|steps| steps.checked_add(1));
        along.and_then(|along| usize::try_from(along).ok()).unwrap_or(0)
    });
    let direction = DMat3::from_cols_array(&image.direction).transpose();
    let steps = direction * DMat3::from_diagonal(DVec3::from(image.spacing));
    let origin = DVec3::from(image.origin) + steps * DVec3::from(image.extent.map(|[first, _]| first as f64));
    let geometry = Geometry::from_steps(size, steps, origin).map_err(VolumeError::from)?;
    let layout = |is_big_endian| Layout::new(FORMAT, size, image.scalar, is_big_endian);
    let samples = match &image.values {
        Values::Text(text) => layout(false)?.take_text(text)?,
        Values::Little(bytes) => layout(false)?.take(bytes)?,
        Values::Big(bytes) => layout(true)?.take(bytes)?,
    };
    let grid = Grid::new(geometry, samples, 1.0, 0.0)?;
    let mut scan = Scan::new(grid, FORMAT, Axes::Unknown);
    scan.warnings.push(ScanWarning::SilentFormat { format: FORMAT.to_owned() }.into());
    Ok(scan)
}
