//! The abdominal aorta about its renal arteries and its bifurcation: the segment that the paper reduces.
//!
//! Positions are LPS millimetres (x to the patient's left, y to the back, z up) about the bifurcation at the fourth
//! lumbar vertebra. Dimensions are those of a healthy adult as CT and ultrasound studies give them:
//!
//! - aorta 20 mm above and 17-19 mm below the renal arteries, 16-17 mm at the bifurcation (reporting standards of
//!   Johnston et al. 1991; Framingham CT reference values of Rogers et al. 2013), bowed forward by the lumbar lordosis;
//! - renal arteries 5-6 mm, here 30 mm of each, the right one behind the caval vein, both turning backwards; origins
//!   about 85-90 mm above the bifurcation (infrarenal length 85-110 mm);
//! - common iliac arteries 9-11 mm, 45-60 mm long, about 50 degrees apart.
//!
//! Smaller branches are left out: with as many triangles as the paper's surface has, the grid then is fine enough
//! (about nine voxels across a renal artery) for the paper's smoothing not to draw them in.

use super::vessel::{Distal::Divides, Distal::Open, Tree, Vessel};

/// The vessels, the aorta first.
pub(super) fn vessels() -> Vec<Vessel> {
    let mut tree = Tree::default();
    tree.trunk(
        "abdominal aorta",
        Divides,
        &[
            [1.0, 5.0, 112.0, 20.2],
            [1.8, 1.5, 98.0, 19.6],
            [2.6, -0.5, 86.0, 18.8],
            [4.2, -5.0, 62.0, 17.8],
            [4.4, -8.5, 38.0, 17.2],
            [2.6, -9.2, 18.0, 16.8],
            [1.4, -8.6, 7.0, 15.4],
            [1.0, -7.8, -2.0, 12.2],
        ],
    );
    renal(&mut tree);
    iliac(&mut tree);
    tree.vessels
}

fn renal(tree: &mut Tree) {
    tree.branch(
        "right renal artery",
        "abdominal aorta",
        Open,
        &[
            [2.3, 0.3, 91.0, 6.8],
            [-8.5, -2.0, 90.0, 6.3],
            [-18.0, 0.5, 86.5, 6.1],
            [-29.0, 7.5, 82.5, 6.0],
            [-37.0, 13.9, 81.0, 5.9],
        ],
    );
    tree.branch(
        "left renal artery",
        "abdominal aorta",
        Open,
        &[
            [2.7, -0.6, 86.5, 6.7],
            [13.5, -1.0, 86.0, 6.2],
            [22.0, 2.5, 84.5, 6.1],
            [31.0, 9.5, 84.0, 6.0],
            [38.5, 16.5, 85.0, 5.9],
        ],
    );
}

fn iliac(tree: &mut Tree) {
    tree.branch(
        "right common iliac artery",
        "abdominal aorta",
        Open,
        &[
            [1.4, -8.9, 10.0, 10.8],
            [-3.6, -7.6, -3.0, 10.6],
            [-10.5, -5.5, -17.0, 10.1],
            [-18.5, -1.0, -32.0, 9.7],
            [-27.0, 5.0, -47.0, 9.5],
        ],
    );
    tree.branch(
        "left common iliac artery",
        "abdominal aorta",
        Open,
        &[
            [1.4, -8.9, 10.0, 10.6],
            [6.5, -7.4, -3.5, 10.4],
            [13.0, -5.8, -18.0, 9.9],
            [20.0, -2.0, -34.0, 9.5],
            [27.5, 4.4, -51.2, 9.3],
        ],
    );
}
