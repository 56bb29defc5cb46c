use lumen::mesh::*;
use std::time::Instant;
#[test]
fn time() {
    for f in ["aorta74k", "aorta1m"] {
        let bytes = std::fs::read(format!("/work/shared/data/bench/{f}.ply")).unwrap();
        let mesh = lumen::io::read(&bytes, "a.ply", &Default::default()).unwrap().mesh;
        let s = Instant::now();
        let topo = Topology::new(mesh.positions.len(), &mesh.triangles);
        println!("{f} topo {:?}", s.elapsed());
        let s = Instant::now();
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        println!("index {:?}", s.elapsed());
        let s = Instant::now();
        roughness(&mesh, &topo);
        println!("roughness {:?}", s.elapsed());
        let s = Instant::now();
        angles(&mesh);
        println!("angles {:?}", s.elapsed());
        let s = Instant::now();
        let n = lumen::parallel::with_threads(1, || self_intersections(&mesh).len());
        println!("si incl index, 1 thread {n} {:?}", s.elapsed());
        let s = Instant::now();
        inner_radii(&mesh, &topo, &index);
        println!("balls {:?}", s.elapsed());
    }
}
