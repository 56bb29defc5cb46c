//! The open feeder without a feeder: what its firmware does with reports, and a hand on its two axes, at 1 kHz. For tests,
//! and for whoever wants to see what a device would feel.
//!
//! It takes reports apart by the places of their bytes, as firmware does, and shares no code with the side that makes them.
//! It is stricter than a device need be: a report of a wrong length or an unknown id is refused.

mod hand;

use std::collections::VecDeque;

pub use hand::Hand;

use super::feeder::{DESCRIPTOR, EFFECTS, WATCHDOG_MS, id};
use super::port::{InputReport, Port, PortError};

/// The speed, in half ways a second, at which a damper of the greatest coefficient gives the greatest force.
const DAMPED: f64 = 10.0;
/// Input reports that wait for a host that does not poll; older ones are lost, as in a system's queue.
const WAITING: usize = 64;

/// What an effect is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Constant,
    Spring,
    Damper,
}

/// A spring's or damper's parameters: parts of the greatest.
#[derive(Clone, Copy, Debug, Default)]
struct Condition {
    centre: f64,
    coefficients: [f64; 2],
    saturations: [f64; 2],
    dead_band: f64,
}

#[derive(Clone, Copy, Debug)]
struct Effect {
    kind: Kind,
    duration_ms: u16,
    gain: f64,
    axes: u8,
    has_direction: bool,
    direction: u8,
    conditions: [Condition; 2],
    magnitude: f64,
    started_ms: Option<u32>,
}

/// A feeder in the hand of somebody.
#[derive(Clone, Debug)]
pub struct VirtualFeeder {
    /// The hand on the feed, in mm and N, and on the roll, in radians and N mm.
    pub hands: [Hand; 2],
    /// Whether the clutch is pressed.
    pub clutch: bool,
    now_ms: u32,
    /// The time by the clock of whoever paces it, up to which it has gone.
    paced_ms: Option<f64>,
    heard_ms: u32,
    are_motors_on: bool,
    is_paused: bool,
    gain: f64,
    effects: [Option<Effect>; EFFECTS as usize],
    loaded: [u8; 2],
    reports: VecDeque<InputReport>,
    is_plugged: bool,
    forces: [f64; 2],
}

impl Default for VirtualFeeder {
    fn default() -> Self {
        Self {
            hands: [Hand::feed(), Hand::roll()],
            clutch: false,
            now_ms: 0,
            paced_ms: None,
            heard_ms: 0,
            are_motors_on: false,
            is_paused: false,
            gain: 0.0,
            effects: [None; EFFECTS as usize],
            loaded: [0, 2],
            reports: VecDeque::new(),
            is_plugged: true,
            forces: [0.0; 2],
        }
    }
}

fn i16_at(data: &[u8], at: usize) -> f64 {
    f64::from(i16::from_le_bytes([data[at], data[at + 1]])) / 32767.0
}

impl VirtualFeeder {
    /// The force of each motor in the last ms, in N and N mm.
    pub fn forces(&self) -> [f64; 2] {
        self.forces
    }

    /// ms since it was plugged in.
    pub fn now_ms(&self) -> u32 {
        self.now_ms
    }

    /// Unplugs it: what it was told is forgotten.
    pub fn unplug(&mut self) {
        *self = Self {
            is_plugged: false,
            hands: self.hands,
            now_ms: self.now_ms,
            paced_ms: self.paced_ms,
            ..Self::default()
        };
    }

    /// Plugs it in again.
    pub fn plug_in(&mut self) {
        self.is_plugged = true;
    }

    /// Lets as much time pass as has by a clock that shows `now_ms`, its hand wanting it at these places in mm and radians.
    /// After a pause of more than 50 ms it goes on, and does not hurry after it.
    pub fn keep_pace(&mut self, now_ms: f64, wanted: [f64; 2]) {
        (0..2).for_each(|axis| self.hands[axis].wanted = wanted[axis]);
        let from = self.paced_ms.unwrap_or(now_ms).max(now_ms - 50.0);
        let steps = (now_ms - from).max(0.0) as u32;
        (0..steps).for_each(|_| self.advance());
        self.paced_ms = Some(from + f64::from(steps));
    }

    /// Lets a ms pass: motors and hands, then an input report.
    pub fn advance(&mut self) {
        self.now_ms += 1;
        let is_heard = self.now_ms - self.heard_ms <= WATCHDOG_MS;
        let is_on = self.is_plugged && self.are_motors_on && !self.is_paused && is_heard;
        let now = self.now_ms;
        for effect in self.effects.iter_mut().flatten() {
            let lasts = |&started: &u32| effect.duration_ms == 0 || now - started <= u32::from(effect.duration_ms);
            effect.started_ms = effect.started_ms.filter(lasts);
        }
        for axis in 0..2 {
            let part = if is_on { self.part(axis) } else { 0.0 };
            let hand = &mut self.hands[axis];
            self.forces[axis] = part * hand.most_force;
            hand.advance(self.forces[axis]);
        }
        if self.is_plugged {
            if self.reports.len() == WAITING {
                self.reports.pop_front();
            }
            self.reports.push_back(self.state());
        }
    }

    fn state(&self) -> InputReport {
        let mut data = vec![u8::from(self.clutch)];
        for hand in &self.hands {
            let counts = (hand.part().clamp(-1.0, 1.0) * 32767.0).round() as i16;
            data.extend(counts.to_le_bytes());
        }
        InputReport { id: id::STATE, data }
    }

    /// The force of all that plays along an axis, as a part of the most.
    fn part(&self, axis: usize) -> f64 {
        let (place, speed) = (self.hands[axis].part(), self.hands[axis].part_per_s());
        let playing = self.effects.iter().flatten().filter(|effect| {
            let is_on = effect.axes >> axis & 1 == 1 || effect.has_direction && effect.kind == Kind::Constant;
            is_on && effect.started_ms.is_some()
        });
        let sum: f64 = playing
            .map(|effect| {
                let condition = &effect.conditions[axis];
                let part = match effect.kind {
                    Kind::Constant if effect.has_direction => {
                        let angle = f64::from(effect.direction) / 255.0 * std::f64::consts::TAU;
                        effect.magnitude * if axis == 0 { libm::sin(angle) } else { -libm::cos(angle) }
                    }
                    Kind::Constant => effect.magnitude,
                    Kind::Spring => condition.force(place - condition.centre),
                    Kind::Damper => condition.force(speed / DAMPED),
                };
                part * effect.gain
            })
            .sum();
        (sum * self.gain).clamp(-1.0, 1.0)
    }

    fn effect(&mut self, index: u8, id: u8) -> Result<&mut Effect, PortError> {
        let effect = usize::from(index).checked_sub(1).and_then(|place| self.effects.get_mut(place)?.as_mut());
        effect.ok_or_else(|| refused(id, "there is no such effect"))
    }

    fn stop_all(&mut self) {
        self.effects.iter_mut().flatten().for_each(|effect| effect.started_ms = None);
    }

    fn control(&mut self, command: u8) -> Result<(), PortError> {
        match command {
            1 => self.are_motors_on = true,
            2 => self.are_motors_on = false,
            3 => self.stop_all(),
            4 => {
                self.effects = [None; EFFECTS as usize];
                self.are_motors_on = false;
                self.is_paused = false;
                self.gain = 1.0;
            }
            5 => self.is_paused = true,
            6 => self.is_paused = false,
            _ => return Err(refused(id::CONTROL, "there is no such command")),
        }
        Ok(())
    }

    fn set_effect(&mut self, data: &[u8]) -> Result<(), PortError> {
        let kind = kind(data[1]).ok_or_else(|| refused(id::EFFECT, "there is no such type"))?;
        let effect = self.effect(data[0], id::EFFECT)?;
        effect.kind = kind;
        effect.duration_ms = u16::from_le_bytes([data[2], data[3]]);
        effect.gain = f64::from(data[4]) / 255.0;
        effect.axes = data[6] & 3;
        effect.has_direction = data[6] & 4 != 0;
        effect.direction = data[7];
        Ok(())
    }

    fn set_condition(&mut self, data: &[u8]) -> Result<(), PortError> {
        let place = usize::from(data[1] & 0x0F);
        let effect = self.effect(data[0], id::CONDITION)?;
        let condition =
            effect.conditions.get_mut(place).ok_or_else(|| refused(id::CONDITION, "there is no such axis"))?;
        *condition = Condition {
            centre: i16_at(data, 2),
            coefficients: [i16_at(data, 4), i16_at(data, 6)],
            saturations: [i16_at(data, 8), i16_at(data, 10)],
            dead_band: i16_at(data, 12),
        };
        Ok(())
    }

    fn operate(&mut self, data: &[u8]) -> Result<(), PortError> {
        let now = self.now_ms;
        if data[1] == 2 {
            self.stop_all();
        }
        let effect = self.effect(data[0], id::OPERATION)?;
        effect.started_ms = match data[1] {
            1 | 2 => Some(now),
            3 => None,
            _ => return Err(refused(id::OPERATION, "there is no such operation")),
        };
        Ok(())
    }
}

fn kind(number: u8) -> Option<Kind> {
    [Kind::Constant, Kind::Spring, Kind::Damper].get(usize::from(number).checked_sub(1)?).copied()
}

impl Condition {
    /// The force for so far from the centre, or so fast: against it.
    fn force(&self, away: f64) -> f64 {
        let beyond = (away.abs() - self.dead_band.max(0.0)).max(0.0);
        let side = usize::from(away < 0.0);
        let most = self.saturations[side].max(0.0);
        -away.signum() * (self.coefficients[side] * beyond).clamp(-most, most)
    }
}

fn refused(id: u8, reason: &str) -> PortError {
    PortError::Refused { id, reason: reason.to_owned() }
}

impl Port for VirtualFeeder {
    fn descriptor(&self) -> &[u8] {
        DESCRIPTOR
    }

    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        if !self.is_plugged {
            return Err(PortError::Gone);
        }
        let lengths = [(id::EFFECT, 9), (id::CONDITION, 14), (id::CONSTANT, 3), (id::OPERATION, 3), (id::FREE, 1)];
        let lengths = lengths.into_iter().chain([(id::CONTROL, 1), (id::GAIN, 1)]);
        if !lengths.into_iter().any(|known| known == (id, data.len())) {
            return Err(refused(id, "it has another length"));
        }
        self.heard_ms = self.now_ms;
        match id {
            id::EFFECT => self.set_effect(data),
            id::CONDITION => self.set_condition(data),
            id::CONSTANT => self.effect(data[0], id).map(|effect| effect.magnitude = i16_at(data, 1)),
            id::OPERATION => self.operate(data),
            id::FREE => {
                self.effect(data[0], id)?;
                self.effects[usize::from(data[0]) - 1] = None;
                Ok(())
            }
            id::CONTROL => self.control(data[0]),
            _ => {
                self.gain = f64::from(data[0]) / 255.0;
                Ok(())
            }
        }
    }

    fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        if !self.is_plugged {
            return Err(PortError::Gone);
        }
        let [number, _, _] = data else { return Err(refused(id, "it has another length")) };
        if id != id::CREATE {
            return Err(refused(id, "it cannot be set"));
        }
        let free = self.effects.iter().position(Option::is_none);
        self.loaded = match (kind(*number), free) {
            (None, _) => [0, 3],
            (_, None) => [0, 2],
            (Some(kind), Some(place)) => {
                self.effects[place] = Some(Effect {
                    kind,
                    duration_ms: 0,
                    gain: 0.0,
                    axes: 0,
                    has_direction: false,
                    direction: 0,
                    conditions: [Condition::default(); 2],
                    magnitude: 0.0,
                    started_ms: None,
                });
                [place as u8 + 1, 1]
            }
        };
        Ok(())
    }

    fn get_feature(&mut self, id: u8, _bytes: usize) -> Result<Vec<u8>, PortError> {
        if !self.is_plugged {
            return Err(PortError::Gone);
        }
        // With its id, as most systems have it.
        match id {
            id::LOAD => Ok(vec![id, self.loaded[0], self.loaded[1], 0, 0]),
            id::POOL => Ok(vec![id, 0, 0, EFFECTS, 1]),
            _ => Err(refused(id, "it cannot be got")),
        }
    }

    fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
        if self.is_plugged { Ok(self.reports.pop_front()) } else { Err(PortError::Gone) }
    }
}

#[cfg(test)]
mod firmware;
#[cfg(test)]
mod tests;
