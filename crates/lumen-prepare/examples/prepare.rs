//! Cuts, extends and caps the ends of vessel surfaces, and prints what came of each: `prepare FILE...`.

use lumen_io::{ImportOptions, read};
use lumen_mesh::{Topology, TriMesh, self_intersections};
use lumen_prepare::cap::{CapKind, cap};
use lumen_prepare::clip::{Clipped, clip};
use lumen_prepare::ends::{EndPlane, Length, OpenEnd, propose};
use lumen_prepare::extend::{ExtendError, extend};
use lumen_vessel::Tree;

/// Cuts at every plane that can be cut, and tells why others cannot.
fn clip_what_can_be(mesh: &TriMesh, planes: &[EndPlane]) -> Clipped {
    let mut kept: Vec<EndPlane> = Vec::new();
    for plane in planes {
        kept.push(plane.clone());
        if let Err(error) = clip(mesh, &kept) {
            println!("  not cut: branch {}: {error}", plane.branch + 1);
            kept.pop();
        }
    }
    clip(mesh, &kept).expect("it was cut before")
}

fn main() {
    for path in std::env::args().skip(1) {
        let bytes = std::fs::read(&path).expect("a file that can be read");
        let mesh = match read(&bytes, &path, &ImportOptions::default()) {
            Ok(imported) => imported.mesh,
            Err(error) => {
                println!("{path}: {error}");
                continue;
            }
        };
        let counts = |mesh: &TriMesh| Topology::new(mesh.positions.len(), &mesh.triangles).edge_counts();
        let before = counts(&mesh);
        println!("{path}: {} triangles, {before:?}", mesh.triangles.len());
        let tree = match Tree::new(&mesh) {
            Ok(tree) => tree,
            Err(error) => {
                println!("  no tree: {error}");
                continue;
            }
        };
        let started = std::time::Instant::now();
        let proposal = propose(&mesh, &tree).expect("a sound surface");
        let proposed_s = started.elapsed().as_secs_f64();
        for error in &proposal.refused {
            println!("  refused: {error}");
        }
        let clipped = clip_what_can_be(&mesh, &proposal.planes);
        let started = std::time::Instant::now();
        let planes: Vec<EndPlane> = proposal.planes.clone();
        let _ = clip(&mesh, &planes);
        let clipped_s = started.elapsed().as_secs_f64();
        println!(
            "  {} branches, {} ends proposed, {} refused, {} cut ({proposed_s:.2} s, {clipped_s:.2} s), {} triangles cross, {} before",
            tree.branches().len(),
            proposal.planes.len(),
            proposal.refused.len(),
            clipped.ends.len(),
            self_intersections(&clipped.mesh).len(),
            self_intersections(&mesh).len(),
        );
        let (mut surface, mut ends) = (clipped.mesh, clipped.ends);
        let mut extended = 0;
        for i in 0..ends.len() {
            let one: [OpenEnd; 1] = [ends[i].clone()];
            let mut length = Length::Radii(5.0);
            for _ in 0..2 {
                match extend(&surface, &one, &[length]) {
                    Ok(found) => {
                        surface = found.mesh;
                        ends[i] = found.ends[0].clone();
                        extended += 1;
                        break;
                    }
                    Err(ExtendError::Collides { free }) if free[0].1 > 0.0 => {
                        println!("  shortened: {} to {:.2} mm", free[0].0, free[0].1);
                        length = Length::Mm(0.95 * free[0].1);
                    }
                    Err(error) => {
                        println!("  not extended: {error}");
                        break;
                    }
                }
            }
        }
        println!("  {extended} extended");
        for kind in [CapKind::Fan, CapKind::Planar, CapKind::Smooth] {
            match cap(&surface, &ends, kind) {
                Ok(patched) => println!(
                    "  {kind:?}: {} capped, {:?}, {} triangles cross",
                    patched.patches.len() - 1,
                    counts(&patched.mesh),
                    self_intersections(&patched.mesh).len()
                ),
                Err(error) => println!("  {kind:?}: {error}"),
            }
        }
    }
}
