//! Facts about whole samples.

use super::*;

#[test]
fn scratch() {
    for sample in Sample::ALL {
        let mut spacing = sample.default_spacing();
        if let Ok(s) = std::env::var("SPACING") {
            spacing = s.parse().unwrap();
        }
        let t = std::time::Instant::now();
        let mesh = sampled(sample, spacing, &mut |_| ControlFlow::Continue(())).unwrap();
        let dt = t.elapsed();
        let topo = crate::mesh::Topology::new(mesh.positions.len(), &mesh.triangles);
        let c = components(mesh.positions.len(), &mesh.triangles);
        let open: usize = vessels(sample).iter().map(|v| usize::from(v.open_start) + usize::from(v.open_end)).sum();
        let loops = crate::mesh::boundary_loops(&topo);
        eprintln!(
            "{sample} {dt:?} {} tris; comps {:?}; {:?} loops {} expected {open}; V-E+F {}; len {:?}",
            mesh.triangles.len(),
            c.triangle_counts,
            topo.edge_counts(),
            loops.len(),
            mesh.positions.len() as i64 - topo.edge_counts().edges as i64 + mesh.triangles.len() as i64,
            loops.iter().map(Vec::len).collect::<Vec<_>>()
        );
        let mut out = Vec::new();
        for t in 0..mesh.triangles.len() {
            for p in mesh.corners(t) {
                for c in p.to_array() {
                    out.extend(c.to_le_bytes());
                }
            }
        }
        std::fs::write(format!("/tmp/phantom_{sample}.raw"), out).unwrap();
    }
}
