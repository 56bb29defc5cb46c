//! How a surface is moved onto a reference before the two are compared.
//!
//! Files far from the origin are moved when they are read, and their axes may point other ways: what brings the surface to
//! where it stands in the reference's coordinates is known from their reports. Where it does not lie there, a rigid motion is
//! fitted ([`align`]).

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::deviation::{Aligned, Rigid, align};
use lumen_io::{Axes, ImportReport};
use lumen_mesh::task::Yielder;
use lumen_mesh::{SurfaceIndex, TriMesh};
use lumen_message::messages;

/// How the surface is moved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Align {
    /// Not at all.
    #[default]
    Still,
    /// Turned where one of the files is in LPS and the other in RAS.
    Axes,
    /// Turned and shifted as the two fit best.
    Rigid,
}

impl Align {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Still, Self::Axes, Self::Rigid];
}

messages! {
    /// Why two surfaces cannot be compared.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum BesideError {
        /// There is no telling how axes differ.
        "reference-axes-unknown" AxesUnknown => "which way the axes point is said by one of the files at most",
        /// Nothing has a distance from nothing.
        "reference-no-area" NoArea => "one of the surfaces has no area: there is nothing to compare",
    }
}

/// Where the coordinates of a surface, as it was read, lie in those of its file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FileFrame {
    /// By how much it was moved when it was read, in mm.
    pub moved_mm: [f64; 3],
    /// What its axes grow towards.
    pub axes: Axes,
}

impl From<&ImportReport> for FileFrame {
    fn from(report: &ImportReport) -> Self {
        Self { moved_mm: report.moved_mm, axes: report.axes }
    }
}

/// How the surface was moved, in the coordinates of the files in mm: turned about the origin, then shifted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moved {
    /// As a quaternion x, y, z, w.
    pub rotation: [f64; 4],
    /// The shift in mm.
    pub shift_mm: [f64; 3],
    /// The angle of the rotation.
    pub turned_deg: f64,
    /// How far its vertices came, on the mean.
    pub mean_shift_mm: f64,
    /// What came of fitting it; null where only axes were turned.
    pub fit: Option<Fit>,
}

/// Root of the mean square distance of the nearest four fifths of the surface's points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Before, axes turned already, in mm.
    pub before_mm: f64,
    /// And after, in mm.
    pub residual_mm: f64,
}

/// What [`placed`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// From the coordinates in which the surface was read to those in which the reference was.
    pub motion: Rigid,
    /// What there is to tell of it: nothing where it was only read in other coordinates.
    pub moved: Option<Moved>,
}

/// Whether both say which way their axes point, and it is not the same way.
pub fn axes_differ(reference: FileFrame, surface: FileFrame) -> bool {
    are_known(reference, surface) && reference.axes != surface.axes
}

fn are_known(reference: FileFrame, surface: FileFrame) -> bool {
    reference.axes != Axes::Unknown && surface.axes != Axes::Unknown
}

/// Finds how `surface` is to be moved onto `reference`.
///
/// # Errors
/// Where axes are to be turned and are not known, or a surface that is to be fitted has no area.
pub async fn placed(
    reference: (&TriMesh, FileFrame),
    surface: (&TriMesh, FileFrame),
    how: Align,
    yielder: &Yielder,
) -> Result<Placed, BesideError> {
    let ((onto, of_reference), (mesh, of_surface)) = (reference, surface);
    if how == Align::Axes && !are_known(of_reference, of_surface) {
        return Err(BesideError::AxesUnknown);
    }
    let [to, from] = [of_reference, of_surface].map(|frame| DVec3::from(frame.moved_mm));
    let is_turned = how != Align::Still && axes_differ(of_reference, of_surface);
    let turned = if is_turned { Rigid::HALF_TURN } else { Rigid::STILL };
    let (mut motion, mut fit) = (Rigid::shift(-from).then(turned).then(Rigid::shift(to)), None);
    if how == Align::Rigid {
        let mut standing = mesh.clone();
        standing.positions.iter_mut().for_each(|p| *p = motion.of(*p));
        let index = SurfaceIndex::build(&onto.positions, &onto.triangles, &yielder.part(0.0..0.2)).await;
        let found = align(&standing, onto, &index, &yielder.part(0.2..1.0)).await.ok_or(BesideError::NoArea)?;
        let Aligned { motion: further, before_mm, residual_mm } = found;
        motion = motion.then(further);
        fit = Some(Fit { before_mm, residual_mm });
    }
    // In the coordinates of the files.
    let in_files = Rigid::shift(from).then(motion).then(Rigid::shift(-to));
    if fit.is_none() && motion.rotation == DQuat::IDENTITY {
        return Ok(Placed { motion, moved: None });
    }
    let shift = |p: &glam::Vec3| {
        let begun = p.as_dvec3() - from;
        begun.distance(in_files.moved(begun))
    };
    let shifts: f64 = mesh.positions.iter().map(shift).sum();
    let moved = Moved {
        rotation: in_files.rotation.to_array(),
        shift_mm: in_files.shift_mm.to_array(),
        turned_deg: in_files.angle_deg(),
        mean_shift_mm: shifts / mesh.positions.len().max(1) as f64,
        fit,
    };
    Ok(Placed { motion, moved: Some(moved) })
}
