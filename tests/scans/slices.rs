//! Slices lie where the scan lies: the border of what is bright in a slice and the outline of the surface in its plane are one
//! line, for oblique grids of either hand.

use lumen::io::volume::Scan;
use lumen::mesh::{TriMesh, Vec3, cut_pieces};
use lumen::volume::{Axis, Selection, Slice, slice, surface};

use crate::open;

/// The ball: its middle and radius in mm.
const CENTRE: [f64; 3] = [12.0, -30.0, 250.0];
const RADIUS: f64 = 11.0;
const SIZE: [usize; 3] = [48, 56, 40];
const SPACING: [f64; 3] = [0.7, 0.55, 0.9];

/// Turned about all three axes.
const TURNED: [[f64; 3]; 3] = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];

/// A ball that falls by 10 a mm and is 100 at its wall, on a grid with these directions, as a MetaImage.
fn ball(directions: [[f64; 3]; 3]) -> Scan {
    let place = |point: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|x| {
            let steps =
                (0..3).map(|axis| (point[axis] - SIZE[axis] as f64 / 2.0) * SPACING[axis] * directions[axis][x]);
            CENTRE[x] + steps.sum::<f64>()
        })
    };
    let list = |values: [f64; 3]| values.map(|value| value.to_string()).join(" ");
    let mut bytes = format!(
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nAnatomicalOrientation = RAI\nTransformMatrix = {}\nOffset = {}\n\
         ElementSpacing = {}\nDimSize = {} {} {}\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n",
        directions.map(list).join(" "),
        list(place([0.0; 3])),
        list(SPACING),
        SIZE[0],
        SIZE[1],
        SIZE[2],
    )
    .into_bytes();
    for k in 0..SIZE[2] {
        for j in 0..SIZE[1] {
            for i in 0..SIZE[0] {
                let depth = RADIUS - distance(place([i, j, k].map(|index| index as f64)), CENTRE);
                bytes.extend(((100.0 + 10.0 * depth) as f32).to_le_bytes());
            }
        }
    }
    open(&[("ball.mha", bytes)]).unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|x| (a[x] - b[x]) * (a[x] - b[x])).sum::<f64>().sqrt()
}

/// The places in mm, by the corners of the picture, where its greys pass half way between black and white.
fn border(picture: &Slice) -> Vec<[f64; 3]> {
    let [width, height] = picture.size;
    let [first, across, _, down] = picture.corners;
    let place = |a: f64, b: f64| -> [f64; 3] {
        let (a, b) = (a / (width - 1) as f64, b / (height - 1) as f64);
        std::array::from_fn(|x| first[x] + a * (across[x] - first[x]) + b * (down[x] - first[x]))
    };
    let grey = |a: usize, b: usize| f64::from(picture.pixels[b * width + a]) - 127.5;
    let mut found = Vec::new();
    for (b, a) in (0..height).flat_map(|b| (0..width).map(move |a| (b, a))) {
        for [da, db] in [[1, 0], [0, 1]] {
            if a + da < width && b + db < height {
                let (here, there) = (grey(a, b), grey(a + da, b + db));
                if (here < 0.0) != (there < 0.0) {
                    let part = here / (here - there);
                    found.push(place(a as f64 + part * da as f64, b as f64 + part * db as f64));
                }
            }
        }
    }
    found
}

/// Distance of a point from a line of pieces.
fn distance_to(pieces: &[[Vec3; 2]], p: [f64; 3]) -> f64 {
    let ends = |v: Vec3| v.to_array().map(f64::from);
    let to_piece = |&[a, b]: &[Vec3; 2]| {
        let (a, b) = (ends(a), ends(b));
        let (mut along, mut square) = (0.0, 0.0);
        for x in 0..3 {
            along += (p[x] - a[x]) * (b[x] - a[x]);
            square += (b[x] - a[x]) * (b[x] - a[x]);
        }
        let t = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
        distance(p, std::array::from_fn(|x| a[x] + t * (b[x] - a[x])))
    };
    pieces.iter().map(to_piece).fold(f64::INFINITY, f64::min)
}

fn cut(mesh: &TriMesh, picture: &Slice) -> Vec<[Vec3; 2]> {
    let [first, across, _, down] = picture.corners.map(|corner| Vec3::from_array(corner.map(|x| x as f32)));
    cut_pieces(&mesh.positions, &mesh.triangles, first, (across - first).cross(down - first))
}

#[test]
fn the_border_of_a_ball_in_a_slice_is_the_outline_of_its_surface() {
    let mirrored = [TURNED[0], TURNED[1], TURNED[2].map(|x| -x)];
    for directions in [TURNED, mirrored] {
        let grid = std::sync::Arc::new(ball(directions).grid);
        assert_eq!(grid.geometry().is_left_handed(), directions == mirrored);
        let mesh = surface(&grid, Selection::Threshold(100.0), None).unwrap();
        for (axis, index) in [(Axis::I, 20), (Axis::J, 35), (Axis::K, 13), (Axis::K, 28)] {
            // 127.5, half way, stands for 100.
            let picture = slice(&grid, axis, index, [0.0, 200.0]).unwrap();
            let (border, pieces) = (border(&picture), cut(&mesh, &picture));
            assert!(border.len() > 50 && pieces.len() > 50, "{axis:?} {index}");
            let half = 0.5 * SPACING.iter().copied().fold(f64::INFINITY, f64::min);
            for p in &border {
                let off = distance_to(&pieces, *p);
                assert!(off < half, "{axis:?} {index}: {off} mm at {p:?}");
                // And both are where the ball is.
                assert!((distance(*p, CENTRE) - RADIUS).abs() < half, "{axis:?} {index} at {p:?}");
            }
            for p in pieces.as_flattened() {
                assert!(
                    (distance(p.to_array().map(f64::from), CENTRE) - RADIUS).abs() < half,
                    "{axis:?} {index} at {p}"
                );
            }
        }
    }
}
