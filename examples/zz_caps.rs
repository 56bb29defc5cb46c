fn main() {
    for file in std::env::args().skip(1) {
        let bytes = std::fs::read(&file).unwrap();
        let name = std::path::Path::new(&file).file_name().unwrap().to_str().unwrap().to_owned();
        let Ok(imported) = lumen::io::read(bytes.as_slice(), &name, &Default::default()) else { println!("{name}: not read"); continue };
        let mesh = imported.mesh;
        let topology = lumen::mesh::Topology::new(mesh.positions.len(), &mesh.triangles);
        let t = std::time::Instant::now();
        let caps = lumen::mesh::flat_caps(&mesh, &topology);
        let ms = t.elapsed().as_secs_f64() * 1e3;
        let told: Vec<String> = caps.iter().take(12).map(|c| format!("r{:.2}/{}", c.radius_mm(), c.rim.len())).collect();
        println!("{name}: {} triangles, {} caps in {ms:.1} ms: {}", mesh.triangles.len(), caps.len(), told.join(" "));
    }
}
