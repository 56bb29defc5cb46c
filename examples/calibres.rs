//! Prints the branches of a vessel tree, their lengths, and the radius of each before and after the reduction:
//! `cargo run --release --example calibres [FILE]`. Without a file it takes Lumen's own aorta.

use std::sync::Arc;

use lumen::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = match std::env::args().nth(1) {
        Some(file) => lumen::io::read(&std::fs::read(&file)?, &file, &ImportOptions::default())?.mesh,
        None => lumen::phantom::generate(Sample::Aorta, 75_000)?,
    };
    let mut pipeline = Pipeline::new(Arc::new(mesh), Settings::default()).with_certificate();
    pipeline.finish()?;
    let certified = pipeline.certified().expect("a finished pipeline has measured the vessels").clone()?;
    println!("branch       length mm   radius mm   reduced mm");
    for branch in &certified.certificate.branches {
        let mean = |radius: Option<lumen::vessel::certificate::Spread>| match radius {
            Some(radius) => format!("{:.2}", radius.mean),
            None => "not measured".into(),
        };
        let [opened, reduced] = [&branch.opened, &branch.reduced].map(|surface| mean(surface.radius_mm));
        println!("{:<12} {:>9.1} {opened:>11} {reduced:>12}", branch.name, branch.length_mm);
    }
    Ok(())
}
