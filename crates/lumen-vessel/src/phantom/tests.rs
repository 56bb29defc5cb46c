//! Facts about whole samples: what the anatomy says must be found in the mesh.

use super::*;
use lumen_mesh::mending::wall::{WallFound, find};
use lumen_mesh::shapes::vertices_are_manifold;
use lumen_mesh::{Topology, boundary_loops, triangle_area, volume};

fn default_mesh(sample: Sample) -> TriMesh {
    generate(sample, sample.default_triangles()).expect("the default is in range")
}

/// The largest component of a mesh as a mesh.
fn largest(mesh: &TriMesh) -> TriMesh {
    let found = components(mesh.positions.len(), &mesh.triangles);
    let main = found.largest().expect("there are triangles");
    mesh.filtered(|t| found.of_triangle[t] == main)
}

fn open_ends(sample: Sample) -> usize {
    vessels(sample).iter().map(|v| usize::from(v.open_start) + usize::from(v.open_end)).sum()
}

/// The vessel tree is one piece of genus 0, open at the ends of its vessels and nowhere else.
fn assert_is_a_tree(sample: Sample, mesh: &TriMesh) {
    let tree = largest(mesh);
    let topology = Topology::new(tree.positions.len(), &tree.triangles);
    let loops = boundary_loops(&topology);
    assert_eq!(loops.len(), open_ends(sample));
    for chain in &loops {
        let mut vertices = chain.clone();
        vertices.sort_unstable();
        vertices.dedup();
        assert_eq!(vertices.len(), chain.len(), "a loop passes each of its vertices once");
    }
    let counts = topology.edge_counts();
    let euler = tree.positions.len() as i64 - counts.edges as i64 + tree.triangles.len() as i64;
    assert_eq!(euler, 2 - loops.len() as i64);
}

fn assert_is_a_clean_surface_with_islands(mesh: &TriMesh, least_area: f64) {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let counts = topology.edge_counts();
    assert_eq!((counts.non_manifold, counts.flipped), (0, 0));
    assert!(volume(mesh, &topology) > 0.0);
    assert!((0..mesh.positions.len() as u32).all(|v| !topology.triangles(v).is_empty()));
    assert!(vertices_are_manifold(mesh, &topology));
    let mut sorted = mesh.triangles.clone();
    sorted.iter_mut().for_each(|t| t.sort_unstable());
    sorted.sort_unstable();
    assert!(sorted.windows(2).all(|pair| pair[0] != pair[1]));
    assert!((0..mesh.triangles.len()).all(|t| triangle_area(mesh.corners(t)) > least_area));

    let mut sizes = components(mesh.positions.len(), &mesh.triangles).triangle_counts;
    sizes.sort_unstable();
    sizes.pop();
    assert!((8..=15).contains(&sizes.len()), "{sizes:?}");
    assert!(sizes.iter().all(|size| (20..=400).contains(size)), "{sizes:?}");
}

/// Whether the wall of another vessel, or an end, is so near that a cross-section here is not this vessel's alone.
fn is_disturbed(all: &[Vessel], this: usize, i: usize, voxel: f64) -> bool {
    let station = all[this].stations[i];
    let reach = station.diameter / 2.0 + 2.0 + 2.0 * voxel;
    let ends = [0, all[this].stations.len() - 1].map(|end| all[this].stations[end]);
    ends.iter().any(|end| end.position.distance(station.position) < reach)
        || all.iter().enumerate().any(|(other, vessel)| {
            let near = |s: &Station| s.position.distance(station.position) < reach + s.diameter / 2.0;
            other != this && vessel.stations.iter().any(near)
        })
}

/// Twice the mean distance from the centreline of the wall's vertices in a slab across it, and how many there are.
fn measured_diameter(mesh: &TriMesh, station: Station, along: DVec3, voxel: f64) -> (f64, usize) {
    let (mut sum, mut count) = (0.0, 0);
    for p in &mesh.positions {
        let from = p.as_dvec3() - station.position;
        let height = from.dot(along);
        let radius = (from - along * height).length();
        if height.abs() < 0.75 * voxel && radius < station.diameter / 2.0 + 1.5 * voxel {
            sum += radius;
            count += 1;
        }
    }
    (2.0 * sum / f64::from(count.max(1)), count as usize)
}

/// Measures every vessel at up to three stations; returns the smallest diameter found.
fn assert_lumens_have_their_diameters(sample: Sample, mesh: &TriMesh, skipped: &[&str]) -> f64 {
    let voxel = sample.default_spacing() * SLICE_RATIO;
    let all = vessels(sample);
    let mut smallest = f64::INFINITY;
    for (v, vessel) in all.iter().enumerate() {
        let free = (vessel.ostium..vessel.stations.len()).filter(|&i| !is_disturbed(&all, v, i, voxel));
        let free: Vec<usize> = free.collect();
        assert!(!free.is_empty() || skipped.contains(&vessel.name), "{} has no stretch of its own", vessel.name);
        for i in [0, free.len() / 2, free.len().saturating_sub(1)].into_iter().filter_map(|at| free.get(at)) {
            let station = vessel.stations[*i];
            let (found, vertices) = measured_diameter(mesh, station, vessel.direction(*i), voxel);
            assert!(vertices >= 8, "{} at station {i}: {vertices} vertices", vessel.name);
            let error = (found - station.diameter).abs();
            assert!(error < voxel, "{} at station {i}: {found} for {} mm", vessel.name, station.diameter);
            smallest = smallest.min(found);
        }
    }
    smallest
}

#[test]
fn the_aorta_is_what_the_paper_counts_and_anatomy_says() {
    let mesh = default_mesh(Sample::Aorta);
    assert_eq!(largest(&mesh).triangles.len(), 74_307);
    assert_is_a_tree(Sample::Aorta, &mesh);
    assert_is_a_clean_surface_with_islands(&mesh, 1e-3);
    assert_lumens_have_their_diameters(Sample::Aorta, &mesh, &[]);
}

#[test]
fn the_aorta_by_surface_nets_is_the_same_tree() {
    let mesh = default_mesh(Sample::AortaNets);
    assert_eq!(largest(&mesh).triangles.len(), Sample::AortaNets.default_triangles());
    assert_is_a_tree(Sample::AortaNets, &mesh);
    assert_is_a_clean_surface_with_islands(&mesh, 0.0);
    assert_lumens_have_their_diameters(Sample::AortaNets, &mesh, &[]);
}

#[test]
fn the_coronary_tree_is_whole_down_to_branches_of_1_5_mm() {
    let mesh = default_mesh(Sample::Coronary);
    assert_eq!(largest(&mesh).triangles.len(), Sample::Coronary.default_triangles());
    assert!(Sample::Coronary.default_spacing() <= 0.4);
    assert_is_a_tree(Sample::Coronary, &mesh);
    assert_is_a_clean_surface_with_islands(&mesh, 1e-3);
    let smallest = assert_lumens_have_their_diameters(Sample::Coronary, &mesh, &["left main coronary artery"]);
    assert!((1.2..1.8).contains(&smallest), "{smallest}");
}

#[test]
fn coronary_ostia_are_3_to_4_mm_wide_and_in_the_sinuses() {
    for vessel in vessels(Sample::Coronary) {
        if ["left main coronary artery", "right coronary artery"].contains(&vessel.name) {
            let ostium = vessel.stations[vessel.ostium];
            assert!((3.0..4.2).contains(&ostium.diameter), "{ostium:?}");
            assert!((5.0..19.0).contains(&ostium.position.z), "{ostium:?}");
        }
    }
}

#[test]
fn other_counts_are_hit_to_one_per_cent() {
    // With the counts from which on the grid is fine enough for the whole tree.
    let samples = [(Sample::Aorta, 2_000), (Sample::Coronary, 10_000)];
    for (sample, whole_from) in samples {
        for wanted in [2_000, 5_000, 10_000, 20_000, 100_000, 300_000, 1_000_000] {
            let mesh = generate(sample, wanted).unwrap_or_else(|e| panic!("{sample}: {e}"));
            let found = largest_component(&mesh);
            assert!(found.abs_diff(wanted) * 100 <= wanted, "{sample} {wanted}: {found}");
            if wanted >= whole_from {
                assert_is_a_tree(sample, &mesh);
            }
        }
    }
}

#[test]
fn progress_never_falls_and_ends_at_one_and_cancels() {
    for triangles in [20_000, Sample::Aorta.default_triangles()] {
        let mut heard = Vec::new();
        let mesh = generate_with(Sample::Aorta, triangles, &mut |fraction| {
            heard.push(fraction);
            ControlFlow::Continue(())
        });
        assert!(mesh.is_ok());
        assert!(heard.is_sorted() && heard.first() >= Some(&0.0) && heard.last() == Some(&1.0));
        let mut left = heard.len() / 2;
        let cancelled = generate_with(Sample::Aorta, triangles, &mut |_| {
            left -= 1;
            if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(cancelled, Err(PhantomError::Cancelled));
    }
}

#[test]
fn counts_out_of_range_are_refused_with_the_number() {
    for asked in [0, MIN_TRIANGLES - 1, MAX_TRIANGLES + 1] {
        assert_eq!(
            generate(Sample::Aorta, asked),
            Err(PhantomError::TrianglesOutOfRange { asked, least: MIN_TRIANGLES, most: MAX_TRIANGLES })
        );
    }
}

#[test]
fn names_are_read_back() {
    for sample in Sample::ALL {
        assert_eq!(sample.name().parse(), Ok(sample));
        assert_eq!(serde_json::to_string(&sample).expect("a plain string"), format!("{:?}", sample.name()));
    }
    assert_eq!("heart".parse::<Sample>(), Err(UnknownSample { name: "heart".to_owned() }));
}

#[test]
fn samples_have_no_wall_with_two_sides() {
    for sample in Sample::ALL {
        assert_eq!(find(&generate(sample, 20_000).unwrap(), true), WallFound { wall: None, lumen: None });
    }
}
