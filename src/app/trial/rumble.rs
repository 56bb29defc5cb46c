//! A gamepad's motors as the last resort for a force: how strongly they shake says how large it is, and nothing of where it
//! points. What stands before a haptic device's motor stands before these too ([`Guard`]): they are armed first, capped, rise
//! slowly, and whatever ends a force ends them. The platform lets each shake end by itself ([`SHAKE_MS`]).

use egui::Ui;

use super::action::{Action, DeviceAsk, RumbleAsk};
use super::device::why;
use crate::app::platform::SHAKE_MS;
use crate::app::row::remark;
use crate::haptics::force::{AxisForce, ForceCommand};
use crate::haptics::safety::{Guard, Halt, Limits};
use crate::haptics::service::DeviceCommand;
use crate::say;

/// The part of the most that 1 N along the wire, and 1 N mm about it, are felt as: a wire is pushed with some hundredths of
/// a newton, which a motor of this kind has to be told as tenths to be felt at all.
const FACTOR: [f64; 2] = [10.0, 1.0];
/// What is too faint to be sent.
const FAINT: f64 = 0.02;

/// What the hand holds at the guide: the steps up to then, by which news is known, the force in N and the torque in N mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Felt {
    pub(super) step: u64,
    pub(super) force: [f64; 2],
}

/// What of that may be felt at `now_ms`, as a part of the most, 0 to 1: nothing where `felt` is `None`, or has been of the
/// same `step` for too long.
pub(super) fn passed(guard: &mut Guard, step: &mut Option<u64>, now_ms: f64, felt: Option<Felt>) -> f64 {
    // A trial that tells nothing new has fallen silent.
    if let Some(felt) = felt
        && step.replace(felt.step) != Some(felt.step)
    {
        guard.renew(now_ms);
    }
    let force = felt.unwrap_or(Felt { step: 0, force: [0.0; 2] }).force;
    let command: ForceCommand =
        std::array::from_fn(|i| AxisForce { force: force[i].abs() * FACTOR[i], coupling: None, limit: 1.0 });
    guard.pause(felt.is_none());
    let passed = guard.pass(&command, now_ms);
    let strength = passed.map_or(0.0, |passed| passed[0].force.max(passed[1].force));
    if strength < FAINT { 0.0 } else { strength }
}

/// A gamepad's motors.
pub(super) struct Rumble {
    guard: Guard,
    /// Whether there is a gamepad that has any.
    is_offered: bool,
    /// Whether the user is being told what will shake.
    is_confirming: bool,
    /// The steps of the trial up to what was felt last.
    step: Option<u64>,
    /// How strong what was sent last is, and when, in ms.
    sent: (f64, f64),
}

impl Default for Rumble {
    fn default() -> Self {
        let guard = Guard::new(Limits::default());
        Self { guard, is_offered: false, is_confirming: false, step: None, sent: (0.0, f64::NEG_INFINITY) }
    }
}

impl Rumble {
    /// Whether it may shake.
    pub(super) fn is_armed(&self) -> bool {
        self.guard.halted().is_none()
    }

    /// It ends, until it is armed again.
    pub(super) fn halt(&mut self, why: Halt) {
        self.is_confirming = false;
        if self.is_armed() {
            self.guard.halt(why);
        }
    }

    /// Does what is asked.
    pub(super) fn act(&mut self, ask: RumbleAsk) {
        self.is_confirming = ask == RumbleAsk::Confirm(true);
        if ask == RumbleAsk::Arm && self.is_offered {
            self.guard.arm();
        }
    }

    /// How strongly to shake from `now_ms` on, 0 to 1, where the gamepad has to be told; `felt` is `None` while no hand
    /// holds the wire of a trial that goes on.
    pub(super) fn follow(&mut self, now_ms: f64, is_offered: bool, felt: Option<Felt>) -> Option<f64> {
        self.is_offered = is_offered;
        if !is_offered {
            self.halt(Halt::Unplugged);
        }
        let strength = passed(&mut self.guard, &mut self.step, now_ms, felt);
        let (before, at_ms) = self.sent;
        let is_due = if strength == 0.0 { before > 0.0 } else { now_ms - at_ms >= 0.5 * SHAKE_MS };
        is_due.then(|| {
            self.sent = (strength, now_ms);
            strength
        })
    }
}

/// Shows it, where there is a gamepad that can shake.
pub(super) fn show(ui: &mut Ui, rumble: &Rumble, asked: &mut Vec<Action>) {
    if !rumble.is_offered {
        return;
    }
    let mut ask = |what| asked.push(Action::Device(what));
    if rumble.is_armed() {
        if ui.button(say!("devices-stop-rumble")).on_hover_text(say!("devices-stop-rumble-help")).clicked() {
            ask(DeviceAsk::Command(DeviceCommand::Halt(Halt::Stopped)));
        }
    } else if rumble.is_confirming {
        remark(ui, &say!("devices-rumble-warning"));
        ui.horizontal(|ui| {
            if ui.button(say!("devices-arm-rumble")).on_hover_text(say!("devices-arm-rumble-help")).clicked() {
                ask(DeviceAsk::Rumble(RumbleAsk::Arm));
            }
            if ui.button(say!("devices-leave-still")).on_hover_text(say!("devices-leave-still-help")).clicked() {
                ask(DeviceAsk::Rumble(RumbleAsk::Confirm(false)));
            }
        });
    } else if ui.button(say!("devices-ask-arm-rumble")).on_hover_text(say!("devices-ask-arm-rumble-help")).clicked() {
        ask(DeviceAsk::Rumble(RumbleAsk::Confirm(true)));
    }
    if let Some(why) = rumble.guard.halted().and_then(why) {
        remark(ui, &why.say());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that is held for a while, told every 16 ms: what the gamepad hears.
    fn hold(rumble: &mut Rumble, from_ms: f64, force: [f64; 2]) -> Vec<f64> {
        let tell = |i: u32| {
            let felt = Felt { step: (from_ms as u64) + u64::from(i), force };
            rumble.follow(from_ms + 16.0 * f64::from(i), true, Some(felt))
        };
        (0..60).filter_map(tell).collect()
    }

    fn armed() -> Rumble {
        let mut rumble = Rumble::default();
        rumble.follow(0.0, true, None);
        rumble.act(RumbleAsk::Arm);
        rumble
    }

    #[test]
    fn it_shakes_by_the_force_once_it_is_armed_rising_slowly_up_to_the_cap() {
        let mut rumble = Rumble::default();
        assert_eq!(hold(&mut rumble, 0.0, [-0.03, 0.0]), [0.0; 0], "not before it is armed");
        rumble.act(RumbleAsk::Confirm(true));
        assert_eq!(hold(&mut rumble, 1000.0, [-0.03, 0.0]), [0.0; 0], "nor while it is being told");
        rumble.act(RumbleAsk::Arm);
        let heard = hold(&mut rumble, 2000.0, [-0.03, 0.0]);
        assert!((heard.last().unwrap() - 0.3).abs() < 1e-9, "a force against the wire is one: {heard:?}");
        // By 4 of the most a second.
        assert!(heard[0] <= 4.0 * 0.016 + 1e-9, "{heard:?}");
        assert!(heard.len() >= 15 && heard.len() <= 20, "renewed every 50 ms: {}", heard.len());
        assert!((hold(&mut rumble, 3000.0, [0.0, 0.2]).last().unwrap() - 0.2).abs() < 1e-9, "a torque too");
        assert!((hold(&mut rumble, 4000.0, [9.0, 0.0]).last().unwrap() - 0.4).abs() < 1e-9, "no more than the cap");
    }

    #[test]
    fn what_ends_a_force_ends_it_until_it_is_armed_again() {
        for why in [Halt::Stopped, Halt::Hidden] {
            let mut rumble = armed();
            assert!(!hold(&mut rumble, 1000.0, [0.03, 0.0]).is_empty());
            rumble.halt(why);
            assert_eq!(hold(&mut rumble, 2000.0, [0.03, 0.0]), [0.0], "{why:?}: told once that it is still");
        }
        let mut rumble = armed();
        hold(&mut rumble, 1000.0, [0.03, 0.0]);
        assert_eq!(rumble.follow(2000.0, false, None), Some(0.0), "unplugged");
        assert!(!rumble.is_armed());
        let mut rumble = armed();
        hold(&mut rumble, 1000.0, [0.03, 0.0]);
        assert_eq!(hold(&mut rumble, 2000.0, [f64::NAN, 0.0]), [0.0], "no number");
        assert!(!rumble.is_armed());
    }

    #[test]
    fn a_pause_and_a_trial_that_falls_silent_end_it_while_they_last() {
        let mut rumble = armed();
        hold(&mut rumble, 1000.0, [0.03, 0.0]);
        assert_eq!(rumble.follow(2000.0, true, None), Some(0.0));
        assert!(!hold(&mut rumble, 2100.0, [0.03, 0.0]).is_empty());
        let last = Felt { step: 9, force: [0.03, 0.0] };
        rumble.follow(4000.0, true, Some(last));
        assert!(rumble.follow(4090.0, true, Some(last)).is_some_and(|strength| strength > 0.0));
        assert_eq!(rumble.follow(4101.0, true, Some(last)), Some(0.0), "nothing new for 100 ms");
        assert!(rumble.is_armed());
    }
}
