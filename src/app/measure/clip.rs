//! The clip plane: square to an axis, to the line of sight or to a centreline, and moved along that.

use crate::app::document::Document;
use crate::io::Axes;
use crate::language::{Key, tell};
use crate::mesh::{Bounds, Vec3};
use crate::pipeline::settings::Keep;
use crate::render::ClipPlane;
use crate::say;
use crate::vessel::beside::along;
use crate::vessel::certificate::BranchCalibre;

/// What the plane is square to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Across {
    /// An axis of the file: 0 to 2.
    Axis(usize),
    /// A direction, of length 1.
    Direction(Vec3),
    /// The centreline of the branch of this number.
    Branch(u32),
}

/// A clip plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clip {
    /// What it is square to.
    pub across: Across,
    /// Where it is along that: the coordinate, or the arc length, in mm.
    pub at_mm: f32,
    /// Whether the other side is left out.
    pub is_flipped: bool,
}

/// Where a clip plane is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// Its middle, in mm.
    pub(super) at: Vec3,
    /// The way in which it is moved, of length 1.
    pub(super) way: Vec3,
    /// From where to where, in mm.
    pub(super) range_mm: [f32; 2],
    /// What is left out.
    pub(super) plane: ClipPlane,
}

/// The branches, where they are known.
pub(super) fn branches(document: &Document) -> &[BranchCalibre] {
    let calibre = document.calibre.as_ref().and_then(|calibre| calibre.found.as_ref().ok());
    calibre.map_or(&[], |found| &found.branches)
}

impl Across {
    /// What it is called.
    pub(super) fn label(self, document: &Document) -> String {
        const AXES: [&str; 3] = ["x", "y", "z"];
        const PATIENT: [Key; 3] = [Key("scan-sagittal"), Key("scan-coronal"), Key("scan-axial")];
        match self {
            Self::Axis(axis) if document.import.axes == Axes::Unknown => {
                say!("measure-across-axis", axis = AXES[axis.min(2)])
            }
            Self::Axis(axis) => PATIENT[axis.min(2)].say(),
            Self::Direction(_) => say!("measure-facing"),
            Self::Branch(number) => {
                let branch = branches(document).iter().find(|branch| branch.number == number);
                branch.map_or_else(
                    || say!("measure-centreline"),
                    |branch| say!("measure-along", vessel = tell(&branch.label())),
                )
            }
        }
    }
}

impl Clip {
    /// Through the middle of what is shown.
    pub(super) fn middle(across: Across, document: &Document, keep: Keep) -> Self {
        let clip = Self { across, at_mm: 0.0, is_flipped: false };
        let [low, high] = clip.place(document, keep).map_or([0.0; 2], |placed| placed.range_mm);
        Self { at_mm: f32::midpoint(low, high), ..clip }
    }

    /// Where it is; `None` while its branch is not known.
    pub(super) fn place(&self, document: &Document, keep: Keep) -> Option<Placed> {
        let bounds = document.bounds(keep);
        let (at, way, range_mm) = match self.across {
            Across::Axis(axis) => in_bounds(&bounds, Vec3::AXES[axis.min(2)], self.at_mm),
            Across::Direction(way) => in_bounds(&bounds, way, self.at_mm),
            Across::Branch(number) => {
                let branch = branches(document).iter().find(|branch| branch.number == number)?;
                let place = along(branch, f64::from(self.at_mm))?;
                let end = branch.abscissas_mm.last().copied().unwrap_or(0.0);
                (place.at.as_vec3(), place.direction.as_vec3(), [0.0, end])
            }
        };
        let normal = if self.is_flipped { -way } else { way };
        Some(Placed { at, way, range_mm, plane: ClipPlane { normal, offset: normal.dot(at) } })
    }
}

/// The middle of a box in the plane across `way` at `at_mm`, and from where to where the box reaches.
fn in_bounds(bounds: &Bounds, way: Vec3, at_mm: f32) -> (Vec3, Vec3, [f32; 2]) {
    let (middle, half) = (bounds.centre(), bounds.size() / 2.0);
    let (of_middle, reach) = (middle.dot(way), half.dot(way.abs()));
    (middle + way * (at_mm - of_middle), way, [of_middle - reach, of_middle + reach])
}
