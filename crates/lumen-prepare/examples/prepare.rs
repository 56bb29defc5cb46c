//! Cuts, extends and caps the ends of vessel surfaces, and prints what came of each: `prepare FILE...`.

use lumen_io::{ImportOptions, read};
use lumen_mesh::mending::fill::fill;
use lumen_mesh::{Topology, TriMesh, self_intersections};
use lumen_prepare::cap::{CapKind, cap};
use lumen_prepare::clip::{Clipped, clip};
use lumen_prepare::ends::{EndPlane, Length, OpenEnd, open_ends, propose};
use lumen_prepare::extend::{ExtendError, extend};
use lumen_vessel::Tree;

/// Cuts at every plane that can be cut, and tells why others cannot.
fn clip_what_can_be(mesh: &TriMesh, planes: &[EndPlane]) -> Clipped {
    let mut kept = planes.to_vec();
    loop {
        match clip(mesh, &kept) {
            Ok(clipped) => return clipped,
            Err(error) => {
                let end = error.end().unwrap_or(kept.len().saturating_sub(1));
                println!("  not cut: branch {}: {error}", kept.remove(end).branch + 1);
            }
        }
    }
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
        let started = std::time::Instant::now();
        let clipped = clip_what_can_be(&mesh, &proposal.planes);
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
        for end in &mut ends {
            let one: [OpenEnd; 1] = [end.clone()];
            let mut length = Length::Radii(5.0);
            for _ in 0..2 {
                match extend(&surface, &one, &[length]) {
                    Ok(found) => {
                        surface = found.mesh;
                        *end = found.ends[0].clone();
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
        // Holes in the wall, and ends that no branch leads to.
        let filled = fill(&surface, f64::INFINITY);
        let (others, refused) = open_ends(&filled.mesh).expect("a sound surface");
        let has = |end: &OpenEnd, v: u32| end.rim.contains(&v);
        let others: Vec<OpenEnd> =
            others.into_iter().filter(|other| !ends.iter().any(|end| has(end, other.rim[0]))).collect();
        println!(
            "  {extended} extended, {} holes filled, {} other open ends, {} loops that are none: {refused:?}",
            filled.filled,
            others.len(),
            refused.len()
        );
        ends.extend(others);
        let surface = filled.mesh;
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
