//! Steers a guidewire by autopilot through Lumen's own aorta, reduced by 95 %, without a window:
//! `cargo run --release --example trial`

use std::sync::Arc;

use lumen::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let aorta = lumen::phantom::generate(Sample::Aorta, 75_000)?;
    let settings = Settings { target: Target::Reduction(950), ..Settings::default() };
    let mut pipeline = Pipeline::new(Arc::new(aorta), settings);
    pipeline.finish()?;
    let vessel = pipeline.reduced().expect("a finished pipeline has a level").mesh.clone();
    let mut setup = Setup::default();
    let course = Course::new(&vessel, Some(Sample::Aorta), &mut setup)?;
    let mut trial = Trial::new(Arc::new(course), setup)?;
    trial.set_autopilot(true);
    trial.finish();
    let summary = trial.summary();
    println!("{} after {:.1} s of simulated time", summary.reason, summary.time_s);
    println!("largest force on the wall {:.3} N", summary.max_wall_force_n);
    Ok(())
}
