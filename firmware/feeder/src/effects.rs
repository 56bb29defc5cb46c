//! What a physical interface device plays (Universal Serial Bus, Device Class Definition for Physical Interface Devices 1.0,
//! 1999): reports in, a part of the greatest force for each axis out, every ms.
//!
//! Conditions are computed here, at the device's own rate; the host only moves their centres. A host that falls silent for
//! [`WATCHDOG_MS`] is felt no more, whatever plays.

use core::f32::consts::TAU;

use crate::feeder::{EFFECTS, WATCHDOG_MS, id};

/// The speed, in half ways a second, at which a damper of the greatest coefficient gives the greatest force.
const DAMPED: f32 = 10.0;

/// Why a report was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// It is none of the descriptor's, or too short.
    #[error("there is no report {id} of {bytes} bytes")]
    Unknown {
        /// Its id.
        id: u8,
        /// Its bytes, without the id.
        bytes: usize,
    },
    /// A number in it has no meaning: an effect that was not created, an axis, a type or a command that there is not.
    #[error("report {id} names something that there is not")]
    Meaningless {
        /// Its id.
        id: u8,
    },
}

/// Where an axis is and how fast it goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Part of the half way, -1 to 1.
    pub part: f32,
    /// Half ways a second.
    pub part_per_s: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Constant,
    Spring,
    Damper,
}

/// A spring's or damper's parameters along an axis: parts of the greatest.
#[derive(Clone, Copy, Debug, Default)]
struct Condition {
    centre: f32,
    /// On the positive side and on the negative one, as the next.
    coefficients: [f32; 2],
    saturations: [f32; 2],
    dead_band: f32,
}

#[derive(Clone, Copy, Debug)]
struct Effect {
    kind: Kind,
    /// 0 goes on until it is stopped.
    duration_ms: u16,
    gain: f32,
    /// How much of a constant force is along each axis; whether a condition acts on it at all.
    shares: [f32; 2],
    conditions: [Condition; 2],
    magnitude: f32,
    played_ms: Option<u32>,
}

/// What became of the last request for an effect.
#[derive(Clone, Copy, Debug)]
enum Load {
    Success(u8),
    Full,
    Error,
}

/// The effects and what else the host has said.
#[derive(Clone, Copy, Debug)]
pub struct Effects {
    effects: [Option<Effect>; EFFECTS as usize],
    load: Load,
    gain: f32,
    are_motors_on: bool,
    is_paused: bool,
    silent_ms: u32,
}

impl Default for Effects {
    fn default() -> Self {
        Self::new()
    }
}

fn i16_at(data: &[u8], at: usize) -> f32 {
    f32::from(i16::from_le_bytes([data[at], data[at + 1]])) / 32767.0
}

fn kind(number: u8) -> Option<Kind> {
    [Kind::Constant, Kind::Spring, Kind::Damper].get(usize::from(number).checked_sub(1)?).copied()
}

impl Condition {
    /// The force for so far from the centre, or so fast: against it.
    fn force(&self, away: f32) -> f32 {
        let side = usize::from(away < 0.0);
        let beyond = (away.abs() - self.dead_band.max(0.0)).max(0.0);
        let most = self.saturations[side].max(0.0);
        let force = (self.coefficients[side] * beyond).clamp(-most, most);
        if away < 0.0 { force } else { -force }
    }
}

impl Effect {
    fn new(kind: Kind) -> Self {
        Self {
            kind,
            duration_ms: 0,
            gain: 0.0,
            shares: [0.0; 2],
            conditions: [Condition::default(); 2],
            magnitude: 0.0,
            played_ms: None,
        }
    }

    fn force(&self, axis: usize, motion: Motion) -> f32 {
        let condition = &self.conditions[axis];
        let force = match self.kind {
            Kind::Constant => self.magnitude,
            Kind::Spring => condition.force(motion.part - condition.centre),
            Kind::Damper => condition.force(motion.part_per_s / DAMPED),
        };
        force * self.gain * self.shares[axis]
    }
}

impl Effects {
    /// None, and the motors off.
    pub const fn new() -> Self {
        Self {
            effects: [None; EFFECTS as usize],
            load: Load::Full,
            gain: 0.0,
            are_motors_on: false,
            is_paused: false,
            silent_ms: 0,
        }
    }

    /// Forgets all that it was told; the motors are off.
    pub fn forget(&mut self) {
        *self = Self::new();
    }

    /// Whether the host has switched the motors on.
    pub fn are_motors_on(&self) -> bool {
        self.are_motors_on
    }

    /// Whether the host has paused what plays.
    pub fn is_paused(&self) -> bool {
        self.is_paused
    }

    /// Whether an effect plays.
    pub fn is_playing(&self) -> bool {
        self.effects.iter().flatten().any(|effect| effect.played_ms.is_some())
    }

    /// Lets a ms pass: the force of all that plays, as a part of each axis's greatest, -1 to 1.
    pub fn advance(&mut self, motions: &[Motion; 2]) -> [f32; 2] {
        self.silent_ms = self.silent_ms.saturating_add(1);
        for effect in self.effects.iter_mut().flatten() {
            let lasts = |ms: &u32| effect.duration_ms == 0 || *ms <= u32::from(effect.duration_ms);
            effect.played_ms = effect.played_ms.map(|ms| ms.saturating_add(1)).filter(lasts);
        }
        if !self.are_motors_on || self.is_paused || self.silent_ms > WATCHDOG_MS {
            return [0.0; 2];
        }
        core::array::from_fn(|axis| {
            let playing = self.effects.iter().flatten().filter(|effect| effect.played_ms.is_some());
            let sum: f32 = playing.map(|effect| effect.force(axis, motions[axis])).sum();
            (sum * self.gain).clamp(-1.0, 1.0)
        })
    }

    /// Takes an output report, without its id. Bytes after its own are not looked at: some systems fill every report up to the
    /// longest.
    ///
    /// # Errors
    /// When it is none of the descriptor's or too short, or names something that there is not.
    pub fn take(&mut self, id: u8, data: &[u8]) -> Result<(), Refusal> {
        let known = match id {
            id::EFFECT => 9,
            id::CONDITION => 14,
            id::CONSTANT | id::OPERATION => 3,
            id::FREE | id::CONTROL | id::GAIN => 1,
            _ => 0,
        };
        if known == 0 || data.len() < known {
            return Err(Refusal::Unknown { id, bytes: data.len() });
        }
        self.silent_ms = 0;
        let done = match id {
            id::EFFECT => self.describe(data),
            id::CONDITION => self.set_condition(data),
            id::CONSTANT => self.effect(data[0]).map(|effect| effect.magnitude = i16_at(data, 1)),
            id::OPERATION => self.operate(data),
            id::FREE => self.free(data[0]),
            id::CONTROL => self.control(data[0]),
            _ => {
                self.gain = f32::from(data[0]) / 255.0;
                Some(())
            }
        };
        done.ok_or(Refusal::Meaningless { id })
    }

    /// Takes a feature report, without its id: a new effect is asked for. What became of it stands in [`Effects::feature`].
    ///
    /// # Errors
    /// When it is none that can be set.
    pub fn take_feature(&mut self, id: u8, data: &[u8]) -> Result<(), Refusal> {
        let (id::CREATE, [number, _, _]) = (id, data) else {
            return Err(Refusal::Unknown { id, bytes: data.len() });
        };
        let free = self.effects.iter().position(Option::is_none);
        self.load = match (kind(*number), free) {
            (None, _) => Load::Error,
            (_, None) => Load::Full,
            (Some(kind), Some(place)) => {
                self.effects[place] = Some(Effect::new(kind));
                Load::Success(place as u8 + 1)
            }
        };
        Ok(())
    }

    /// A feature report that can be got, without its id.
    pub fn feature(&self, id: u8) -> Option<[u8; 4]> {
        match (id, self.load) {
            (id::LOAD, Load::Success(index)) => Some([index, 1, 0, 0]),
            (id::LOAD, Load::Full) => Some([0, 2, 0, 0]),
            (id::LOAD, Load::Error) => Some([0, 3, 0, 0]),
            // No memory of the host's, so many effects at a time, managed by the device.
            (id::POOL, _) => Some([0, 0, EFFECTS, 1]),
            _ => None,
        }
    }

    fn effect(&mut self, index: u8) -> Option<&mut Effect> {
        self.effects.get_mut(usize::from(index).checked_sub(1)?)?.as_mut()
    }

    fn describe(&mut self, data: &[u8]) -> Option<()> {
        let kind = kind(data[1])?;
        let effect = self.effect(data[0])?;
        let has_direction = data[6] & 4 != 0;
        effect.kind = kind;
        effect.duration_ms = u16::from_le_bytes([data[2], data[3]]);
        effect.gain = f32::from(data[4]) / 255.0;
        effect.shares = if has_direction && kind == Kind::Constant {
            // A force comes from an angle: its sine is the first axis, less its cosine the second.
            let angle = f32::from(data[7]) / 255.0 * TAU;
            [libm::sinf(angle), -libm::cosf(angle)]
        } else {
            [data[6] & 1, data[6] >> 1 & 1].map(f32::from)
        };
        Some(())
    }

    fn set_condition(&mut self, data: &[u8]) -> Option<()> {
        let condition = self.effect(data[0])?.conditions.get_mut(usize::from(data[1] & 0x0F))?;
        *condition = Condition {
            centre: i16_at(data, 2),
            coefficients: [i16_at(data, 4), i16_at(data, 6)],
            saturations: [i16_at(data, 8), i16_at(data, 10)],
            dead_band: i16_at(data, 12),
        };
        Some(())
    }

    fn operate(&mut self, data: &[u8]) -> Option<()> {
        if data[1] == 2 {
            self.stop_all();
        }
        let effect = self.effect(data[0])?;
        effect.played_ms = match data[1] {
            1 | 2 => Some(0),
            3 => None,
            _ => return None,
        };
        Some(())
    }

    fn free(&mut self, index: u8) -> Option<()> {
        self.effect(index)?;
        self.effects[usize::from(index) - 1] = None;
        Some(())
    }

    fn stop_all(&mut self) {
        self.effects.iter_mut().flatten().for_each(|effect| effect.played_ms = None);
    }

    fn control(&mut self, command: u8) -> Option<()> {
        match command {
            1 => self.are_motors_on = true,
            2 => self.are_motors_on = false,
            3 => self.stop_all(),
            4 => *self = Self { gain: 1.0, load: self.load, ..Self::new() },
            5 => self.is_paused = true,
            6 => self.is_paused = false,
            _ => return None,
        }
        Some(())
    }
}

#[cfg(test)]
mod tests;
