//! The slices of a scan behind the surface that was made of it: the scan stays where it is, with its engine, and gives one
//! picture at a time.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::action::SliceOptions;
use crate::engine::scan::{OpenedScan, ScanCommand, ScanLink};
use crate::io::Axes;
use crate::language::Key;
use crate::mesh::TriMesh;
use crate::volume::Axis;

/// The axes of a grid.
pub(super) const AXES: [Axis; 3] = [Axis::I, Axis::J, Axis::K];

/// A picture that is asked for: across which axis, which slice, and what is black and white.
type Wanted = (Axis, usize, [f64; 2]);

/// A slice in its place.
#[derive(Debug, PartialEq)]
pub(in crate::app) struct SlicePicture {
    /// Each has another.
    pub(in crate::app) serial: u64,
    of: Wanted,
    /// Pixels along both of its axes.
    pub(in crate::app) size: [usize; 2],
    /// A shade of grey for each.
    pub(in crate::app) pixels: Vec<u8>,
    /// Around it in mm, from the first pixel on.
    pub(in crate::app) corners: [Vec3; 4],
}

impl SlicePicture {
    /// Across the slice, of any length.
    pub(in crate::app) fn normal(&self) -> Vec3 {
        let [first, across, _, down] = self.corners;
        (across - first).cross(down - first)
    }
}

/// A scan that is kept for the surface that was made of it.
#[derive(Debug)]
pub struct KeptScan {
    /// What is known of it.
    pub opened: OpenedScan,
    /// Whether its values are Hounsfield units.
    pub is_ct: bool,
    /// What is shown of it.
    pub options: SliceOptions,
    /// What the planes across its axes are called.
    pub names: [Key; 3],
    surface: Arc<TriMesh>,
    pictures: [Option<Arc<SlicePicture>>; 3],
    awaited: Option<Wanted>,
    /// What the engine has no picture of.
    refused: Option<Wanted>,
    serial: u64,
}

impl KeptScan {
    /// Of a scan, in Hounsfield units if `is_ct`, of which `surface` was made; nothing is shown yet.
    pub(super) fn new(opened: OpenedScan, is_ct: bool, window: [f64; 2], surface: Arc<TriMesh>) -> Self {
        Self {
            is_ct,
            options: SliceOptions {
                planes: opened.dimensions.map(|along| (false, along / 2)),
                window,
                has_outline: true,
            },
            names: names(&opened),
            surface,
            pictures: [None, None, None],
            awaited: None,
            refused: None,
            serial: 0,
            opened,
        }
    }

    /// Whether a surface is the one that was made of it.
    pub(super) fn is_of(&self, surface: &Arc<TriMesh>) -> bool {
        Arc::ptr_eq(&self.surface, surface)
    }

    /// The slices that are shown, as far as they have come.
    pub(in crate::app) fn shown(&self) -> Vec<Arc<SlicePicture>> {
        let planes = self.options.planes.iter().zip(&self.pictures);
        planes.filter(|((is_shown, _), _)| *is_shown).filter_map(|(_, picture)| picture.clone()).collect()
    }

    /// Whether a slice is on its way.
    pub(super) fn awaits(&self) -> bool {
        self.awaited.is_some()
    }

    /// Asks for the next slice that is shown and has not come, once the one before is there.
    pub(super) fn follow(&mut self, link: &mut ScanLink) {
        if self.awaited.is_some() {
            return;
        }
        let window = self.options.window;
        let wanted = AXES.into_iter().zip(self.options.planes).zip(&self.pictures).find_map(|(plane, picture)| {
            let (axis, (is_shown, index)) = plane;
            let wanted = (axis, index, window);
            let is_there = picture.as_ref().is_some_and(|picture| picture.of == wanted);
            (is_shown && !is_there && self.refused != Some(wanted)).then_some(wanted)
        });
        if let Some((axis, index, window)) = wanted {
            self.awaited = wanted;
            link.send(ScanCommand::Slice { axis, index, window });
        }
    }

    /// Takes a slice that was asked for.
    pub(super) fn take(&mut self, of: Wanted, size: [usize; 2], pixels: Vec<u8>, corners: [[f64; 3]; 4]) {
        if self.awaited.take_if(|awaited| *awaited == of).is_some() {
            self.serial += 1;
            let corners = corners.map(|corner| DVec3::from(corner).as_vec3());
            let picture = SlicePicture { serial: self.serial, of, size, pixels, corners };
            self.pictures[of.0.index()] = Some(Arc::new(picture));
        }
    }

    /// Hears that there is no such slice.
    pub(super) fn refused(&mut self) {
        self.refused = self.awaited.take();
    }
}

/// What the planes across the axes of a grid are called: by the patient's planes that they are nearest to, each of which
/// comes once; by the axes of the grid where nothing is known of the patient's.
fn names(opened: &OpenedScan) -> [Key; 3] {
    if opened.axes == Axes::Unknown {
        return [Key("scan-across-columns"), Key("scan-across-rows"), Key("scan-across-slices")];
    }
    const NAMES: [Key; 3] = [Key("scan-sagittal"), Key("scan-coronal"), Key("scan-axial")];
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let [i, j, k] = opened.directions.map(DVec3::from);
    let normals = [j.cross(k), k.cross(i), i.cross(j)];
    let along =
        |order: &[usize; 3]| -> f64 { normals.iter().zip(order).map(|(normal, &axis)| normal[axis].abs()).sum() };
    let best = ORDERS.iter().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(&ORDERS[0]);
    best.map(|axis| NAMES[axis])
}
