//! Random input, for thousands of steps: no number that is none, nothing through the wall, nothing farther into it than 5 % of
//! the wire's radius, no wire that is stuck for good. `LUMEN_FUZZ_STEPS` asks for more (`cargo xtask fuzz-trial`: a
//! million).
//!
//! Penetration is measured on capsules against triangles in f64, escape by winding numbers: by `audit`, which shares
//! nothing with the contact solver.

use std::sync::Arc;

use glam::DVec3;
use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::audit::Audit;
use lumen::trial::course::Course;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Input, Setup};
use lumen::trial::wire::Wire;
use lumen_test_support::is_long;

/// Steps between two audits: nothing moves farther than 3.2 mm meanwhile.
const AUDITED: u64 = 20;

/// Steps in a row without a way on that are too many.
const STUCK: u64 = 50;

struct SplitMix64(u64);

impl SplitMix64 {
    /// 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn fuzz(sample: Sample, wire: &str, rate: u32, steps: u64) {
    let mesh = import_mesh(generate(sample, 60_000).unwrap(), "sample").mesh;
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::default() };
    let settings = Settings { smoothing, target: Target::Reduction(rate), ..Settings::default() };
    let mut pipeline = Pipeline::new(Arc::new(mesh), settings).without_measures();
    pipeline.finish().unwrap();
    let mesh = pipeline.reduced().unwrap().mesh.clone();
    let mut setup = Setup { wire: Wire::preset(wire).unwrap(), ..Setup::default() };
    let course = Course::new(&mesh, Some(sample), &mut setup).unwrap();
    let (mut simulation, _) = course.place(&setup, &setup.wire).unwrap();
    let audit = Audit::new(&mesh);
    let radius = setup.wire.radius();
    let mut random = SplitMix64(0x2545_f491_4f6c_dd1d ^ u64::from(rate));
    let (mut input, mut deepest, mut longest) = (Input::default(), 0.0f64, 0.0f64);
    let (mut held, mut held_on) = (0u64, 0u64);
    for step in 0..steps {
        if step % 50 == 0 || random.next() < 0.01 {
            // Mostly in, sometimes out, now and then beyond what is allowed or no number at all.
            let feed = if random.next() < 0.7 { 50.0 * random.next() } else { -50.0 * random.next() };
            let roll = (random.next() - 0.5) * 26.0;
            input = Input { feed: feed as f32, roll: roll as f32 };
            if random.next() < 0.02 {
                input = Input { feed: f32::NAN, roll: 1e30 };
            }
        }
        let is_held = simulation.step(input).kind == StepKind::Held;
        held += u64::from(is_held);
        held_on = if is_held { held_on + 1 } else { 0 };
        assert!(held_on < STUCK, "{sample} at {rate}: no way on from step {}", step + 1 - held_on);
        longest = longest.max(simulation.inserted());
        if step % AUDITED == 0 {
            let nodes: Vec<DVec3> = simulation.nodes().collect();
            assert!(nodes.iter().all(|p| p.is_finite()), "{sample} at {rate}: no number at step {step}");
            let depth = audit.penetration(&nodes, radius);
            assert!(
                depth <= 0.05 * radius,
                "{sample} at {rate}, step {step}: {:.1} % into the wall",
                100.0 * depth / radius
            );
            deepest = deepest.max(depth);
        }
        if step % (10 * AUDITED) == 0 {
            for p in simulation.nodes() {
                let winding = audit.winding(p);
                assert!(winding > 0.5, "{sample} at {rate}, step {step}: {p} is outside, winding number {winding}");
            }
        }
    }
    println!(
        "{sample} at {rate}: {steps} steps, {:.2} % of the radius deep, {longest:.0} mm inserted, {held} without a way on",
        100.0 * deepest / radius
    );
    assert!(longest > 20.0, "the wire did not come in");
}

fn steps() -> u64 {
    std::env::var("LUMEN_FUZZ_STEPS").ok().and_then(|text| text.parse().ok()).unwrap_or(if is_long() {
        50_000
    } else {
        12_000
    })
}

#[test]
fn a_thin_wire_in_the_coronary_tree() {
    fuzz(Sample::Coronary, "workhorse", 900, steps() / 2);
}

#[test]
fn a_thick_wire_in_the_aorta() {
    fuzz(Sample::Aorta, "035-j", 990, steps() / 2);
}
