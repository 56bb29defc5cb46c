//! What smoothing promises, on phantoms and on meshes of known geometry, over random settings: the same bits with any
//! number of threads and from terms that were kept, unit gain, vertices that stay, the response that is stated, the
//! volume that is held, and a clear answer for whatever comes in.

use std::f64::consts::PI;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use glam::{DVec2, DVec3};
use lumen::mesh::{Topology, TriMesh, Vec3, self_intersections};
use lumen::parallel::with_threads;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::filter::Filter;
use lumen::pipeline::response::wavelength;
use lumen::pipeline::results::Smoothed;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Boundary, Keep, OutOfRange, Settings, SettingsError, Smoothing, Target, Window};
use lumen::pipeline::smoothing::{Terms, smooth, smooth_in_slices, smooth_keeping_terms, smooth_varying};
use lumen::pipeline::stage::Stage;
use lumen::pipeline::task::{Budget, Progress, Running, Yielder, at_once};
use proptest::prelude::*;

/// The phantoms, small.
static PHANTOMS: LazyLock<[Arc<TriMesh>; 2]> = LazyLock::new(|| {
    [(Sample::Aorta, 12_000), (Sample::Coronary, 30_000)].map(|(s, n)| Arc::new(generate(s, n).unwrap()))
});

/// The terms of a run.
fn terms(mesh: &TriMesh, topology: &Topology, settings: &Smoothing) -> Terms {
    let (filter, never) = (Filter::new(settings), Yielder::never());
    let run = smooth_keeping_terms(&mesh.positions, topology, settings.boundary, &filter, 64_000_000, &never);
    at_once(run).1.unwrap()
}

fn settings() -> impl Strategy<Value = Smoothing> {
    let window = prop::sample::select(Window::ALL.to_vec());
    let boundary = prop::sample::select(vec![Boundary::Loop, Boundary::Vtk15]);
    // Pass bands evenly on a logarithmic scale.
    (window, -3.0..0.3f64, 1..=120u32, boundary).prop_map(|(window, exponent, iterations, boundary)| Smoothing {
        window,
        pass_band: libm::exp10(exponent).clamp(0.001, 2.0),
        iterations,
        boundary,
        preserve_volume: false,
        adapt: false,
        guard: false,
        hold_caps: false,
    })
}

fn run(mesh: &TriMesh, topology: &Topology, settings: &Smoothing) -> Vec<Vec3> {
    smooth(&mesh.positions, topology, settings.boundary, &Filter::new(settings))
}

/// The stages up to smoothing.
fn smoothed(pipeline: &mut Pipeline) -> Arc<Smoothed> {
    while pipeline.smoothed().is_none() {
        pipeline.advance(Budget::UNLIMITED).unwrap();
    }
    pipeline.smoothed().unwrap().clone()
}

/// The part of all faces that cross others.
fn crossing(mesh: &TriMesh) -> f64 {
    self_intersections(mesh).len() as f64 / mesh.triangles.len() as f64
}

fn all_pieces(smoothing: Smoothing) -> Settings {
    Settings { keep: Keep::All, smoothing, ..Settings::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_number_of_threads_and_the_slices_do_not_matter(settings in settings(), phantom in 0..2usize) {
        let mesh = &PHANTOMS[phantom];
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let one = with_threads(1, || run(mesh, &topology, &settings));
        for threads in [2, 7] {
            let many = with_threads(threads, || run(mesh, &topology, &settings));
            prop_assert!(many == one, "{threads} threads, {settings:?}");
        }
        let (positions, topology, filter) = (&mesh.positions, &topology, &Filter::new(&settings));
        let mut running = Running::new(|yielder| async move {
            smooth_in_slices(positions, topology, settings.boundary, filter, &yielder).await
        });
        let sliced = loop {
            match with_threads(2, || running.advance(Budget::new(Duration::ZERO))) {
                Progress::Working(fraction) => prop_assert!((0.0..=1.0).contains(&fraction)),
                Progress::Done(positions) => break positions,
            }
        };
        prop_assert!(sliced == one, "in slices, {settings:?}");
    }

    #[test]
    fn another_filter_from_kept_terms_is_a_run_of_its_own_to_the_bit(
        settings in settings(), other in settings(), phantom in 0..2usize,
    ) {
        let mesh = &PHANTOMS[phantom];
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let terms = terms(mesh, &topology, &settings);
        let other = Smoothing { iterations: other.iterations.min(terms.degree() as u32), boundary: settings.boundary, ..other };
        prop_assert!(terms.smooth(&Filter::new(&other)) == run(mesh, &topology, &other));
    }

    #[test]
    fn every_window_leaves_the_origin_alone(settings in settings(), phantom in 0..2usize) {
        let mesh = &PHANTOMS[phantom];
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        // On a grid of 2^-12 mm, so that the shift is exact in f32 and nothing but the filter can differ.
        let grid = |p: &Vec3| (*p * 4096.0).round() / 4096.0;
        let here = TriMesh { positions: mesh.positions.iter().map(grid).collect(), triangles: mesh.triangles.clone() };
        let there = TriMesh { positions: here.positions.iter().map(|p| *p + 500.0).collect(), triangles: here.triangles.clone() };
        let (here, there) = (run(&here, &topology, &settings), run(&there, &topology, &settings));
        let apart = here.iter().zip(&there).map(|(a, b)| (*a + 500.0 - *b).length()).fold(0.0, f32::max);
        // Two roundings at 750 mm, each of half of 2^-14 mm an axis.
        prop_assert!(apart < 2e-4, "{apart} mm, {settings:?}");
    }

    #[test]
    fn what_stays_stays_to_the_bit_and_a_plane_stays_a_plane(settings in settings(), seed in 0..1000u32) {
        let settings = Smoothing { boundary: Boundary::Vtk15, ..settings };
        let n = 14;
        // Jittered within the plane z = 3.
        let jitter = |i: u32| f32::from((i.wrapping_mul(2_654_435_761).wrapping_add(seed * 7919) >> 16) as u16) / 65536.0 - 0.5;
        let mut mesh = lattice(n, |_| 0.0);
        for (i, p) in mesh.positions.iter_mut().enumerate() {
            *p = Vec3::new(p.x + 0.4 * jitter(i as u32), p.y + 0.4 * jitter(i as u32 + 9999), 3.0);
        }
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let after = run(&mesh, &topology, &settings);
        prop_assert!(after.iter().all(|p| (p.z - 3.0).abs() < 1e-5 && p.is_finite()));
        // Corners of the sheet turn by 60 degrees and more.
        for corner in [0, n, (n + 1) * n, (n + 1) * (n + 1) - 1] {
            prop_assert_eq!(after[corner as usize], mesh.positions[corner as usize]);
        }
    }

    #[test]
    fn the_volume_is_held_where_that_is_asked_for(settings in settings(), phantom in 0..2usize, all in any::<bool>()) {
        let preserving = Smoothing { preserve_volume: true, ..settings };
        let keep = if all { Keep::All } else { Keep::Largest };
        let mut pipeline = Pipeline::new(PHANTOMS[phantom].clone(), Settings { keep, smoothing: preserving, ..Settings::default() });
        let after = smoothed(&mut pipeline);
        let kept = pipeline.kept().unwrap();
        let (v0, v1) = (kept.measures.volume_mm3.unwrap(), after.measures.volume_mm3.unwrap());
        if after.volume_held == Some(true) {
            prop_assert!((v1 / v0 - 1.0).abs() <= 1e-4, "{v0} {v1} {settings:?}");
        } else {
            // Only where smoothing leaves hardly a form to put the volume back to, and then as without.
            let plain = TriMesh { positions: run(&kept.mesh, &kept.topology, &settings), triangles: kept.mesh.triangles.clone() };
            prop_assert_eq!(after.volume_held, Some(false));
            prop_assert!(after.mesh.positions == plain.positions);
            prop_assert!(crossing(&plain) > 0.002, "given up where {} of all faces cross, {settings:?}", crossing(&plain));
        }
        if after.volume_held == Some(true) {
            prop_assert!(crossing(&after.mesh) < 0.03, "{} of all faces cross, {settings:?}", crossing(&after.mesh));
        }
        // Flat loops stay flat to within half a voxel, about half an edge; others, tiny ones, come no farther out.
        let edge = lumen::mesh::rms_edge(&kept.mesh);
        for chain in kept.loops.as_ref().unwrap() {
            let (middle, normal) = plane(chain, |v| kept.mesh.positions[v as usize].as_dvec3());
            let off = |p: &TriMesh| {
                let distances = chain.iter().map(|&v| (p.positions[v as usize].as_dvec3() - middle).dot(normal).abs());
                distances.fold(0.0, f64::max)
            };
            prop_assert!(off(&after.mesh) <= off(&kept.mesh) + edge / 2.0, "{} {}", off(&after.mesh), off(&kept.mesh));
        }
    }
}

/// The middle of a loop and the normal of its plane (Newell).
fn plane(chain: &[u32], at: impl Fn(u32) -> DVec3) -> (DVec3, DVec3) {
    let middle = chain.iter().map(|&v| at(v)).sum::<DVec3>() / chain.len() as f64;
    let pairs = chain.iter().zip(chain.iter().cycle().skip(1));
    (middle, pairs.map(|(&a, &b)| (at(a) - middle).cross(at(b) - middle)).sum::<DVec3>().normalize())
}

/// A sheet of n x n rhombi of the regular triangular lattice with edges of 1 mm, raised by `z`.
fn lattice(n: u32, z: impl Fn(DVec2) -> f64) -> TriMesh {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let place = |(i, j): (u32, u32)| {
        let p = DVec2::new(f64::from(i) + f64::from(j) / 2.0, f64::from(j) * 3f64.sqrt() / 2.0);
        DVec3::new(p.x, p.y, z(p)).as_vec3()
    };
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    TriMesh {
        positions: (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))).map(place).collect(),
        triangles: cells
            .flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]])
            .collect(),
    }
}

/// How much of a wave of `length` mm that runs at `direction` is left in the middle of the lattice.
fn left_of_wave(length: f64, direction: f64, settings: &Smoothing) -> f64 {
    // What a vertex becomes depends on those within as many edges as there are iterations: none is at the rim.
    let n = 2 * settings.iterations + 12;
    let along = DVec2::from_angle(direction) * (2.0 * PI / length);
    let middle = DVec2::new(f64::from(n) * 0.75, f64::from(n) * 3f64.sqrt() / 4.0);
    let wave = |p: DVec2| 0.5 * (p - middle).dot(along).cos();
    let mesh = lattice(n, wave);
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let after = run(&mesh, &topology, settings);
    let v = (n / 2 * (n + 1) + n / 2) as usize;
    let crest = mesh.positions[v];
    assert!((f64::from(crest.z) - 0.5).abs() < 1e-3, "the wave has a crest in the middle: {crest}");
    assert!((after[v].truncate() - crest.truncate()).length() < 1e-4, "the lattice itself is not pulled about");
    f64::from(after[v].z) / f64::from(crest.z)
}

#[test]
fn a_wave_on_a_flat_lattice_is_damped_as_the_response_says() {
    for settings in [
        Smoothing { pass_band: 0.1, iterations: 40, ..Smoothing::PAPER },
        Smoothing { pass_band: 0.05, iterations: 60, window: Window::Nuttall, ..Smoothing::PAPER },
    ] {
        let filter = Filter::new(&settings);
        let half = filter.half_gain().unwrap();
        let half_wave = wavelength(half, 1.0).unwrap();
        for length in
            [2.5, 4.0, 0.8 * half_wave, half_wave, 1.3 * half_wave, wavelength(settings.pass_band, 1.0).unwrap(), 60.0]
        {
            for direction in [0.0, 0.2, PI / 6.0] {
                let w = DVec2::from_angle(direction) * (2.0 * PI / length);
                let cosines = (0..6).map(|i| w.dot(DVec2::from_angle(PI / 3.0 * f64::from(i))).cos()).sum::<f64>();
                let exact = filter.response(1.0 - cosines / 6.0);
                let left = left_of_wave(length, direction, &settings);
                assert!((left - exact).abs() < 2e-3, "{length} mm at {direction}: {left}, the lattice says {exact}");
                // What is stated is the mean over directions.
                let stated = filter.response(lumen::pipeline::response::eigenvalue(length, 1.0));
                assert!((left - stated).abs() < 0.02, "{length} mm at {direction}: {left}, stated {stated}");
            }
        }
    }
}

/// Mean and spread of the radius between two heights.
fn radius_within(mesh: &TriMesh, from: f32, to: f32) -> (f64, f64) {
    let within = mesh.positions.iter().filter(|p| (from..to).contains(&p.z));
    let radii: Vec<f64> = within.map(|p| f64::from(p.truncate().length())).collect();
    let mean = radii.iter().sum::<f64>() / radii.len() as f64;
    let squares = radii.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>();
    (mean, (squares / radii.len() as f64).sqrt())
}

#[test]
fn thin_vessels_keep_their_calibre_and_lose_their_teeth_where_the_pass_band_adapts() {
    for radius in [1.0, 1.5, 2.5, 5.0] {
        let mesh = tube(radius, 40.0, 0.6, 0.1);
        let smoothing = Smoothing { adapt: true, ..Smoothing::PAPER };
        let made = |smoothing| {
            let mut pipeline = Pipeline::new(Arc::new(mesh.clone()), all_pieces(smoothing));
            let (mean, spread) = radius_within(&smoothed(&mut pipeline).mesh, 12.0, 28.0);
            (mean / radius - 1.0, spread)
        };
        let ((adapted, rough), (plain, _)) = (made(smoothing), made(Smoothing::PAPER));
        // Bumps of 0.035 mm in the mean are gone; open ends make the radius swing by half a percent.
        assert!(adapted.abs() < 0.01 && rough < 0.01 * radius, "{radius} mm: {adapted:+.4}, {rough:.4} mm rough");
        assert!(radius > 2.0 || plain < -0.1, "{radius} mm: the paper's filter takes {plain:+.3}");
    }
}

#[test]
fn a_vessel_that_narrows_keeps_both_its_calibres() {
    let radius = |z: f64| if z < 30.0 { 6.0 } else { 6.0 - 5.0 * ((z - 30.0) / 15.0).min(1.0) };
    let mesh = Arc::new(turned(40, 90.0, 0.6, 0.0, radius));
    let smoothing = Smoothing { adapt: true, ..Smoothing::PAPER };
    let mut pipeline = Pipeline::new(mesh.clone(), all_pieces(smoothing));
    let after = smoothed(&mut pipeline).mesh.clone();
    for (from, to) in [(8.0, 26.0), (32.0, 43.0), (48.0, 80.0)] {
        let ([(before, _), (after, _)], place) = ([&*mesh, &*after].map(|mesh| radius_within(mesh, from, to)), from);
        assert!((after / before - 1.0).abs() < 0.01, "from {place} mm: {before} to {after}");
    }
}

#[test]
fn a_stenosis_keeps_its_radius_at_its_throat_and_its_shoulders() {
    // 70 % by diameter, of a vessel of 6 mm, sampled at half a millimetre.
    let radius = |z: f64| 3.0 - 1.05 * (1.0 + (PI * ((z - 30.0) / 6.0).clamp(-1.0, 1.0)).cos());
    let mesh = Arc::new(turned(38, 60.0, 0.5, 0.1, radius));
    let smoothing = Smoothing { adapt: true, ..Smoothing::PAPER };
    let after = smoothed(&mut Pipeline::new(mesh.clone(), all_pieces(smoothing))).mesh.clone();
    for (from, to) in [(14.0, 22.0), (22.0, 25.0), (25.0, 28.0), (29.0, 31.0), (32.0, 35.0), (35.0, 38.0), (38.0, 46.0)]
    {
        let of = |mesh: &TriMesh| {
            let within = mesh.positions.iter().filter(|p| (from..to).contains(&p.z));
            let parts: Vec<f64> = within.map(|p| f64::from(p.truncate().length()) / radius(f64::from(p.z))).collect();
            parts.iter().sum::<f64>() / parts.len() as f64 - 1.0
        };
        let change = of(&after) - of(&mesh);
        // 1 % is asked; without what is put back it is 1.4 % at the first shoulder.
        assert!(change.abs() < 0.008, "from {from} mm: {:+.2} %", 100.0 * change);
    }
}

/// The faces that cross others after smoothing and crossed none before.
fn newly_crossing(before: &TriMesh, after: &TriMesh) -> usize {
    let crossed = self_intersections(before);
    self_intersections(after).into_iter().filter(|t| crossed.binary_search(t).is_err()).count()
}

#[test]
fn no_triangles_cross_that_did_not_and_far_from_them_the_filter_is_the_plain_one_to_the_bit() {
    let mesh = &PHANTOMS[1];
    let made = |guard| {
        let mut pipeline = Pipeline::new(mesh.clone(), all_pieces(Smoothing { guard, ..Smoothing::PAPER }));
        smoothed(&mut pipeline)
    };
    let (plain, guarded) = (made(false), made(true));
    let crossing = newly_crossing(mesh, &plain.mesh);
    assert!(crossing > 100, "the paper's filter makes only {crossing} faces cross: this proves little");
    assert_eq!(newly_crossing(mesh, &guarded.mesh), 0);
    let weakened = guarded.weakened.as_ref().expect("something was weakened");
    assert_eq!(weakened.spared, crossing);
    let (mut whole, mut none) = (0, 0);
    for (v, &part) in weakened.parts.iter().enumerate() {
        let [before, after, alone] = [mesh, &guarded.mesh, &plain.mesh].map(|mesh| mesh.positions[v]);
        match part {
            0.0 => assert!(after == alone),
            1.0 => assert!(after == before),
            part => assert!(after.distance(alone.lerp(before, part)) < 1e-4),
        }
        whole += usize::from(part == 1.0);
        none += usize::from(part == 0.0);
    }
    let count = mesh.positions.len();
    assert!(none > count / 4 && whole < count / 2, "{none} untouched and {whole} put back of {count}");
    // It fades out: no edge joins what is put back to what is smoothed.
    for [a, b, c] in &mesh.triangles {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let step = (weakened.parts[*a as usize] - weakened.parts[*b as usize]).abs();
            assert!(step < 0.2, "{step} from a vertex to the next");
        }
    }
}

#[test]
fn where_nothing_would_cross_the_guard_changes_no_bit_and_says_nothing() {
    let mesh = Arc::new(tube(5.0, 40.0, 0.6, 0.1));
    let [off, on] = [false, true].map(|guard| {
        let smoothing = Smoothing { guard, ..Smoothing::PAPER };
        smoothed(&mut Pipeline::new(mesh.clone(), all_pieces(smoothing)))
    });
    assert!(self_intersections(&off.mesh).is_empty());
    assert!(off.mesh.positions == on.mesh.positions && on.weakened.is_none());
    assert!(on.crosses_nothing && !off.crosses_nothing, "what was not looked at is not known");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Crumpled tubes through and beside each other: some faces cross before, more would after.
    #[test]
    fn crumpled_tubes_never_cross_where_they_did_not(
        noise in 0.0..1.5f64, apart in 0.0..7.0f32, lean in 0.0..1.0f32, settings in settings(), adapt in any::<bool>(),
    ) {
        let tubes = [tube(1.5, 14.0, 0.7, noise), tube(1.2, 14.0, 0.7, noise / 2.0), tube(3.0, 14.0, 0.9, noise)];
        let mut mesh = TriMesh::default();
        for (i, tube) in tubes.into_iter().enumerate() {
            let first = mesh.positions.len() as u32;
            let moved = |p: &Vec3| *p + i as f32 * Vec3::new(apart / 2.0 + lean * (p.z - 7.0), 0.0, 0.0);
            mesh.positions.extend(tube.positions.iter().map(moved));
            mesh.triangles.extend(tube.triangles.iter().map(|t| t.map(|v| v + first)));
        }
        let smoothing = Smoothing { guard: true, adapt, ..settings };
        let mesh = Arc::new(mesh);
        let after = smoothed(&mut Pipeline::new(mesh.clone(), all_pieces(smoothing)));
        prop_assert_eq!(newly_crossing(&mesh, &after.mesh), 0);
        if after.crosses_nothing {
            prop_assert!(self_intersections(&after.mesh).is_empty());
        }
    }

    #[test]
    fn another_pass_band_for_each_vertex_from_kept_terms_is_a_run_of_its_own_to_the_bit(
        settings in settings(), other in settings(), phantom in 0..2usize,
    ) {
        let mesh = &PHANTOMS[phantom];
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let bands: Vec<f32> = mesh.positions.iter().map(|p| 0.02 * (2.0 + (p.z * 0.1).sin())).collect();
        let terms = terms(mesh, &topology, &settings);
        let other = Smoothing { iterations: other.iterations.min(terms.degree() as u32), boundary: settings.boundary, ..other };
        let (own, _) = at_once(smooth_varying(&mesh.positions, &topology, &other, &bands, 0, &Yielder::never()));
        prop_assert!(terms.smooth_varying(&other, &bands) == own);
    }
}

#[test]
fn where_no_wall_faces_another_the_adapted_filter_is_the_plain_one_to_the_bit() {
    let flat = turned(40, 20.0, 0.6, 0.0, |_| 6.0);
    // Rolled out: the same triangles on a plane, with a saw.
    let flat = TriMesh {
        positions: flat
            .positions
            .iter()
            .enumerate()
            .map(|(i, p)| Vec3::new((i % 40) as f32 * 0.9, p.z, (i % 3) as f32 * 0.1))
            .collect(),
        triangles: flat.triangles.into_iter().filter(|t| t.iter().map(|v| v % 40).max() != Some(39)).collect(),
    };
    let [plain, adapted] = [false, true].map(|adapt| {
        let smoothing = Smoothing { adapt, ..Smoothing::PAPER };
        smoothed(&mut Pipeline::new(Arc::new(flat.clone()), all_pieces(smoothing))).mesh.positions.clone()
    });
    assert!(plain == adapted);
}

/// A tube about the z axis with a noisy wall and open, round ends.
pub(crate) fn tube(radius: f64, length: f64, edge: f64, noise: f64) -> TriMesh {
    turned(((2.0 * PI * radius / edge).ceil() as u32).max(6), length, edge, noise, |_| radius)
}

/// The same with `radius(z)`, of `around` sides.
pub(crate) fn turned(around: u32, length: f64, edge: f64, noise: f64, radius: impl Fn(f64) -> f64) -> TriMesh {
    let rings = (length / edge).ceil() as u32 + 1;
    let mut mesh = TriMesh::default();
    for ring in 0..rings {
        for i in 0..around {
            let angle = 2.0 * PI * (f64::from(i) + f64::from(ring % 2) / 2.0) / f64::from(around);
            let bump = f64::from((ring * 31 + i * 17) % 5) / 4.0 - 0.5;
            let z = f64::from(ring) * edge;
            let r = radius(z) + if ring == 0 || ring + 1 == rings { 0.0 } else { noise * bump };
            mesh.positions.push(DVec3::new(r * angle.cos(), r * angle.sin(), z).as_vec3());
        }
    }
    for ring in 0..rings - 1 {
        for i in 0..around {
            let j = (i + 1) % around;
            let (a, b) = (ring * around, (ring + 1) * around);
            let quad = if ring % 2 == 0 {
                [[a + i, a + j, b + i], [a + j, b + j, b + i]]
            } else {
                [[a + i, b + j, b + i], [a + i, a + j, b + j]]
            };
            mesh.triangles.extend(quad);
        }
    }
    mesh
}

#[test]
fn a_thin_vessel_keeps_its_calibre_where_the_volume_is_held_and_is_not_swollen_beside_a_wide_one() {
    // A vessel of 1.5 mm beside one of 20 mm. What the thin one loses at the narrower pass band, more than half of its
    // calibre, is too little of the whole to be found again by one offset or a scaling for both.
    let (thin, wide) = (tube(0.75, 30.0, 0.3, 0.1), tube(10.0, 60.0, 1.0, 0.4));
    let shift = thin.positions.len() as u32;
    let positions = thin.positions.iter().copied().chain(wide.positions.iter().map(|p| *p + Vec3::X * 40.0));
    let triangles = thin.triangles.iter().copied().chain(wide.triangles.iter().map(|t| t.map(|v| v + shift)));
    let both = Arc::new(TriMesh { positions: positions.collect(), triangles: triangles.collect() });
    for (pass_band, iterations) in [(0.1, 60), (0.02, 100)] {
        let smoothing = Smoothing { pass_band, iterations, ..Smoothing::PAPER };
        // Mean radius in the middle third of each.
        let radii = |preserve_volume: bool| {
            let mut pipeline = Pipeline::new(both.clone(), all_pieces(Smoothing { preserve_volume, ..smoothing }));
            let after = smoothed(&mut pipeline);
            assert_eq!(after.volume_held, preserve_volume.then_some(true));
            let mean = |positions: &[Vec3], x: f32, length: f32| {
                let middle = positions.iter().filter(|p| (length / 3.0..length / 1.5).contains(&p.z));
                let radii: Vec<f64> = middle.map(|p| f64::from((p.truncate() - glam::Vec2::X * x).length())).collect();
                radii.iter().sum::<f64>() / radii.len() as f64
            };
            let (a, b) = after.mesh.positions.split_at(shift as usize);
            (mean(a, 0.0, 30.0), mean(b, 40.0, 60.0))
        };
        let (plain, held) = (radii(false), radii(true));
        assert!((plain.0 < 0.5) == (pass_band < 0.05), "the thin one is hurt: {plain:?}");
        assert!((held.0 / 0.75 - 1.0).abs() < 0.05, "the thin one: {held:?} beside {plain:?}");
        assert!((held.1 / 10.0 - 1.0).abs() < 0.002, "the wide one: {held:?} beside {plain:?}");
    }
}

#[test]
fn a_thin_tree_is_not_torn_for_its_volume() {
    // In cm, as some files are, 24 mm across; and so coarse that smoothing leaves no more of it than lines.
    let [fine, coarse] = [30_000, 2_000].map(|count| {
        let mut tree = generate(Sample::Coronary, count).unwrap();
        tree.positions.iter_mut().for_each(|p| *p *= 0.1);
        Arc::new(tree)
    });
    let settings = [(0.1, 20), (0.1, 60), (0.01, 60), (0.001, 100)];
    let cases = settings.map(|(pass_band, iterations)| (&fine, pass_band, iterations, true));
    for (tree, pass_band, iterations, is_held) in cases.into_iter().chain([(&coarse, 0.01, 60, false)]) {
        let [plain, asked] = [false, true].map(|preserve_volume| {
            let smoothing = Smoothing { pass_band, iterations, preserve_volume, ..Smoothing::PAPER };
            smoothed(&mut Pipeline::new(tree.clone(), all_pieces(smoothing)))
        });
        assert_eq!(asked.volume_held, Some(is_held), "{pass_band}");
        if is_held {
            assert!(crossing(&asked.mesh) < 0.01, "{pass_band}: {} of all faces cross", crossing(&asked.mesh));
        } else {
            assert!(asked.mesh == plain.mesh && asked.measures == plain.measures);
            assert!(crossing(&plain.mesh) > 0.01, "the filter alone has drawn vessels to lines");
        }
    }
}

#[test]
fn a_change_of_pass_band_or_window_goes_by_the_terms_and_gives_what_a_fresh_run_gives() {
    for base in [Smoothing::PAPER, Smoothing { adapt: true, ..Smoothing::PAPER }] {
        let mesh = &PHANTOMS[0];
        let first = Smoothing { iterations: 60, ..base };
        let mut pipeline = Pipeline::new(mesh.clone(), all_pieces(first)).with_samples(500);
        pipeline.finish().unwrap();
        assert!(pipeline.can_prepare());
        while pipeline.prepare(Budget::new(Duration::ZERO)) {}
        assert!(!pipeline.can_prepare());
        for change in [
            Smoothing { pass_band: 0.2, ..first },
            Smoothing { window: Window::Nuttall, iterations: 20, ..first },
            Smoothing { preserve_volume: true, ..first },
            Smoothing { iterations: 80, ..first },
            Smoothing { iterations: 75, pass_band: 0.05, ..first },
            Smoothing { boundary: Boundary::Vtk15, ..first },
        ] {
            pipeline.set(all_pieces(change)).unwrap();
            assert_eq!(pipeline.next_stage(), Some(Stage::Smoothing));
            let after = smoothed(&mut pipeline);
            let fresh = smoothed(&mut Pipeline::new(mesh.clone(), all_pieces(change)));
            assert!(after.mesh == fresh.mesh && after.volume_held == fresh.volume_held, "{change:?}");
        }
    }
}

#[test]
fn whatever_comes_in_has_an_answer() {
    let slivers = TriMesh {
        positions: (0..40).map(|i| Vec3::new(i as f32 * 1e-3, if i % 2 == 0 { 0.0 } else { 1e-12 }, 0.0)).collect(),
        triangles: (0..38).map(|i| [i, i + 1, i + 2]).collect(),
    };
    let needles =
        TriMesh { positions: vec![Vec3::ZERO; 9], triangles: vec![[0, 1, 2], [2, 1, 3], [4, 5, 6], [6, 7, 8]] };
    let blades = (0..7u32).map(|i| [0, 1, i + 2]);
    let fan = TriMesh {
        positions: (0..9).map(|i| Vec3::new(i as f32, (i * i) as f32 * 0.1, (i % 3) as f32)).collect(),
        triangles: blades.collect(),
    };
    let single = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
    // 5,594 tetrahedra.
    let mut many = TriMesh::default();
    for i in 0..5594u32 {
        let corner = Vec3::new((i % 75) as f32, (i / 75) as f32, 0.0) * 3.0;
        many.positions.extend([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|p| corner + p));
        many.triangles.extend([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|t| t.map(|v| 4 * i + v)));
    }
    // A star: one vertex with 70,000 neighbours.
    let rim = 70_000u32;
    let angle = |i: u32| 2.0 * PI * f64::from(i) / f64::from(rim);
    let star = TriMesh {
        positions: std::iter::once(Vec3::Z)
            .chain((0..rim).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), 0.0).as_vec3()))
            .collect(),
        triangles: (0..rim).map(|i| [0, i + 1, (i + 1) % rim + 1]).collect(),
    };
    for (name, mesh) in [
        ("nothing", TriMesh::default()),
        ("slivers", slivers),
        ("needles", needles),
        ("fan", fan),
        ("single", single),
        ("many", many),
        ("star", star),
    ] {
        let mesh = Arc::new(mesh);
        for preserve_volume in [false, true] {
            for iterations in [0, 1, 40] {
                let smoothing = Smoothing { iterations, preserve_volume, ..Smoothing::PAPER };
                let mut pipeline =
                    Pipeline::new(mesh.clone(), Settings { target: Target::Reduction(0), ..all_pieces(smoothing) });
                let after = smoothed(&mut pipeline);
                assert_eq!(after.mesh.triangles, mesh.triangles, "{name}");
                assert!(after.mesh.positions.iter().all(|p| p.is_finite()), "{name} x {iterations}");
                if let (Some(true), Some(before), Some(volume)) =
                    (after.volume_held, pipeline.kept().unwrap().measures.volume_mm3, after.measures.volume_mm3)
                {
                    assert!((volume - before).abs() <= 1e-4 * before.abs(), "{name}: {before} {volume}");
                }
                if name == "fan" {
                    assert_eq!(after.mesh.positions[..2], mesh.positions[..2], "the axis of a fan stays");
                }
            }
        }
    }
}

#[test]
fn settings_out_of_range_are_refused_by_name() {
    let mut pipeline = Pipeline::new(PHANTOMS[0].clone(), Settings::default());
    let refused = |smoothing: Smoothing, pipeline: &mut Pipeline| pipeline.set(all_pieces(smoothing)).unwrap_err();
    for pass_band in [f64::NAN, f64::INFINITY, 0.0, -1.0, 2.1] {
        let error = refused(Smoothing { pass_band, ..Smoothing::PAPER }, &mut pipeline);
        assert!(
            matches!(error, SettingsError::Range(OutOfRange::PassBand { .. }))
                && error.to_string().contains("pass band")
        );
    }
    let error = refused(Smoothing { iterations: 201, ..Smoothing::PAPER }, &mut pipeline);
    assert_eq!(error, SettingsError::Range(OutOfRange::Iterations { value: 201.0 }));
}
