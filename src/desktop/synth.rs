//! The samples of a tone that follows what it is told: it glides there, so that neither a change nor an end clicks, and fades
//! by itself where it is not told anew.

use std::f64::consts::TAU;

use crate::app::{FOLLOW_S, SHAKE_MS, Tone};

/// Samples a second.
pub(super) const RATE: u32 = 48_000;
/// For how long the last tone of all fades, in s.
const FADE_S: f64 = 0.01;
/// What is less loud is less than half a step of a sample: silence.
const SILENT: f64 = 0.5 / 32767.0;

/// A tone, sample by sample.
pub(super) struct Synth {
    wanted: Tone,
    /// Samples until what is wanted is over.
    left: u32,
    pitch_hz: f64,
    loudness: f64,
    /// In turns.
    phase: f64,
}

impl Default for Synth {
    fn default() -> Self {
        Self { wanted: Tone { pitch_hz: 0.0, loudness: 0.0 }, left: 0, pitch_hz: 0.0, loudness: 0.0, phase: 0.0 }
    }
}

impl Synth {
    /// Sounds so from now on, for [`SHAKE_MS`].
    pub(super) fn set(&mut self, tone: Tone) {
        self.left = (SHAKE_MS / 1000.0 * f64::from(RATE)) as u32;
        if tone.loudness > 0.0 {
            self.wanted = tone;
            if self.is_silent() {
                self.pitch_hz = tone.pitch_hz;
            }
        } else {
            // It fades at the pitch that it has.
            self.wanted.loudness = 0.0;
        }
    }

    /// Whether nothing is heard of it.
    pub(super) fn is_silent(&self) -> bool {
        self.loudness == 0.0
    }

    /// The next sample.
    pub(super) fn sample(&mut self) -> i16 {
        let follow = 1.0 - (-1.0 / (FOLLOW_S * f64::from(RATE))).exp();
        let loudness = if self.left > 0 { self.wanted.loudness } else { 0.0 };
        self.left = self.left.saturating_sub(1);
        self.loudness += follow * (loudness - self.loudness);
        self.pitch_hz += follow * (self.wanted.pitch_hz - self.pitch_hz);
        if loudness == 0.0 && self.loudness < SILENT {
            self.loudness = 0.0;
        }
        self.value()
    }

    /// The last samples: down to nothing.
    pub(super) fn fade(&mut self) -> Vec<i16> {
        let count = (FADE_S * f64::from(RATE)) as u32;
        let from = self.loudness;
        let at = |i: u32| from * f64::from(count - i) / f64::from(count);
        (1..=count)
            .map(|i| {
                self.loudness = at(i);
                self.value()
            })
            .collect()
    }

    fn value(&mut self) -> i16 {
        self.phase = (self.phase + self.pitch_hz / f64::from(RATE)).fract();
        (32767.0 * self.loudness * (TAU * self.phase).sin()).round() as i16
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The most from sample to sample of a sine of the highest pitch and the greatest loudness that a force sounds as, 880 Hz
    /// and a fifth of full scale, with what a fade from there adds and two roundings.
    pub(in crate::desktop) fn most_step() -> i32 {
        let full = 0.2 * 32767.0;
        let sine = full * TAU * 880.0 / f64::from(RATE);
        (sine + full / (FADE_S * f64::from(RATE)) + 1.0).ceil() as i32
    }

    /// The most from sample to sample.
    pub(in crate::desktop) fn step(samples: &[i16]) -> i32 {
        samples.windows(2).map(|pair| (i32::from(pair[1]) - i32::from(pair[0])).abs()).max().unwrap_or(0)
    }

    /// How often it goes up through nothing.
    pub(in crate::desktop) fn rises(samples: &[i16]) -> usize {
        samples.windows(2).filter(|pair| pair[0] < 0 && pair[1] >= 0).count()
    }

    /// A tone that is renewed every 50 ms for so many of them.
    fn play(synth: &mut Synth, tone: Tone, times: u32) -> Vec<i16> {
        let samples = |synth: &mut Synth| (0..RATE / 20).map(|_| synth.sample()).collect::<Vec<_>>();
        (0..times)
            .flat_map(|_| {
                synth.set(tone);
                samples(synth)
            })
            .collect()
    }

    #[test]
    fn it_has_the_pitch_and_the_loudness_that_it_is_told() {
        for pitch_hz in [220.0, 440.0, 880.0] {
            let mut synth = Synth::default();
            let heard = play(&mut synth, Tone { pitch_hz, loudness: 0.2 }, 24);
            let second = &heard[heard.len() - RATE as usize..];
            assert!((rises(second) as f64 - pitch_hz).abs() <= 1.0, "{} Hz", rises(second));
            let most = f64::from(second.iter().copied().max().unwrap()) / 32767.0;
            assert!((most - 0.2).abs() < 1e-3, "{most}");
        }
        // It glides from one to another.
        let mut synth = Synth::default();
        play(&mut synth, Tone { pitch_hz: 220.0, loudness: 0.1 }, 4);
        let heard = play(&mut synth, Tone { pitch_hz: 660.0, loudness: 0.1 }, 24);
        assert!((rises(&heard[heard.len() - RATE as usize..]) as f64 - 660.0).abs() <= 1.0);
    }

    #[test]
    fn neither_its_beginning_nor_a_change_nor_its_end_clicks() {
        let tone = |pitch_hz, loudness| Tone { pitch_hz, loudness };
        let mut synth = Synth::default();
        let mut heard = vec![0];
        for tone in [tone(880.0, 0.2), tone(220.0, 0.01), tone(880.0, 0.2), tone(0.0, 0.0), tone(880.0, 0.2)] {
            heard.extend(play(&mut synth, tone, 3));
        }
        heard.extend(synth.fade());
        assert_eq!(heard.last(), Some(&0));
        assert!(step(&heard) <= most_step(), "{} of {}", step(&heard), most_step());
        // Cut off, it would click.
        assert!(heard.iter().any(|&sample| i32::from(sample).abs() > 2 * most_step()));
    }

    #[test]
    fn what_is_not_told_anew_falls_silent() {
        let mut synth = Synth::default();
        play(&mut synth, Tone { pitch_hz: 440.0, loudness: 0.2 }, 10);
        let after = (0..RATE / 2).map(|_| synth.sample()).collect::<Vec<_>>();
        // 100 ms from when it was told last, 50 of which have passed, and ten times 15 ms to fade.
        let (sounding, silent) = after.split_at(RATE as usize / 5);
        assert!(sounding.iter().any(|&sample| sample > 6000) && silent.iter().all(|&sample| sample == 0));
        assert!(synth.is_silent() && step(&after) <= most_step());
    }
}
