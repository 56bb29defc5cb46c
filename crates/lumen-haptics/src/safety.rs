//! What stands between a wish and a motor: nothing moves before the user has armed it, nothing is stronger than the cap or
//! rises faster than the slew limit, and whatever goes wrong ends the force.

use serde::{Deserialize, Serialize};

use super::force::{Coupling, ForceCommand};

/// ms after which a wish that was not renewed is none.
pub const STALE_MS: f64 = 100.0;

/// How strong and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The most force, as a part of what the device has, 0 to 1.
    pub cap: f64,
    /// By how much the force rises or falls in a second at most, in the same parts; a stop is not bound by it.
    pub slew: f64,
    /// By how much a spring's centre moves in a second at most: 2 is the axis's whole way.
    pub centre_slew: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { cap: 0.4, slew: 4.0, centre_slew: 20.0 }
    }
}

/// Why there is no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Halt {
    /// The user has not armed it.
    NotArmed,
    /// The user has stopped it.
    Stopped,
    /// The window is hidden, or another has the keys.
    Hidden,
    /// The device is gone.
    Unplugged,
    /// A wish was no number.
    NotANumber,
    /// The device takes no more reports.
    Refused,
}

/// Lets wishes through, or not.
#[derive(Clone, Debug)]
pub struct Guard {
    limits: Limits,
    /// Why not; `None` while it is armed.
    halt: Option<Halt>,
    is_paused: bool,
    /// What was last let through, and when.
    passed: Option<(ForceCommand, f64)>,
    renewed_ms: f64,
}

impl Guard {
    /// Not armed.
    pub fn new(limits: Limits) -> Self {
        Self { limits, halt: Some(Halt::NotArmed), is_paused: false, passed: None, renewed_ms: f64::NEG_INFINITY }
    }

    /// The user has armed it, and has seen what will move. Force rises from nothing.
    pub fn arm(&mut self) {
        self.halt = None;
        self.passed = None;
    }

    /// Force ends until it is armed again.
    pub fn halt(&mut self, why: Halt) {
        self.halt = Some(why);
        self.passed = None;
    }

    /// While it is paused there is no force; afterwards it rises from nothing.
    pub fn pause(&mut self, on: bool) {
        self.is_paused = on;
    }

    /// Why it is not armed; `None` where it is.
    pub fn halted(&self) -> Option<Halt> {
        self.halt
    }

    /// Other limits, from now on.
    pub fn set_limits(&mut self, limits: Limits) {
        self.limits = limits;
    }

    /// Says that the trial is there, at `now_ms`: without that for [`STALE_MS`] there is no force.
    pub fn renew(&mut self, now_ms: f64) {
        self.renewed_ms = now_ms;
    }

    /// Whether the trial has not said for too long that it is there.
    pub fn is_stale(&self, now_ms: f64) -> bool {
        now_ms - self.renewed_ms > STALE_MS || now_ms.is_nan()
    }

    /// What of a wish the device may hear at `now_ms`; `None` for a stop. A wish that is no number ends it until it is armed
    /// again.
    pub fn pass(&mut self, command: &ForceCommand, now_ms: f64) -> Option<ForceCommand> {
        if self.halt.is_some() || self.is_paused || self.is_stale(now_ms) {
            self.passed = None;
            return None;
        }
        let is_number = command.iter().all(|of| {
            let coupling = of.coupling.unwrap_or_default();
            let all = [of.force, of.limit, coupling.centre, coupling.stiffness, coupling.damping];
            all.into_iter().all(f64::is_finite)
        });
        if !is_number {
            self.halt(Halt::NotANumber);
            return None;
        }
        let Limits { cap, slew, centre_slew } = self.limits;
        let cap = cap.clamp(0.0, 1.0);
        let (before, dt) = match self.passed {
            Some((before, at)) => (before, ((now_ms - at) / 1000.0).clamp(0.0, 0.05)),
            None => (ForceCommand::default(), 0.0),
        };
        let mut passed = *command;
        for (of, before) in passed.iter_mut().zip(&before) {
            let toward = |to: f64, from: f64, rate: f64| from + (to - from).clamp(-rate * dt, rate * dt);
            of.limit = toward(of.limit.clamp(0.0, cap), before.limit, slew);
            of.force = toward(of.force.clamp(-cap, cap), before.force, slew).clamp(-of.limit, of.limit);
            of.coupling = of.coupling.map(|coupling| {
                // A spring that begins, begins where it is.
                let from = before.coupling.map_or(coupling.centre, |before| before.centre);
                Coupling {
                    centre: toward(coupling.centre.clamp(-1.0, 1.0), from.clamp(-1.0, 1.0), centre_slew),
                    stiffness: coupling.stiffness.clamp(0.0, 1.0),
                    damping: coupling.damping.clamp(0.0, 1.0),
                }
            });
        }
        self.passed = Some((passed, now_ms));
        Some(passed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::AxisForce;

    fn command(force: f64) -> ForceCommand {
        [AxisForce { force, coupling: None, limit: 1.0 }; 2]
    }

    /// The force of each ms from `from` on.
    fn run(guard: &mut Guard, from: u32, to: u32, force: f64) -> Vec<Option<f64>> {
        let each = (from..to).map(f64::from);
        each.map(|now| {
            guard.renew(now);
            guard.pass(&command(force), now).map(|command| command[0].force)
        })
        .collect()
    }

    #[test]
    fn nothing_moves_before_it_is_armed() {
        let mut guard = Guard::new(Limits::default());
        assert!(run(&mut guard, 0, 500, 1.0).iter().all(Option::is_none));
        assert_eq!(guard.halted(), Some(Halt::NotArmed));
    }

    #[test]
    fn force_rises_to_the_cap_and_no_faster_than_the_slew_limit() {
        let limits = Limits { cap: 0.5, slew: 4.0, centre_slew: 10.0 };
        let mut guard = Guard::new(limits);
        guard.arm();
        let forces: Vec<f64> = run(&mut guard, 0, 400, 1.0).into_iter().flatten().collect();
        assert_eq!(forces[0], 0.0);
        assert!(forces.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= 0.004 + 1e-12));
        assert_eq!((forces.len(), forces[399]), (400, 0.5));
        let turned: Vec<f64> = run(&mut guard, 400, 800, -1.0).into_iter().flatten().collect();
        assert!((turned[0] - 0.496).abs() < 1e-9 && turned[399] == -0.5);
        // A host that comes back after a while jumps by no more than 50 ms would have allowed.
        guard.renew(860.0);
        assert!(guard.pass(&command(1.0), 860.0).unwrap()[0].force <= -0.5 + 4.0 * 0.05 + 1e-9);
    }

    #[test]
    fn whatever_goes_wrong_ends_it_at_once() {
        for why in [Halt::Stopped, Halt::Hidden, Halt::Unplugged] {
            let mut guard = Guard::new(Limits::default());
            guard.arm();
            assert!(run(&mut guard, 0, 100, 1.0).iter().all(Option::is_some));
            guard.halt(why);
            assert!(run(&mut guard, 100, 200, 1.0).iter().all(Option::is_none));
            guard.arm();
            assert_eq!(run(&mut guard, 200, 201, 1.0), [Some(0.0)], "from nothing");
        }
        let mut guard = Guard::new(Limits::default());
        guard.arm();
        run(&mut guard, 0, 100, 1.0);
        guard.pause(true);
        assert_eq!(run(&mut guard, 100, 101, 1.0), [None]);
        guard.pause(false);
        assert_eq!(run(&mut guard, 101, 102, 1.0), [Some(0.0)]);
        assert_eq!(run(&mut guard, 102, 103, f64::NAN), [None]);
        assert_eq!((run(&mut guard, 103, 104, 0.1), guard.halted()), (vec![None], Some(Halt::NotANumber)));
    }

    #[test]
    fn a_trial_that_says_nothing_has_no_force() {
        let mut guard = Guard::new(Limits::default());
        guard.arm();
        run(&mut guard, 0, 100, 1.0);
        assert!(guard.pass(&command(1.0), 99.0 + STALE_MS).is_some());
        assert!(guard.pass(&command(1.0), 100.0 + STALE_MS).is_none());
        assert_eq!(guard.halted(), None, "it goes on once the trial does");
    }
}
