//! What the hand holds at the guide, as a spectrum: no more above 50 Hz than the rows of the log must leave there.
//!
//! The hand is at c, the wire is fed to f, the hand feels `K (c - f)`. A speed is latched for a row of T = 20 ms, so f is
//! straight from row to row: its values there, with lines between. Such lines repeat the spectrum of the rows about each
//! multiple of 50 Hz, weighted by `D(ν) = (sin πνT / n sin πνT/n)²`, n the steps in a row: Fejér's kernel, what remains of a
//! triangle at the pace of the steps. A row tells nothing above 25 Hz. So of all that a force felt through f can be, whatever
//! the wire does, no more than the share at 25 Hz is above 50 Hz: 1.8 %. A step of the force that is spread by the bound on
//! its slew is a ramp, and falls with ν² beyond 1 / (π times its length).

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::trial::STEP;
use lumen::trial::course::Course;
use lumen::trial::report::{StepKind, StepReport};
use lumen::trial::session::{ROW_STEPS, Trial};
use lumen::trial::setup::{Entry, Input, Setup};
use lumen::trial::simulation::Simulation;
use lumen::trial::virtual_coupling::{CouplingGains, VirtualCoupling};
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use lumen_test_support::tubes::{curve, tube};

/// Above what the share is told, in Hz: the pace of the rows.
const ABOVE_HZ: f64 = 50.0;
/// Steps in a piece whose spectrum is taken, so that a line of it is a Hz.
const PIECE: usize = 500;

/// The amplitude at `hz` of what was told at each step, over all of it: 1 for a wave of 1.
fn amplitude(values: &[f64], hz: f64) -> f64 {
    let (mut real, mut imaginary) = (0.0, 0.0);
    for (i, value) in values.iter().enumerate() {
        let angle = TAU * hz * STEP * i as f64;
        real += value * angle.cos();
        imaginary -= value * angle.sin();
    }
    2.0 * real.hypot(imaginary) / values.len() as f64
}

/// The spectrum at each Hz from 1 to 250: the root mean square over pieces of a second that overlap by half, each less its
/// mean and under Hann's window (Welch 1967).
fn spectrum(values: &[f64]) -> Vec<f64> {
    let pieces: Vec<Vec<f64>> = (0..=(values.len() - PIECE) / (PIECE / 2))
        .map(|i| &values[i * PIECE / 2..][..PIECE])
        .map(|piece| {
            let mean = piece.iter().sum::<f64>() / PIECE as f64;
            let window = |i: usize| 1.0 - (TAU * i as f64 / PIECE as f64).cos();
            piece.iter().enumerate().map(|(i, value)| window(i) * (value - mean)).collect()
        })
        .collect();
    let at = |hz: usize| pieces.iter().map(|piece| amplitude(piece, hz as f64).powi(2)).sum::<f64>();
    (1..=PIECE / 2).map(|hz| (at(hz) / pieces.len() as f64).sqrt()).collect()
}

/// The part of the energy in a spectrum that is above [`ABOVE_HZ`].
fn share_above(spectrum: &[f64]) -> f64 {
    let energy = |of: &[f64]| of.iter().map(|amplitude| amplitude * amplitude).sum::<f64>();
    energy(&spectrum[ABOVE_HZ as usize..]) / energy(spectrum)
}

/// What lines from row to row leave of a wave of `hz`.
fn lines(hz: f64) -> f64 {
    let steps = ROW_STEPS as f64;
    ((PI * hz * STEP * steps).sin() / (steps * (PI * hz * STEP).sin())).powi(2)
}

/// The part of the energy above [`ABOVE_HZ`] of lines through the rows of a wave of `hz`, of up to 25 Hz.
fn share_of_lines(hz: f64) -> f64 {
    let pace = 1.0 / (STEP * ROW_STEPS as f64);
    let copies = |k: u32| [f64::from(k) * pace + hz, f64::from(k + 1) * pace - hz];
    let energies: Vec<(f64, f64)> =
        (0..ROW_STEPS as u32 / 2).flat_map(copies).map(|copy| (copy, lines(copy).powi(2))).collect();
    let above = energies.iter().filter(|(copy, _)| *copy > ABOVE_HZ).map(|(_, energy)| energy).sum::<f64>();
    above / energies.iter().map(|(_, energy)| energy).sum::<f64>()
}

/// The most of that for any wave.
fn most_above() -> f64 {
    (1..=250).map(|tenth| share_of_lines(f64::from(tenth) / 10.0)).fold(0.0, f64::max)
}

/// What a hand felt at each step, and what the guide did.
#[derive(Default)]
struct Told {
    felt: [Vec<f64>; 2],
    guide: [Vec<f64>; 2],
}

impl Told {
    fn note(&mut self, hold: &VirtualCoupling, report: &StepReport) {
        let (felt, guide) = (hold.felt(), [report.push_n, report.torque_n_mm]);
        for i in 0..2 {
            self.felt[i].push(felt[i]);
            self.guide[i].push(guide[i]);
        }
    }
}

#[test]
fn lines_through_a_wave_s_rows_have_the_spectrum_that_is_said_here() {
    // The kernel against the lines themselves, over a second.
    for hz in [2.0, 11.0, 23.0] {
        let row = |k: usize| (TAU * hz * STEP * (k as u64 * ROW_STEPS) as f64).cos();
        let steps = ROW_STEPS as usize;
        let values: Vec<f64> = (0..PIECE)
            .map(|i| {
                let part = (i % steps) as f64 / steps as f64;
                row(i / steps) * (1.0 - part) + row(i / steps + 1) * part
            })
            .collect();
        for copy in [hz, 50.0 - hz, 50.0 + hz, 150.0 - hz, 200.0 + hz] {
            assert!((amplitude(&values, copy) - lines(copy)).abs() < 1e-9, "{hz} Hz at {copy} Hz");
        }
    }
    let most = most_above();
    assert!((0.017..0.018).contains(&most), "{most}");
}

#[test]
fn a_free_wire_is_felt_by_the_hand_s_own_motion_and_what_the_rows_make_of_it() {
    const SWAY_HZ: f64 = 2.0;
    // In mm and mm/s: fed by a hand that sways, but never withdraws.
    const SWAY: f64 = 1.0;
    const SPEED: f64 = 14.0;
    let wall = Arc::new(Wall::open(Arc::new(tube(&curve(&[(160.0, f64::INFINITY)], 1.0), |_| 4.0, 24))));
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let wire = Wire::preset("workhorse").unwrap();
    let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
    let (mut hold, mut told, mut input) = (VirtualCoupling::default(), Told::default(), Input::default());
    let place = |step: u64| SPEED * STEP * step as f64 + SWAY * (TAU * SWAY_HZ * STEP * step as f64).sin();
    let (begun, nodes) = (PIECE as u64, simulation.count());
    for step in 0..begun + 5 * PIECE as u64 {
        if step.is_multiple_of(ROW_STEPS) {
            input = hold.input();
        }
        hold.moves([place(step + 1) - place(step), 0.0]);
        let report = simulation.step(input);
        hold.stepped(&report);
        assert_eq!(simulation.body().pressure().0, 0.0, "nothing is touched");
        if step >= begun {
            told.note(&hold, &report);
        }
    }
    assert!(simulation.count() > nodes + 20, "elements are born");

    // From row to row f goes on by `g (2 c - c before - f)`, g = K T / (B + K T): its wave over that of c.
    let CouplingGains { stiffness, drag, .. } = CouplingGains::FEED;
    let row = STEP * ROW_STEPS as f64;
    let part = stiffness * row / (drag + stiffness * row);
    let turn = TAU * SWAY_HZ * row;
    let over = [part * (2.0 - turn.cos()), part * turn.sin()];
    let under = [turn.cos() - (1.0 - part), turn.sin()];
    let square = under[0].powi(2) + under[1].powi(2);
    let followed =
        [(over[0] * under[0] + over[1] * under[1]) / square, (over[1] * under[0] - over[0] * under[1]) / square];
    let wave = |hz: f64, own: f64| {
        let [real, imaginary] = followed.map(|of| of * lines(hz));
        1e3 * stiffness * SWAY * (own - real).hypot(imaginary)
    };

    let mut found = Benchmark::new("felt-free");
    let felt = &told.felt[0];
    let known = [SWAY_HZ, 50.0 - SWAY_HZ, 50.0 + SWAY_HZ, 100.0 - SWAY_HZ, 100.0 + SWAY_HZ];
    for hz in known {
        let analytic = wave(hz, if hz == SWAY_HZ { 1.0 } else { 0.0 });
        let ours = 1e3 * amplitude(felt, hz);
        found.compare(&format!("felt at {hz} Hz (mN)"), analytic, ours, Part(0.05), 0);
        found.mark("of the rows and the hand", hz, analytic);
        found.point("felt", hz, ours);
    }
    let drag_mn = 1e3 * felt.iter().sum::<f64>() / felt.len() as f64;
    found.compare("mean: that of the speed (mN)", 1e3 * drag * SPEED, drag_mn, Part(0.05), 0);
    // Between the waves is nothing: a hundredth of what can be felt, by the bound on a step, of the slew.
    let is_known = |hz: f64| known.iter().chain(&[148.0, 152.0, 198.0, 202.0, 248.0]).any(|of| (of - hz).abs() < 0.5);
    let other = (1..=250).map(f64::from).filter(|&hz| !is_known(hz)).map(|hz| 1e3 * amplitude(felt, hz));
    let other = other.fold(0.0, f64::max);
    found.compare("most felt at any other of 250 Hz (mN)", 0.0, other, Within(0.1), 0);
    found.finish();
}

#[test]
fn what_is_felt_in_the_aorta_has_no_more_above_50_hz_than_rows_leave() {
    let mesh = Arc::new(import_mesh(generate(Sample::Aorta, 20_000).unwrap(), "sample").mesh);
    let mut setup = Setup { wire: Wire::preset("stiff").unwrap(), ..Setup::default() };
    let course = Course::new(&mesh, Some(Sample::Aorta), &mut setup).unwrap();
    let mut trial = Trial::new(Arc::new(course), setup).unwrap();
    let (mut hold, mut told) = (VirtualCoupling::default(), Told::default());
    // By hand at constant speeds: 20 mm/s and 1 rad/s, from the first second on until the wire is where it should go.
    let mut unbalanced = 0_u32;
    for step in 0..9 * PIECE as u64 {
        if step.is_multiple_of(ROW_STEPS) {
            let input = hold.input();
            trial.drive(input);
        }
        hold.moves([20.0 * STEP, STEP]);
        trial.step();
        if trial.simulation().steps() == step {
            break;
        }
        let report = trial.simulation().report();
        hold.stepped(&report);
        if step >= PIECE as u64 {
            told.note(&hold, &report);
            unbalanced += u32::from(report.kind != StepKind::Balanced);
        }
    }
    let steps = told.felt[0].len();
    assert!(steps >= 3 * PIECE, "the trial was over after {steps} steps");
    // In those the force stands still, which is no merit of the coupling.
    assert!(20 * unbalanced as usize <= steps, "{unbalanced} of {steps} steps are not balanced");

    for (i, (name, what, per)) in [("felt-push", "push", 1e3), ("felt-torque", "torque", 1.0)].into_iter().enumerate() {
        let mut found = Benchmark::new(name);
        let [felt, guide] = [&told.felt[i], &told.guide[i]].map(|values| spectrum(values));
        for (series, of) in [("felt by the hand", &felt), ("the guide's own", &guide)] {
            of.iter().enumerate().for_each(|(k, amplitude)| found.curve(series, (k + 1) as f64, per * amplitude));
        }
        let [above, raw] = [&felt, &guide].map(|of| share_above(of));
        // The guide's own push has more than rows leave; its torque less, to which nothing is added.
        assert!(raw > most_above() || what == "torque", "the guide's own {what} would pass as well: {raw}");
        // To four digits, down.
        let most = (1e4 * most_above().min(raw)).floor() / 1e4;
        found.compare(&format!("share of the {what} felt above 50 Hz"), 0.0, above, Within(most), 0);
        found.finish();
    }
}
