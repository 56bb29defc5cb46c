use lumen::mesh::*;
use lumen::pipeline::settings::*;
use lumen::pipeline::*;
use std::io::Write;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let out = std::env::args().nth(2).unwrap_or("/tmp/lv".into());
    let b = std::fs::read(&path).unwrap();
    let h = String::from_utf8_lossy(&b[..600.min(b.len())]).to_string();
    let end = h.find("end_header\n").unwrap() + 11;
    let nv: usize = h.split("element vertex ").nth(1).unwrap().split('\n').next().unwrap().trim().parse().unwrap();
    let nf: usize = h.split("element face ").nth(1).unwrap().split('\n').next().unwrap().trim().parse().unwrap();
    let f = |o: usize| f32::from_le_bytes(b[o..o + 4].try_into().unwrap());
    let u = |o: usize| u32::from_le_bytes(b[o..o + 4].try_into().unwrap());
    let positions = (0..nv)
        .map(|i| {
            let o = end + 12 * i;
            Vec3::new(f(o), f(o + 4), f(o + 8))
        })
        .collect();
    let o = end + 12 * nv;
    let triangles = (0..nf)
        .map(|i| {
            let o = o + 13 * i + 1;
            [u(o), u(o + 4), u(o + 8)]
        })
        .collect();
    let m = TriMesh { positions, triangles };
    let t = std::time::Instant::now();
    let c = connectivity::Connectivity::of(&m);
    let mut m = c.kept(&m, Keep::Largest).unwrap();
    println!("conn {:?} tris {}", t.elapsed(), m.triangles.len());
    let t = std::time::Instant::now();
    let topo = Topology::new(m.positions.len(), &m.triangles);
    println!("topo {:?}", t.elapsed());
    let t = std::time::Instant::now();
    let s = Smoothing { pass_band: 0.1, iterations: 60, ..Default::default() };
    let fl = filter::Filter::new(&s);
    println!("filter {:?}", t.elapsed());
    let t = std::time::Instant::now();
    m.positions = smoothing::smooth(&m.positions, &topo, Boundary::Loop, &fl);
    println!("smooth60 {:?}", t.elapsed());
    wr(&m, &format!("{out}_smooth.ply"));
    let t = std::time::Instant::now();
    let p = decimation::decimate(&m, &topo, &Decimation::default());
    println!(
        "decimate {:?} steps {} left {} {:?}",
        t.elapsed(),
        p.errors.len(),
        p.triangles_after(p.errors.len() as u32),
        p.limit
    );
    for r in [100, 500, 750, 900, 990, 999] {
        let t = std::time::Instant::now();
        let l = p.level(Target::Reduction(r));
        let e = t.elapsed();
        println!(
            "{r} {} want {} err {} level {:?} {:?}",
            l.triangles.len(),
            Target::Reduction(r).triangles(m.triangles.len()),
            p.errors[..l.steps as usize].last().copied().unwrap_or(0.0),
            e,
            l.shortfall.map(|s| s.to_string())
        );
        wr(&p.extract(&l.triangles), &format!("{out}_{r}.ply"));
    }
}
fn wr(m: &TriMesh, p: &str) {
    let mut w = Vec::new();
    write!(w,"ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",m.positions.len(),m.triangles.len()).unwrap();
    for v in &m.positions {
        for c in v.to_array() {
            w.extend(c.to_le_bytes())
        }
    }
    for t in &m.triangles {
        w.push(3);
        for i in t {
            w.extend(i.to_le_bytes())
        }
    }
    std::fs::write(p, w).unwrap();
}
