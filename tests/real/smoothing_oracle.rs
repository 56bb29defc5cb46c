//! Windowed-sinc smoothing agrees with VTK's on real vessels: 26 cases made with VTK 9.7, to 1e-5 of the bounding
//! box's diagonal in the largest distance. The comparison uses VTK's own sigma, its 15-degree rule at boundaries and
//! no normalisation (see `reference/pipeline.md`). That the test can tell: the wrong window, or a sigma 5 % off, is
//! farther away than that.

use std::collections::HashMap;
use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::mesh::{Topology, Vec3};
use lumen::pipeline::filter::Filter;
use lumen::pipeline::settings::{Boundary, Smoothing, Window};
use lumen::pipeline::smoothing::smooth;
use serde::Deserialize;

/// Largest distance from VTK's result, as a part of the diagonal.
const TOLERANCE: f64 = 1e-5;

/// A case of `windowed_sinc.json`.
#[derive(Clone, Deserialize)]
struct Case {
    input: String,
    output: String,
    window: String,
    pass_band: f64,
    iterations: u32,
    sigma: f64,
}

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let oracle = data.join("../oracle");
    let list = oracle.join("windowed_sinc.json");
    let read = || -> Result<Vec<Case>, Failed> {
        let text = std::fs::read_to_string(&list)
            .map_err(|error| format!("VTK's results belong beside the test meshes: {}: {error}", list.display()))?;
        Ok(serde_json::from_str(&text)?)
    };
    let cases = match read() {
        Ok(cases) => cases,
        Err(error) => return vec![Trial::test("smoothing beside VTK", || Err(error))],
    };
    assert_eq!(cases.len(), 26);
    let trial = |case: Case| {
        let oracle = oracle.clone();
        Trial::test(format!("smoothing beside VTK: {}", case.output), move || check(&oracle, &case))
    };
    cases.into_iter().map(trial).collect()
}

/// Little-endian f32 triples.
fn points(bytes: &[u8]) -> impl Iterator<Item = Vec3> + '_ {
    bytes.chunks_exact(12).map(|xyz| {
        let at = |i: usize| f32::from_le_bytes([xyz[i], xyz[i + 1], xyz[i + 2], xyz[i + 3]]);
        Vec3::new(at(0), at(4), at(8))
    })
}

/// The vertices of a binary little-endian PLY file that has nothing but x, y, z in them.
fn vertices(ply: &[u8]) -> Option<Vec<Vec3>> {
    const END: &[u8] = b"end_header\n";
    let start = ply.windows(END.len()).position(|window| window == END)? + END.len();
    let header = std::str::from_utf8(&ply[..start]).ok()?;
    let count: usize = header.lines().find_map(|line| line.strip_prefix("element vertex "))?.parse().ok()?;
    Some(points(ply.get(start..start + 12 * count)?).collect())
}

fn check(oracle: &Path, case: &Case) -> Result<(), Failed> {
    let bytes = std::fs::read(oracle.join(&case.input))?;
    let mesh = read(&bytes, &case.input, &ImportOptions::default())?.mesh;
    // VTK's result has the file's order of vertices, the mesh that of their first use.
    let written = vertices(&bytes).ok_or("the oracle's mesh is a binary PLY file")?;
    let result: Vec<Vec3> = points(&std::fs::read(oracle.join(&case.output))?).collect();
    if result.len() != written.len() || mesh.positions.len() > written.len() {
        return Err(format!("{} vertices, VTK has {} of {}", mesh.positions.len(), result.len(), written.len()).into());
    }
    let bits = |p: &Vec3| p.to_array().map(f32::to_bits);
    let of_vertex: HashMap<[u32; 3], Vec3> = written.iter().map(bits).zip(result).collect();
    let expected: Option<Vec<Vec3>> = mesh.positions.iter().map(|p| of_vertex.get(&bits(p)).copied()).collect();
    let expected = expected.ok_or("a vertex that is not in the file")?;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let diagonal = f64::from(mesh.bounds().diagonal());
    let distance = |window: Window, sigma: f64| {
        let settings = Smoothing { window, pass_band: case.pass_band, iterations: case.iterations, ..Smoothing::PAPER };
        let smoothed = smooth(&mesh.positions, &topology, Boundary::Vtk15, &Filter::with_sigma(&settings, sigma));
        let apart = smoothed.iter().zip(&expected).map(|(a, b)| f64::from((*a - *b).length()));
        apart.fold(0.0, f64::max) / diagonal
    };
    let (window, other) = match case.window.as_str() {
        "hamming" => (Window::Hamming, Window::Nuttall),
        "nuttall" => (Window::Nuttall, Window::Hamming),
        unknown => return Err(format!("no window {unknown}").into()),
    };
    let right = distance(window, case.sigma);
    if right > TOLERANCE {
        return Err(format!("{right:.2e} of the diagonal from VTK").into());
    }
    for (what, wrong) in [("window", distance(other, case.sigma)), ("sigma", distance(window, case.sigma * 1.05))] {
        if wrong <= TOLERANCE {
            return Err(format!("the wrong {what} is only {wrong:.2e} of the diagonal away: the test is blind").into());
        }
    }
    Ok(())
}
