//! The surface in a page, to be turned there: as reduced, and with more triangles beside it. The page draws it by a script of
//! its own (`viewer.js`, which `draw.js` draws for), and asks for nothing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use sha2::{Digest as _, Sha256};

use crate::io::Axes;
use crate::mesh::{Bounds, TriMesh, Vec3};
use crate::pipeline::run::Pipeline;
use crate::say;

/// What draws the surface. Browsers leave out the carriage returns that a checkout may bring, and would not know the hash.
pub(super) fn script() -> String {
    concat!(include_str!("draw.js"), include_str!("viewer.js")).replace('\r', "")
}

/// What all surfaces of a page take at most, in bytes of text. The reduced one is there in any case.
const MOST_BYTES: usize = 4_000_000;

/// What a triangle takes: three corners and half a vertex, which base64 makes a third longer.
const TRIANGLE_BYTES: usize = (12 + 3) * 4 / 3;

/// Positions are whole numbers of this part of the box around a surface.
const STEPS: f32 = 65_535.0;

/// The surface as it stands in a page: 16-bit positions, 9 micrometres apart in a vessel of 600 mm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Carried {
    /// By how much the patient's front is turned from the -y of the file, in radians.
    across: f32,
    /// As reduced, then with more triangles where there is room.
    levels: Vec<Packed>,
    /// Triangles before reduction.
    #[serde(skip)]
    all: usize,
}

/// One level.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Packed {
    #[serde(skip)]
    triangle_count: usize,
    /// The least corner of the box, in mm, and its sides.
    low: [f32; 3],
    size: [f32; 3],
    /// Whether corners of triangles are of 32 bits.
    wide: bool,
    /// Little-endian, in base64.
    positions: String,
    triangles: String,
}

impl Carried {
    /// What `pipeline` has made of a surface of these axes; `None` where it is not done.
    pub fn of(pipeline: &Pipeline, axes: Axes) -> Option<Self> {
        Self::within(MOST_BYTES, pipeline, axes)
    }

    fn within(most_bytes: usize, pipeline: &Pipeline, axes: Axes) -> Option<Self> {
        let reduced = Packed::of(&pipeline.reduced()?.mesh);
        let progressive = pipeline.progressive()?;
        let room = most_bytes.saturating_sub(reduced.bytes());
        let mut levels = vec![reduced];
        let all = progressive.triangles_after(0);
        let wanted = all.min(room / TRIANGLE_BYTES);
        if wanted > levels[0].triangle_count {
            let level = progressive.level_after(progressive.steps_to(wanted));
            levels.push(Packed::of(&progressive.extract(&level.triangles)));
        }
        Some(Self { across: if axes == Axes::Ras { std::f32::consts::PI } else { 0.0 }, levels, all })
    }

    /// What each level is called, with its triangles.
    pub(super) fn names(&self) -> Vec<String> {
        let name = |(i, level): (usize, &Packed)| {
            let count = level.triangle_count;
            match i {
                0 => say!("report-view-reduced", count = count),
                _ if level.triangle_count == self.all => say!("report-view-before", count = count),
                // All of them would be too much for a page.
                _ => say!("report-view-less", count = count, all = self.all),
            }
        };
        self.levels.iter().enumerate().map(name).collect()
    }

    /// The data, as they stand in the page: base64 and numbers have no letter that ends an element.
    pub(super) fn data(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The source of scripts that the page's policy allows: this one.
pub(super) fn script_source() -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(script())))
}

impl Packed {
    fn of(mesh: &TriMesh) -> Self {
        let Bounds { min, max } = Bounds::of(&mesh.positions);
        let (low, size) = (Vec3::from(min), Vec3::from(max) - Vec3::from(min));
        let steps = |p: &Vec3| ((*p - low) / size.max(Vec3::splat(f32::MIN_POSITIVE)) * STEPS).to_array();
        let positions: Vec<u8> =
            mesh.positions.iter().flat_map(steps).flat_map(|step| (step.round() as u16).to_le_bytes()).collect();
        let wide = mesh.positions.len() > usize::from(u16::MAX);
        let corners = mesh.triangles.iter().flatten();
        let triangles: Vec<u8> = if wide {
            corners.flat_map(|v| v.to_le_bytes()).collect()
        } else {
            corners.flat_map(|&v| (v as u16).to_le_bytes()).collect()
        };
        Self {
            triangle_count: mesh.triangles.len(),
            low: low.to_array(),
            size: size.to_array(),
            wide,
            positions: STANDARD.encode(positions),
            triangles: STANDARD.encode(triangles),
        }
    }

    fn bytes(&self) -> usize {
        self.positions.len() + self.triangles.len()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::mesh::shapes::icosphere;
    use crate::pipeline::settings::Settings;

    #[test]
    fn what_stands_beside_the_reduced_surface_is_as_fine_as_there_is_room_for() {
        let settings = Settings { target: crate::pipeline::settings::Target::Reduction(900), ..Settings::default() };
        let mut pipeline = Pipeline::new(Arc::new(icosphere(4, 20.0, Vec3::X)), settings).without_measures();
        pipeline.finish().unwrap();
        let all = 5120;
        for (most_bytes, expected) in [(MOST_BYTES, 2), (60_000, 2), (1_000, 1)] {
            let Carried { levels, .. } = Carried::within(most_bytes, &pipeline, Axes::Unknown).unwrap();
            let counts: Vec<usize> = levels.iter().map(|level| level.triangle_count).collect();
            assert_eq!((counts[0].abs_diff(all / 10) <= 2, counts.len()), (true, expected), "{counts:?}");
            let bytes: usize = levels.iter().map(Packed::bytes).sum();
            match most_bytes {
                MOST_BYTES => assert_eq!(counts[1], all),
                60_000 => assert!(counts[1] < all && bytes <= most_bytes && bytes > most_bytes / 2, "{bytes}"),
                _ => {}
            }
        }
    }

    #[test]
    fn the_script_is_short_and_ends_no_element() {
        let script = script();
        assert!(script.len() < 60_000 && !script.contains("</") && !script.contains("http"));
    }
}
