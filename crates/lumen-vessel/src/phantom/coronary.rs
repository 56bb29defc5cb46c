//! The aortic root and arch with the coronary arteries.
//!
//! Positions are LPS millimetres (x to the patient's left, y to the back, z up) about the middle of the aortic
//! annulus. The coronary arteries are drawn on an invisible heart: half an ellipsoid between the base, where the
//! atrioventricular groove runs, and the apex. On it a place is given by how far it lies from base (0) to apex (1)
//! and by the angle around the axis: 0 degrees is the anterior interventricular groove, 90 the acute margin of the
//! right ventricle, 180 the posterior interventricular groove, 270 (or -90) the obtuse margin of the left. The
//! right coronary and the circumflex so make the circle in the atrioventricular groove, the two descending arteries
//! the loop between the ventricles (circle and loop, as angiographers draw it). Right-dominant, as in about 85 % of
//! people.
//!
//! Diameters are those of healthy adults: annulus 23-25 mm, sinuses 32-35 mm, sinotubular junction 28 mm, ascending
//! aorta 30-31 mm, arch 25-28 mm, descending 24 mm (Hager et al. 2002; Wolak et al. 2008); brachiocephalic trunk
//! 12 mm, left common carotid 7 mm, left subclavian 9 mm; left main 4 mm, proximal LAD 3.6, circumflex 3.4, right
//! coronary 3.6 mm, tapering to 1.5 mm where they end (Dodge et al. 1992, rounded).

use glam::DVec3;

use super::field::Bulge;
use super::vessel::{Distal, Distal::Divides, Distal::Open, Tree, Vessel};

const AORTA: &str = "thoracic aorta";
const LAD: &str = "left anterior descending artery";
const LCX: &str = "left circumflex artery";
const RCA: &str = "right coronary artery";

/// Middle of the base of the heart.
const BASE: DVec3 = DVec3::new(0.0, 6.0, -20.0);
/// From the base to the apex in mm.
const HEART_LENGTH: f64 = 92.0;
/// Radius of the base in mm, towards the interventricular grooves and towards the margins.
const HEART_RADII: [f64; 2] = [38.0, 44.0];

/// Along a branch on the heart: way from base to apex, angle in degrees, height over the surface in mm, diameter.
type OnHeart = [f64; 4];

/// The vessels, the aorta first.
pub(super) fn vessels() -> Vec<Vessel> {
    let mut tree = Tree::default();
    aorta(&mut tree);
    let heart = Heart::new();
    left(&mut tree, &heart);
    right(&mut tree, &heart);
    tree.vessels
}

/// The three sinuses of Valsalva, 120 degrees apart around the root.
pub(super) fn sinuses() -> Vec<Bulge> {
    let (middle, axis) = (DVec3::new(-2.6, -1.8, 8.6), unit(DVec3::new(-0.28, -0.2, 0.94)));
    let right = across(DVec3::new(-0.25, -0.97, 0.0), axis);
    let side = axis.cross(right);
    let half_root_of_3 = 3.0f64.sqrt() / 2.0;
    let directions = [right, right * -0.5 + side * half_root_of_3, right * -0.5 - side * half_root_of_3];
    directions.map(|direction| Bulge { centre: middle + direction * 7.2, radius: 10.2, fillet: 3.0 }).into()
}

fn aorta(tree: &mut Tree) {
    tree.trunk(
        AORTA,
        Open,
        &[
            [3.6, 2.6, -10.0, 23.4],
            [1.9, 1.4, -5.5, 23.8],
            [0.0, 0.0, 0.0, 24.5],
            [-2.6, -1.8, 8.6, 29.0],
            [-5.6, -3.8, 19.0, 28.2],
            [-10.0, -6.0, 34.0, 30.5],
            [-13.2, -4.5, 50.0, 30.8],
            [-12.0, 2.5, 65.0, 29.6],
            [-5.0, 14.5, 75.5, 28.2],
            [6.0, 29.0, 77.5, 26.6],
            [15.5, 42.0, 70.0, 25.4],
            [20.0, 50.5, 55.0, 24.8],
            [21.5, 53.5, 41.0, 24.4],
            [21.5, 54.5, 30.0, 24.2],
        ],
    );
    tree.branch(
        "brachiocephalic trunk",
        AORTA,
        Open,
        &[[-8.5, 9.5, 71.5, 12.8], [-11.5, 7.5, 88.0, 12.4], [-15.5, 5.0, 99.0, 12.1], [-20.5, 3.5, 109.0, 12.0]],
    );
    tree.branch(
        "left common carotid artery",
        AORTA,
        Open,
        &[[-0.5, 20.5, 77.0, 7.8], [-0.5, 18.5, 92.0, 7.3], [1.5, 15.5, 106.0, 7.1], [4.5, 12.5, 119.0, 7.0]],
    );
    tree.branch(
        "left subclavian artery",
        AORTA,
        Open,
        &[
            [7.5, 31.0, 77.0, 9.8],
            [9.5, 32.0, 92.0, 9.3],
            [14.0, 31.5, 106.0, 9.0],
            [22.0, 29.0, 117.0, 8.8],
            [31.5, 26.0, 123.0, 8.6],
        ],
    );
}

fn left(tree: &mut Tree, heart: &Heart) {
    let division = heart.at(0.02, -46.0, -1.0);
    tree.branch(
        "left main coronary artery",
        AORTA,
        Divides,
        &[
            [-2.6, -1.8, 9.0, 4.2],
            [9.0, 1.6, 9.8, 4.1],
            [17.0, 4.0, 10.2, 3.9],
            [division.x, division.y, division.z, 3.8],
        ],
    );
    heart.branch(
        tree,
        LAD,
        "left main coronary artery",
        Open,
        &[
            [0.02, -46.0, -1.0, 3.7],
            [0.09, -30.0, 1.0, 3.6],
            [0.20, -15.0, 1.5, 3.4],
            [0.32, -6.0, 1.5, 3.1],
            [0.45, -3.5, 1.5, 2.8],
            [0.58, 2.0, 1.5, 2.5],
            [0.70, 1.0, 1.5, 2.2],
            [0.81, 5.0, 1.5, 1.9],
            [0.91, 4.0, 1.5, 1.75],
            [0.98, 16.0, 1.5, 1.65],
            [1.005, 90.0, 1.5, 1.6],
            [0.975, 165.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "first diagonal branch",
        LAD,
        Open,
        &[
            [0.17, -18.0, 1.5, 2.5],
            [0.27, -24.0, 1.5, 2.3],
            [0.38, -33.0, 1.5, 2.1],
            [0.49, -38.0, 1.5, 1.9],
            [0.60, -45.0, 1.5, 1.7],
            [0.70, -48.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "second diagonal branch",
        LAD,
        Open,
        &[
            [0.40, -4.5, 1.5, 2.1],
            [0.49, -12.0, 1.5, 2.0],
            [0.60, -21.0, 1.5, 1.8],
            [0.70, -25.0, 1.5, 1.7],
            [0.81, -32.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "first septal branch",
        LAD,
        Open,
        &[[0.22, -13.0, 1.5, 1.8], [0.26, -6.0, -5.0, 1.7], [0.32, 0.0, -12.0, 1.6], [0.39, 4.0, -18.0, 1.5]],
    );
    heart.branch(
        tree,
        "second septal branch",
        LAD,
        Open,
        &[[0.43, -4.0, 1.5, 1.7], [0.47, 2.0, -4.0, 1.6], [0.53, 6.0, -10.0, 1.55], [0.60, 9.0, -15.0, 1.5]],
    );
    heart.branch(
        tree,
        LCX,
        "left main coronary artery",
        Open,
        &[
            [0.02, -46.0, -1.0, 3.5],
            [0.045, -60.0, 1.0, 3.3],
            [0.02, -78.0, 1.0, 3.1],
            [0.025, -97.0, 1.0, 2.7],
            [0.045, -116.0, 1.0, 2.3],
            [0.045, -127.0, 1.0, 1.9],
            [0.08, -136.0, 1.0, 1.6],
        ],
    );
    heart.branch(
        tree,
        "first obtuse marginal branch",
        LCX,
        Open,
        &[
            [0.035, -66.0, 1.0, 2.6],
            [0.12, -73.0, 1.5, 2.4],
            [0.24, -76.0, 1.5, 2.2],
            [0.36, -83.0, 1.5, 2.0],
            [0.48, -84.0, 1.5, 1.8],
            [0.62, -90.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "second obtuse marginal branch",
        LCX,
        Open,
        &[
            [0.025, -99.0, 1.0, 2.3],
            [0.11, -106.0, 1.5, 2.1],
            [0.22, -109.0, 1.5, 1.9],
            [0.34, -116.0, 1.5, 1.7],
            [0.46, -118.0, 1.5, 1.5],
        ],
    );
}

fn right(tree: &mut Tree, heart: &Heart) {
    let [a, b] = [heart.at(-0.03, 47.0, 0.5), heart.at(0.0, 58.0, 1.0)];
    let mut control = vec![
        [-2.6, -1.8, 9.0, 4.0],
        [-5.8, -13.0, 10.4, 3.9],
        [-8.5, -21.5, 9.2, 3.7],
        [a.x, a.y, a.z, 3.6],
        [b.x, b.y, b.z, 3.5],
    ];
    control.extend(heart.course(&[
        [0.035, 74.0, 1.0, 3.4],
        [0.03, 92.0, 1.0, 3.3],
        [0.055, 110.0, 1.0, 3.2],
        [0.045, 130.0, 1.0, 3.1],
        [0.06, 150.0, 1.0, 3.0],
        [0.045, 168.0, 1.0, 2.8],
        [0.035, 182.0, 2.0, 2.6],
        [0.08, 195.0, 1.5, 2.3],
        [0.17, 203.0, 1.5, 2.0],
        [0.28, 205.0, 1.5, 1.7],
        [0.38, 210.0, 1.5, 1.5],
    ]));
    tree.branch(RCA, AORTA, Open, &control);
    heart.branch(
        tree,
        "conus branch",
        RCA,
        Open,
        &[
            [-0.03, 46.0, 0.5, 1.9],
            [0.04, 36.0, 3.0, 1.8],
            [0.12, 30.0, 3.0, 1.7],
            [0.21, 28.0, 2.5, 1.6],
            [0.30, 23.0, 2.0, 1.5],
        ],
    );
    heart.branch(
        tree,
        "right ventricular branch",
        RCA,
        Open,
        &[
            [0.035, 75.0, 1.0, 2.0],
            [0.13, 66.0, 1.5, 1.9],
            [0.24, 62.0, 1.5, 1.8],
            [0.35, 54.0, 1.5, 1.65],
            [0.46, 50.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "acute marginal branch",
        RCA,
        Open,
        &[
            [0.05, 105.0, 1.0, 2.2],
            [0.14, 99.0, 1.5, 2.1],
            [0.27, 97.0, 1.5, 1.9],
            [0.41, 91.0, 1.5, 1.75],
            [0.54, 90.0, 1.5, 1.6],
            [0.66, 84.0, 1.5, 1.5],
        ],
    );
    heart.branch(
        tree,
        "posterior descending artery",
        RCA,
        Open,
        &[
            [0.045, 170.0, 1.0, 2.5],
            [0.14, 177.0, 1.5, 2.3],
            [0.26, 176.0, 1.5, 2.15],
            [0.39, 180.0, 1.5, 2.0],
            [0.53, 178.0, 1.5, 1.8],
            [0.65, 182.0, 1.5, 1.65],
            [0.75, 179.0, 1.5, 1.5],
        ],
    );
}

/// The axes of the invisible heart, of unit length and square to one another.
struct Heart {
    /// From base to apex: to the left, forwards and down.
    apex: DVec3,
    /// To the anterior interventricular groove.
    groove: DVec3,
    /// To the acute margin.
    margin: DVec3,
}

impl Heart {
    fn new() -> Self {
        let apex = unit(DVec3::new(0.60, -0.44, -0.67));
        let groove = across(DVec3::new(0.28, -0.66, 0.70), apex);
        Self { apex, groove, margin: apex.cross(groove) }
    }

    /// The place `way` from base (0) to apex (1), `degrees` around the axis, `height` mm over the surface.
    fn at(&self, way: f64, degrees: f64, height: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(degrees * std::f64::consts::PI / 180.0);
        let width = (1.0 - way * way).max(0.0).sqrt();
        let around = self.groove * (cos * (HEART_RADII[0] * width + height))
            + self.margin * (sin * (HEART_RADII[1] * width + height));
        BASE + self.apex * (HEART_LENGTH * way) + around
    }

    fn course(&self, points: &[OnHeart]) -> Vec<[f64; 4]> {
        let place = |&[way, degrees, height, diameter]: &OnHeart| {
            let [x, y, z] = self.at(way, degrees, height).to_array();
            [x, y, z, diameter]
        };
        points.iter().map(place).collect()
    }

    fn branch(&self, tree: &mut Tree, name: &'static str, parent: &str, distal: Distal, points: &[OnHeart]) {
        tree.branch(name, parent, distal, &self.course(points));
    }
}

fn unit(v: DVec3) -> DVec3 {
    v / v.length()
}

/// The direction of `v` square to the unit vector `axis`.
fn across(v: DVec3, axis: DVec3) -> DVec3 {
    unit(v - axis * v.dot(axis))
}
