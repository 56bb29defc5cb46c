//! A sound in place of a force: a tone that rises and grows with what the hand holds at the guide, of whichever sign. It
//! stands behind the same guard as a motor ([`passed`]): off until it is asked for, it rises slowly, and is silent while the
//! trial is paused or silent, or the window is left. The platform lets each tone end by itself
//! ([`SHAKE_MS`](crate::app::platform::SHAKE_MS)).

use egui::Ui;

use super::action::{Action, DeviceAsk};
use super::rumble::{Felt, passed};
use crate::app::platform::{SHAKE_MS, Tone};
use crate::app::row::remark;
use crate::haptics::safety::{Guard, Halt, Limits};
use crate::say;

/// What the faintest force sounds as, in Hz, and by how many octaves the greatest is above it.
const LOWEST_HZ: f64 = 220.0;
const OCTAVES: f64 = 2.0;
/// The loudness of the greatest force: a fifth of full scale, 14 dB below it.
const LOUDEST: f64 = 0.2;

/// The tone of a force that is a part of the most that is told apart, 0 to 1; more sounds as the most.
fn tone(part: f64) -> Tone {
    let part = part.clamp(0.0, 1.0);
    Tone { pitch_hz: LOWEST_HZ * (OCTAVES * part).exp2(), loudness: LOUDEST * part }
}

/// The sound of a trial.
pub(super) struct Sound {
    guard: Guard,
    is_offered: bool,
    /// The steps of the trial up to what was felt last.
    step: Option<u64>,
    /// What was sent last, and when, in ms; `None` while it is off.
    sent: Option<(Tone, f64)>,
}

impl Default for Sound {
    fn default() -> Self {
        // The loudness has a bound of its own.
        let guard = Guard::new(Limits { cap: 1.0, ..Limits::default() });
        Self { guard, is_offered: false, step: None, sent: None }
    }
}

impl Sound {
    fn is_on(&self) -> bool {
        self.guard.halted().is_none()
    }

    /// Turns it on or off.
    pub(super) fn turn(&mut self, on: bool) {
        if on { self.guard.arm() } else { self.guard.halt(Halt::NotArmed) }
    }

    /// What is to sound from `now_ms` on, where that has to be told; `felt` is `None` while no hand holds the wire of a trial
    /// that goes on and is seen. The first tone is silent: the platform begins with the click that has turned it on.
    pub(super) fn follow(&mut self, now_ms: f64, is_offered: bool, felt: Option<Felt>) -> Option<Tone> {
        self.is_offered = is_offered;
        if !is_offered {
            return None;
        }
        let tone = tone(passed(&mut self.guard, &mut self.step, now_ms, felt));
        let is_due = match self.sent {
            None => self.is_on(),
            Some((before, _)) if tone.loudness == 0.0 => before.loudness > 0.0,
            Some((_, at_ms)) => now_ms - at_ms >= 0.5 * SHAKE_MS,
        };
        if is_due {
            self.sent = Some((tone, now_ms));
        }
        if !self.is_on() {
            self.sent = None;
        }
        is_due.then_some(tone)
    }
}

/// Shows it, or what it would take where the platform has none.
pub(super) fn show(ui: &mut Ui, sound: &Sound, asked: &mut Vec<Action>) {
    if !sound.is_offered {
        remark(ui, &say!("devices-no-sound"));
        return;
    }
    let mut is_on = sound.is_on();
    if ui.checkbox(&mut is_on, say!("devices-sound")).on_hover_text(say!("devices-sound-help")).changed() {
        asked.push(Action::Device(DeviceAsk::Sound(is_on)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that is held for a second, told every 16 ms: what the platform hears.
    fn hold(sound: &mut Sound, from_ms: f64, force: [f64; 2]) -> Vec<Tone> {
        let tell = |i: u32| {
            let felt = Felt { step: (from_ms as u64) + u64::from(i), force };
            sound.follow(from_ms + 16.0 * f64::from(i), true, Some(felt))
        };
        (0..60).filter_map(tell).collect()
    }

    fn on() -> Sound {
        let mut sound = Sound::default();
        sound.turn(true);
        sound
    }

    #[test]
    fn more_force_is_higher_and_louder_up_to_a_bound() {
        let parts = (0..=100).map(|i| tone(f64::from(i) / 100.0)).collect::<Vec<_>>();
        for pair in parts.windows(2) {
            assert!(pair[1].pitch_hz > pair[0].pitch_hz && pair[1].loudness > pair[0].loudness, "{pair:?}");
        }
        assert_eq!((parts[0].pitch_hz, parts[0].loudness), (220.0, 0.0), "none is silent");
        // An octave is twice the frequency.
        assert!((parts[50].pitch_hz - 440.0).abs() < 1e-9 && (parts[100].pitch_hz - 880.0).abs() < 1e-9);
        assert_eq!(tone(7.0), parts[100]);
        assert_eq!(parts[100].loudness, 0.2);
    }

    #[test]
    fn it_sounds_by_the_force_once_it_is_on_and_is_renewed() {
        let mut sound = Sound::default();
        assert!(hold(&mut sound, 0.0, [0.05, 0.0]).is_empty(), "off by default");
        sound.turn(true);
        let heard = hold(&mut sound, 1000.0, [-0.05, 0.0]);
        assert_eq!(heard[0].loudness, 0.0, "it begins with the click, from nothing");
        let last = heard.last().unwrap();
        assert!((last.loudness - 0.1).abs() < 1e-9 && (last.pitch_hz - 440.0).abs() < 1e-6, "{last:?}: 0.1 N is all");
        assert!(heard.len() >= 15, "renewed every 50 ms: {}", heard.len());
        assert!((hold(&mut sound, 2000.0, [0.0, 1.0]).last().unwrap().loudness - 0.2).abs() < 1e-9, "a torque too");
        assert!((hold(&mut sound, 3000.0, [9.0, 9.0]).last().unwrap().loudness - 0.2).abs() < 1e-9, "no louder");
        let faint = hold(&mut sound, 4000.0, [0.001, 0.0]);
        assert_eq!(faint.last().unwrap().loudness, 0.0, "too faint to be heard");
        assert!(hold(&mut sound, 5000.0, [0.001, 0.0]).is_empty(), "silence is told once");
    }

    #[test]
    fn it_is_silent_while_nobody_holds_or_sees_the_wire_and_once_it_is_off() {
        let loudness = |tone: Option<Tone>| tone.map(|tone| tone.loudness);
        let mut sound = on();
        assert!(hold(&mut sound, 0.0, [0.05, 0.0]).len() > 2);
        assert_eq!(loudness(sound.follow(1000.0, true, None)), Some(0.0), "paused, hidden or over");
        assert!(hold(&mut sound, 1100.0, [0.05, 0.0]).len() > 2, "and on again by itself");
        sound.turn(false);
        assert_eq!(loudness(sound.follow(2100.0, true, None)), Some(0.0), "off");
        assert!(hold(&mut sound, 2200.0, [0.05, 0.0]).is_empty());

        let mut sound = on();
        hold(&mut sound, 0.0, [0.05, 0.0]);
        let last = Felt { step: 1, force: [0.05, 0.0] };
        sound.follow(1000.0, true, Some(last));
        assert_eq!(loudness(sound.follow(1101.0, true, Some(last))), Some(0.0), "nothing new for 100 ms");

        let mut sound = on();
        hold(&mut sound, 0.0, [0.05, 0.0]);
        assert_eq!(loudness(hold(&mut sound, 1000.0, [f64::NAN, 0.0]).first().copied()), Some(0.0), "no number");
        assert!(!sound.is_on());
        assert!(on().follow(0.0, false, None).is_none(), "none where the platform has none");
    }
}
