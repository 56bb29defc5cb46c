//! What decimation keeps of edges, rims and tips, on surfaces made here whose right answer is known from their shape.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use lumen::mesh::{Topology, TriMesh, Vec3, surface_area};
use lumen::pipeline::decimation::decimate;
use lumen::pipeline::deviation::deviation;
use lumen::pipeline::progressive::{NEVER, ProgressiveMesh};
use lumen::pipeline::settings::{Decimation, Method, Target};

fn levels_of(mesh: &TriMesh, settings: &Decimation) -> ProgressiveMesh {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let levels = decimate(mesh, &topology, settings);
    levels.assert_well_formed();
    levels
}

fn by(method: Method) -> Decimation {
    Decimation { method, ..Decimation::default() }
}

fn bits(p: Vec3) -> [u32; 3] {
    p.to_array().map(f32::to_bits)
}

/// A sheet of `columns` by `rows` cells, whose columns close to a tube or do not.
fn sheet(columns: u32, rows: u32, is_tube: bool, at: impl Fn(u32, u32) -> [f64; 3]) -> TriMesh {
    let around = if is_tube { columns } else { columns + 1 };
    let positions = (0..around * (rows + 1)).map(|i| Vec3::from(at(i % around, i / around).map(|x| x as f32)));
    let corner = |column: u32, row: u32| row * around + column % around;
    let triangles = (0..columns * rows).flat_map(|i| {
        let (column, row) = (i % columns, i / columns);
        let [a, b] = [corner(column, row), corner(column + 1, row)];
        let [c, d] = [corner(column + 1, row + 1), corner(column, row + 1)];
        if (column + row) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    });
    TriMesh { positions: positions.collect(), triangles: triangles.collect() }
}

/// Cells of a duct across a wall, and along it.
const ACROSS: u32 = 16;
const ALONG: u32 = 30;

/// A duct of some walls, each 8 mm wide and 60 mm long, that turns by a right angle from end to end. The walls are rough
/// by so many mm, their edges are not; the cells are four times as long as wide, so that a vertex is nearer to go off an
/// edge than along it.
fn duct(walls: u32, rough: f64) -> TriMesh {
    let apothem = 4.0 / (PI / f64::from(walls)).tan();
    sheet(walls * ACROSS, ALONG, true, |column, row| {
        let on_edge = column.is_multiple_of(ACROSS);
        let dent = if on_edge { 0.0 } else { rough * f64::from((column * 7 + row * row * 5) % 11) / 10.0 };
        let (x, y) = (apothem - dent, f64::from(column % ACROSS) / 2.0 - 4.0);
        let turn = FRAC_PI_2 * f64::from(row) / f64::from(ALONG) + TAU * f64::from(column / ACROSS) / f64::from(walls);
        [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos(), 2.0 * f64::from(row)]
    })
}

/// How many of a duct's edges lead from end to end in a level, over edges of it and vertices that were on that edge.
fn edges_left(walls: u32, duct: &TriMesh, level: &TriMesh) -> usize {
    let sides: BTreeSet<[[u32; 3]; 2]> = level
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]])
        .map(|side| side.map(|v| bits(level.positions[v as usize])))
        .collect();
    let vertices: BTreeSet<[u32; 3]> = level.positions.iter().map(|&p| bits(p)).collect();
    let leads = |wall: &u32| {
        let at = |row: u32| bits(duct.positions[((row * walls + wall) * ACROSS) as usize]);
        let left: Vec<[u32; 3]> = (0..=ALONG).map(at).filter(|p| vertices.contains(p)).collect();
        left.first() == Some(&at(0))
            && left.last() == Some(&at(ALONG))
            && left.windows(2).all(|pair| sides.contains(&[pair[0], pair[1]]))
    };
    (0..walls).filter(leads).count()
}

#[test]
fn feature_edges_lead_from_end_to_end_and_what_is_no_feature_does_not() {
    for (walls, rough, feature_angle) in [(4, 0.3, 60.0), (6, 0.1, 45.0)] {
        let duct = duct(walls, rough);
        let left = |feature_angle: f64, rate: u32| {
            let levels = levels_of(&duct, &Decimation { feature_angle, ..by(Method::Schroeder) });
            edges_left(walls, &duct, &levels.extract(&levels.level(Target::Reduction(rate)).triangles))
        };
        for rate in [500, 900, 950] {
            assert_eq!(left(feature_angle, rate), walls as usize, "{walls} walls at {rate}");
        }
        // Nothing is sharper than 180 degrees: then the rough walls take the edges with them.
        assert!(left(180.0, 900) <= 1, "{walls} walls: {} are left of themselves", left(180.0, 900));
    }
}

/// A flat sheet of 40 by 20 mm, whose rim at y = 0 swings by 1 mm.
fn waved() -> TriMesh {
    sheet(80, 20, false, |column, row| {
        let (x, part) = (f64::from(column) / 2.0, f64::from(row) / 20.0);
        let rim = (x / 10.0 * TAU).sin();
        [x, rim + (20.0 - rim) * part, 0.0]
    })
}

#[test]
fn a_rim_is_held_to_its_line() {
    let sheet = waved();
    for method in Method::ALL {
        let levels = levels_of(&sheet, &by(method));
        let at = |rate: u32| {
            let level = levels.level(Target::Reduction(rate));
            (levels.extract(&level.triangles), f64::from(levels.errors[level.steps as usize - 1]))
        };
        // What is flat goes first, and what bends stays.
        let (mesh, error) = at(900);
        let deviation = |mesh: &TriMesh| deviation(mesh, &sheet, 20_000).unwrap().max;
        assert!(error < 1e-3 && deviation(&mesh) < 1e-3, "{method:?}: {error}, {}", deviation(&mesh));
        assert!((surface_area(&mesh) / surface_area(&sheet) - 1.0).abs() < 1e-5, "{method:?}");
        let places: BTreeSet<_> = mesh.positions.iter().map(|&p| bits(p)).collect();
        // Where the line does not bend, a vertex may be deleted.
        let is_bent = |&i: &usize| method == Method::Quadric || sheet.positions[i].y.abs() > 1e-6;
        for i in (0..=80).filter(is_bent) {
            assert!(places.contains(&bits(sheet.positions[i])), "{method:?} has moved vertex {i} of its rim");
        }
        // Vertices that are deleted are as far from the line as the error says.
        if method == Method::Schroeder {
            for rate in [980, 985, 990] {
                let (mesh, error) = at(rate);
                assert!(deviation(&mesh) < error * 1.001, "{rate}: {} of {error}", deviation(&mesh));
            }
        }
    }
}

/// A sheet of 40 by 40 in units of `scale` mm that is flat but for the rim at y = 0, which swings up and down by `swing` over
/// so many rows.
fn swung(swing: f64, waves: u32, rows: u32, scale: f64) -> TriMesh {
    sheet(80, 20, false, |column, row| {
        let [x, y] = [f64::from(column) / 2.0, 2.0 * f64::from(row)];
        let left = (1.0 - f64::from(row) / f64::from(rows)).max(0.0);
        let z = swing * left * (f64::from(waves) * x / 40.0 * TAU).sin();
        [x, y, z].map(|x| x * scale)
    })
}

/// The same with the waves over all of it, along the diagonal: nearly plane, so that the planes hardly say where on it a
/// vertex should be.
fn rippled(swing: f64, waves: u32) -> TriMesh {
    sheet(40, 40, false, |column, row| {
        let [x, y] = [f64::from(column), f64::from(row)];
        [x, y, swing * (f64::from(waves) * (x + 0.7 * y) / 40.0 * TAU).sin()]
    })
}

/// The farthest that a vertex which was made lies from the edge in whose place it came, in lengths of that edge.
fn farthest_made(levels: &ProgressiveMesh) -> f64 {
    let nodes = levels.node_ends.len();
    // Two nodes that one step ends stand side by side.
    let pairs = (1..nodes).filter(|&i| levels.node_ends[i] == levels.node_ends[i - 1] && levels.node_ends[i] != NEVER);
    let at = |node: usize| levels.positions[node].as_dvec3();
    let lengths = pairs.map(|i| {
        let (a, way, p) = (at(i - 1), at(i) - at(i - 1), at(levels.parents[i] as usize));
        let part = ((p - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        (p - a - way * part).length() / way.length()
    });
    lengths.fold(0.0, f64::max)
}

#[test]
fn a_vertex_is_made_beside_the_edge_in_whose_place_it_comes() {
    let mut made = Vec::new();
    for scale in [0.001, 0.1, 1.0, 10.0] {
        for swing in [1e-4, 0.01, 0.05, 0.3, 2.0] {
            for (waves, rows) in [(4, 1), (4, 3), (9, 1), (9, 3)] {
                made.push((format!("{swing}, {waves}, {rows}, {scale}"), swung(swing, waves, rows, scale)));
            }
        }
    }
    for swing in [1e-4, 1e-3, 0.01, 0.1, 1.0] {
        made.extend([3, 11].map(|waves| (format!("{swing}, {waves}"), rippled(swing, waves))));
    }
    for (name, mesh) in made {
        let levels = levels_of(&mesh, &by(Method::Quadric));
        let far = farthest_made(&levels);
        // Of its own, and half as much again to keep the volume.
        assert!(far <= 1.5 + 1e-3, "{name}: {far} lengths of its edge");
    }
}

#[test]
fn a_flat_sheet_keeps_its_corners_while_anything_else_can_go() {
    for scale in [0.001, 0.1, 1.0, 10.0] {
        for swing in [0.01, 0.05, 0.3, 2.0] {
            for (waves, rows) in [(4, 1), (4, 3), (9, 1), (9, 3)] {
                let mesh = swung(swing, waves, rows, scale);
                let levels = levels_of(&mesh, &by(Method::Quadric));
                for count in [400, 200, 96, 48] {
                    let level = levels.extract(&levels.level(Target::Triangles(count)).triangles);
                    // The waves may go, all of them; what is flat has nothing to give.
                    let found = deviation(&level, &mesh, 5000).unwrap().max;
                    let most = (2.0 * swing).max(0.05) * scale;
                    assert!(found < most, "{swing}, {waves}, {rows}, {scale}: {found} mm off with {count} triangles");
                }
            }
        }
    }
}

/// A flat disc of 20 mm with a closed finger of 0.5 mm radius that stands 6.45 mm out of it.
fn finger() -> TriMesh {
    // Rings around the axis: of the disc from outside in, then up the finger; the last draws to a point.
    let sides = 16u32;
    let mut profile: Vec<[f64; 2]> = (0..20).map(|i| [10.0 - 0.5 * f64::from(i), 0.0]).collect();
    profile.extend((0..=12).map(|i| [0.5, 0.5 * f64::from(i)]));
    profile.extend([[0.35, 6.25], [0.1, 6.4]]);
    let mut mesh = sheet(sides, profile.len() as u32 - 1, true, |column, row| {
        let [radius, z] = profile[row as usize];
        let angle = f64::from(column) / f64::from(sides) * TAU;
        [radius * angle.cos(), radius * angle.sin(), z]
    });
    let top = mesh.positions.len() as u32;
    mesh.positions.push(Vec3::new(0.0, 0.0, 6.45));
    let first = top - sides;
    mesh.triangles.extend((0..sides).map(|i| [first + i, first + (i + 1) % sides, top]));
    mesh
}

#[test]
fn a_finger_is_as_long_and_as_round_as_it_was_while_a_disc_can_give_triangles() {
    let mesh = finger();
    for method in Method::ALL {
        let levels = levels_of(&mesh, &by(method));
        for count in [400, 200] {
            let cut = levels.extract(&levels.level(Target::Triangles(count)).triangles);
            let found = deviation(&cut, &mesh, 20_000).unwrap();
            // Less than half of its radius; its planes alone do not say how far a tip reaches.
            assert!(found.max < 0.2, "{method:?}, {count}: {found:?}");
        }
    }
}
