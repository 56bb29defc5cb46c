//! The abdominal aorta from the diaphragm to the groins, with its visceral, renal and iliac branches.
//!
//! Positions are LPS millimetres (x to the patient's left, y to the back, z up) about the bifurcation at the fourth
//! lumbar vertebra. Dimensions are those of a healthy adult as CT and ultrasound studies give them:
//!
//! - aorta 21-22 mm at the diaphragm, 17-20 mm below the renal arteries, 16-17 mm at the bifurcation (reporting
//!   standards of Johnston et al. 1991; Framingham CT reference values of Rogers et al. 2013), about 150 mm long,
//!   bowed forward by the lumbar lordosis;
//! - coeliac trunk 7-8 mm; superior mesenteric artery 7 mm about 12 mm below it, 6-20 mm in front of the aorta;
//!   inferior mesenteric artery 3-4 mm, 40 mm above the bifurcation, from the left of the front;
//! - renal arteries 5-6 mm, 40-50 mm long, the right one longer and behind the caval vein, both turning backwards;
//!   origins about 85-90 mm above the bifurcation (infrarenal length 85-110 mm);
//! - common iliac arteries 9-11 mm, 45-60 mm long, about 50 degrees apart; external 7-8 mm; internal 5-6.5 mm.

use super::vessel::{Distal::Divides, Distal::Open, Tree, Vessel};

/// The vessels, the aorta first.
pub(super) fn vessels() -> Vec<Vessel> {
    let mut tree = Tree::default();
    tree.trunk(
        "abdominal aorta",
        Divides,
        &[
            [-0.8, 12.2, 146.0, 21.6],
            [0.0, 9.0, 130.0, 21.2],
            [1.2, 4.0, 108.0, 20.0],
            [2.6, -0.5, 86.0, 18.8],
            [4.2, -5.0, 62.0, 17.8],
            [4.4, -8.5, 38.0, 17.2],
            [2.6, -9.2, 18.0, 16.8],
            [1.4, -8.6, 7.0, 15.4],
            [1.0, -7.8, -2.0, 12.2],
        ],
    );
    visceral(&mut tree);
    renal(&mut tree);
    iliac(&mut tree);
    tree.vessels
}

fn visceral(tree: &mut Tree) {
    tree.branch(
        "coeliac trunk",
        "abdominal aorta",
        Divides,
        &[[0.3, 7.0, 122.0, 8.0], [0.8, -3.0, 122.5, 7.6], [1.2, -10.0, 120.5, 7.3], [2.0, -18.0, 120.5, 7.0]],
    );
    tree.branch(
        "common hepatic artery",
        "coeliac trunk",
        Open,
        &[
            [2.0, -18.0, 120.5, 5.6],
            [-4.0, -22.5, 119.5, 5.4],
            [-13.0, -24.0, 116.5, 5.2],
            [-23.0, -22.5, 117.5, 5.0],
            [-31.0, -19.0, 123.0, 4.8],
            [-37.0, -16.0, 130.0, 4.6],
        ],
    );
    tree.branch(
        "splenic artery",
        "coeliac trunk",
        Open,
        &[
            [2.0, -18.0, 120.5, 6.0],
            [8.0, -21.0, 123.0, 5.8],
            [17.0, -18.5, 127.5, 5.6],
            [26.0, -12.0, 125.0, 5.4],
            [34.0, -5.0, 120.5, 5.3],
            [43.0, 3.0, 123.5, 5.1],
            [51.0, 11.0, 129.5, 5.0],
            [56.0, 16.5, 131.0, 4.8],
        ],
    );
    tree.branch(
        "superior mesenteric artery",
        "abdominal aorta",
        Open,
        &[
            [1.0, 4.5, 109.0, 7.8],
            [1.0, -5.0, 108.0, 7.4],
            [1.3, -14.0, 103.0, 7.2],
            [1.6, -21.0, 92.0, 6.9],
            [1.0, -25.5, 76.0, 6.5],
            [-0.6, -28.5, 58.0, 6.0],
            [-4.0, -30.0, 42.0, 5.4],
            [-8.5, -30.5, 28.0, 5.0],
        ],
    );
    tree.branch(
        "inferior mesenteric artery",
        "abdominal aorta",
        Open,
        &[
            [4.4, -8.4, 41.0, 4.2],
            [8.5, -16.0, 37.0, 4.0],
            [11.5, -20.5, 28.0, 3.8],
            [14.5, -22.0, 14.0, 3.6],
            [18.5, -21.5, -2.0, 3.4],
            [21.0, -20.0, -18.0, 3.2],
        ],
    );
}

fn renal(tree: &mut Tree) {
    tree.branch(
        "right renal artery",
        "abdominal aorta",
        Divides,
        &[
            [2.3, 0.3, 90.0, 6.4],
            [-8.5, -2.0, 89.0, 6.0],
            [-18.0, 0.5, 85.5, 5.7],
            [-29.0, 7.5, 81.5, 5.5],
            [-39.0, 15.5, 80.0, 5.4],
        ],
    );
    tree.branch(
        "right anterior renal division",
        "right renal artery",
        Open,
        &[[-39.0, 15.5, 80.0, 4.4], [-45.5, 19.0, 80.0, 4.2], [-52.5, 21.5, 83.0, 4.0], [-59.0, 24.5, 85.0, 3.8]],
    );
    tree.branch(
        "right posterior renal division",
        "right renal artery",
        Open,
        &[[-34.0, 11.2, 80.6, 4.0], [-40.5, 18.5, 76.5, 3.9], [-46.0, 25.0, 70.0, 3.7], [-50.5, 30.0, 63.5, 3.5]],
    );
    tree.branch(
        "left renal artery",
        "abdominal aorta",
        Divides,
        &[
            [2.7, -0.6, 85.5, 6.3],
            [13.5, -1.0, 85.0, 5.9],
            [22.0, 2.5, 83.5, 5.6],
            [31.0, 9.5, 83.0, 5.5],
            [39.0, 17.0, 84.0, 5.4],
        ],
    );
    tree.branch(
        "left anterior renal division",
        "left renal artery",
        Open,
        &[[39.0, 17.0, 84.0, 4.2], [45.0, 19.5, 86.5, 4.1], [51.5, 22.5, 91.5, 3.9], [57.0, 25.5, 95.5, 3.7]],
    );
    tree.branch(
        "left posterior renal division",
        "left renal artery",
        Open,
        &[[39.0, 17.0, 84.0, 4.0], [44.5, 22.5, 82.5, 3.9], [51.0, 28.0, 78.0, 3.7], [56.5, 32.0, 74.0, 3.5]],
    );
}

fn iliac(tree: &mut Tree) {
    tree.branch(
        "right common iliac artery",
        "abdominal aorta",
        Divides,
        &[
            [1.4, -8.9, 10.0, 10.8],
            [-3.6, -7.6, -3.0, 10.6],
            [-10.5, -5.5, -17.0, 10.1],
            [-18.5, -1.0, -32.0, 9.7],
            [-25.5, 4.0, -45.0, 9.6],
        ],
    );
    tree.branch(
        "right external iliac artery",
        "right common iliac artery",
        Open,
        &[
            [-25.5, 4.0, -45.0, 8.4],
            [-33.0, 5.5, -58.0, 8.1],
            [-41.5, 1.5, -73.0, 7.8],
            [-49.0, -8.0, -88.0, 7.6],
            [-55.0, -20.0, -102.0, 7.4],
            [-58.0, -28.0, -112.0, 7.3],
        ],
    );
    tree.branch(
        "right internal iliac artery",
        "right common iliac artery",
        Open,
        &[
            [-25.5, 4.0, -45.0, 6.8],
            [-28.0, 10.5, -53.5, 6.5],
            [-28.5, 20.0, -63.0, 6.2],
            [-26.0, 29.0, -74.0, 5.8],
            [-24.5, 34.0, -87.0, 5.4],
        ],
    );
    tree.branch(
        "left common iliac artery",
        "abdominal aorta",
        Divides,
        &[
            [1.4, -8.9, 10.0, 10.6],
            [6.5, -7.4, -3.5, 10.4],
            [13.0, -5.8, -18.0, 9.9],
            [20.0, -2.0, -34.0, 9.5],
            [27.0, 4.0, -50.0, 9.4],
        ],
    );
    tree.branch(
        "left external iliac artery",
        "left common iliac artery",
        Open,
        &[
            [27.0, 4.0, -50.0, 8.3],
            [34.5, 6.0, -62.0, 8.0],
            [43.5, 1.0, -75.5, 7.7],
            [50.5, -9.0, -89.0, 7.5],
            [55.5, -20.5, -103.0, 7.3],
            [58.5, -28.0, -112.0, 7.2],
        ],
    );
    tree.branch(
        "left internal iliac artery",
        "left common iliac artery",
        Open,
        &[
            [27.0, 4.0, -50.0, 6.7],
            [29.5, 11.5, -58.0, 6.4],
            [29.5, 21.5, -67.0, 6.0],
            [27.0, 30.0, -78.0, 5.6],
            [25.5, 34.5, -90.0, 5.3],
        ],
    );
}
