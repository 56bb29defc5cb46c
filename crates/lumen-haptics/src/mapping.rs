//! Which axis feeds and which rolls, and how: a place that is the wire's own, counts, or a speed.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::controls::{Controls, Motion, State};
use super::usage::{desktop, simulation};

/// What one way of an axis, or half a second at full speed, feeds, in mm, and rolls, in radians, unless the device's own way
/// is known or the user says otherwise.
pub(super) const TRAVEL: [f64; 2] = [100.0, 4.0 * PI];

/// What an axis's motion becomes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Mode {
    /// The axis's way is the wire's: from one end to the other it goes so far, in mm or radians.
    Absolute {
        /// That, more than 0.
        travel: f64,
    },
    /// A count of the axis moves so far, in mm or radians.
    Relative {
        /// That, more than 0.
        per_count: f64,
    },
    /// Pushed to its end, the axis moves so fast, in mm/s or rad/s.
    Rate {
        /// That, more than 0.
        full: f64,
    },
}

/// What feeds, or what rolls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisMapping {
    /// The axis, by its number in [`Controls::axes`].
    pub axis: usize,
    /// How.
    pub mode: Mode,
    /// What does nothing around the middle of a rate, and what play an absolute axis has: part of half of its way, 0 to 0.9.
    pub dead_zone: f64,
    /// Whether the other way is forward.
    pub is_inverted: bool,
}

impl AxisMapping {
    /// What fits an axis: its own way where it has ends, a speed where it springs back, else counts. `travel` is what one
    /// way of it, or half a second at full speed, moves.
    pub fn new(axis: usize, motion: Motion, travel: f64) -> Self {
        let (mode, dead_zone) = match motion {
            Motion::Place => (Mode::Absolute { travel }, 0.0),
            Motion::Deflection => (Mode::Rate { full: 2.0 * travel }, 0.08),
            Motion::Change | Motion::Circle => (Mode::Relative { per_count: travel / 100.0 }, 0.0),
        };
        Self { axis, mode, dead_zone, is_inverted: false }
    }

    /// How far half of the axis's way moves, in mm or radians; of one without ends, a hundred counts or a second.
    pub fn half_way(&self) -> f64 {
        match self.mode {
            Mode::Absolute { travel } => 0.5 * travel,
            Mode::Relative { per_count } => 100.0 * per_count,
            Mode::Rate { full } => full,
        }
    }
}

/// What feeds and what rolls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mapping {
    /// Feeds, in mm; positive goes in.
    pub feed: Option<AxisMapping>,
    /// Rolls, in radians; positive is right-handed about the way in.
    pub roll: Option<AxisMapping>,
    /// While this button is pressed absolute axes move alone, by its number: the hand goes back for another stroke.
    pub clutch: Option<usize>,
}

impl Mapping {
    /// What most devices are held by: the first axis that is pushed feeds, the first that is turned rolls, or else the next
    /// one; the first button is the clutch of an axis with ends. `travel` is what one way of an axis feeds, in mm, and rolls,
    /// in radians.
    pub fn proposed(controls: &Controls, travel: [f64; 2]) -> Self {
        let turned = [desktop::RX, desktop::RY, desktop::RZ, desktop::DIAL, simulation::STEERING];
        let axes = &controls.axes;
        let feed =
            axes.iter().position(|axis| !turned.contains(&axis.usage)).or(Some(0)).filter(|feed| *feed < axes.len());
        let turns = axes.iter().position(|axis| turned.contains(&axis.usage)).filter(|roll| Some(*roll) != feed);
        let roll = turns.or_else(|| (0..axes.len()).find(|other| Some(*other) != feed));
        let [feed, roll] = [(feed, travel[0]), (roll, travel[1])]
            .map(|(axis, travel)| axis.map(|axis| AxisMapping::new(axis, axes[axis].motion, travel)));
        let has_ends = feed.is_some_and(|feed| matches!(feed.mode, Mode::Absolute { .. }));
        Self { feed, roll, clutch: (has_ends && controls.buttons() > 0).then_some(0) }
    }
}

/// What has been taken over of the axes' motion.
#[derive(Clone, Debug, Default)]
pub struct Mapper {
    mapping: Mapping,
    /// Of feed and roll: the place of an absolute axis, or the count of a relative one, up to which it is.
    taken: [Option<f64>; 2],
}

impl Mapper {
    /// By a mapping, from where the axes are at the first [`Mapper::advance`] on.
    pub fn new(mapping: Mapping) -> Self {
        Self { mapping, taken: [None; 2] }
    }

    /// The mapping.
    pub fn mapping(&self) -> &Mapping {
        &self.mapping
    }

    /// How far to feed, in mm, and to roll, in radians, for what the axes did in the last `dt_s` seconds.
    pub fn advance(&mut self, controls: &Controls, state: &State, dt_s: f64) -> [f64; 2] {
        let is_clutched = self.mapping.clutch.is_some_and(|button| state.buttons.get(button) == Some(&true));
        let mut moved = [0.0; 2];
        for (i, of) in [self.mapping.feed, self.mapping.roll].into_iter().enumerate() {
            let Some(of) = of else { continue };
            let (Some(axis), Some(at)) = (controls.axes.get(of.axis), state.axes.get(of.axis)) else { continue };
            if at.raw.is_none() {
                continue;
            }
            let dead = of.dead_zone.clamp(0.0, 0.9);
            let sign = if of.is_inverted { -1.0 } else { 1.0 };
            let way = match of.mode {
                Mode::Absolute { travel } => {
                    let place = axis.part(at);
                    let taken = *self.taken[i].get_or_insert(place);
                    // Play: what is taken over follows behind by the dead zone.
                    let follows = if is_clutched { place } else { taken.clamp(place - dead, place + dead) };
                    self.taken[i] = Some(follows);
                    if is_clutched { 0.0 } else { 0.5 * travel * (follows - taken) }
                }
                Mode::Relative { per_count } => {
                    let gone = at.gone as f64;
                    let taken = self.taken[i].replace(gone).unwrap_or(gone);
                    per_count * (gone - taken)
                }
                Mode::Rate { full } => {
                    let part = axis.part(at);
                    full * dt_s * part.signum() * ((part.abs() - dead) / (1.0 - dead)).max(0.0)
                }
            };
            moved[i] = if way.is_finite() { sign * way } else { 0.0 };
        }
        moved
    }

    /// Where on its way, -1 to 1, an absolute axis is; `None` for one that has no such place. 0 is feed, 1 is roll.
    pub fn place(&self, controls: &Controls, state: &State, which: usize) -> Option<f64> {
        let of = [self.mapping.feed, self.mapping.roll].get(which).copied()??;
        let (axis, at) = (controls.axes.get(of.axis)?, state.axes.get(of.axis)?);
        matches!(of.mode, Mode::Absolute { .. }).then(|| axis.part(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controls::AxisState;
    use crate::descriptor::parse;
    use crate::fixtures::descriptor;

    fn board() -> (Controls, State) {
        let controls = Controls::new(&parse(&descriptor("openffboard-2")).unwrap());
        let state = controls.state();
        (controls, state)
    }

    fn put(state: &mut State, axis: usize, raw: i64) {
        let before = state.axes[axis];
        state.axes[axis] = AxisState { raw: Some(raw), gone: before.gone + raw - before.raw.unwrap_or(raw) };
    }

    #[test]
    fn an_absolute_axis_moves_the_wire_as_it_goes_and_the_clutch_lets_it_back() {
        let (controls, mut state) = board();
        let feed = AxisMapping::new(0, Motion::Place, 100.0);
        let clutch = controls.button(crate::usage::Usage::new(9, 1));
        let mut mapper = Mapper::new(Mapping { feed: Some(feed), roll: None, clutch });
        assert_eq!(mapper.advance(&controls, &state, 0.01), [0.0; 2], "before the first report");
        put(&mut state, 0, -32767);
        assert_eq!(mapper.advance(&controls, &state, 0.01), [0.0; 2], "where it is found is no motion");
        put(&mut state, 0, 32767);
        assert!((mapper.advance(&controls, &state, 0.01)[0] - 100.0).abs() < 1e-9);
        state.buttons[clutch.unwrap()] = true;
        put(&mut state, 0, 0);
        assert_eq!(mapper.advance(&controls, &state, 0.01), [0.0; 2]);
        state.buttons[clutch.unwrap()] = false;
        put(&mut state, 0, 16384);
        assert!((mapper.advance(&controls, &state, 0.01)[0] - 25.0).abs() < 0.01);
        assert!((mapper.place(&controls, &state, 0).unwrap() - 0.5).abs() < 1e-3);
    }

    #[test]
    fn play_is_taken_up_before_the_wire_moves() {
        let (controls, mut state) = board();
        let feed = AxisMapping { dead_zone: 0.1, ..AxisMapping::new(0, Motion::Place, 100.0) };
        let mut mapper = Mapper::new(Mapping { feed: Some(feed), ..Mapping::default() });
        let mut to = |part: f64| {
            put(&mut state, 0, (part * 32767.0) as i64);
            mapper.advance(&controls, &state, 0.01)[0]
        };
        assert_eq!((to(0.0), to(0.09), to(-0.09)), (0.0, 0.0, 0.0));
        assert!((to(0.3) - 10.0).abs() < 0.01);
        assert_eq!(to(0.15), 0.0);
    }

    #[test]
    fn a_rate_grows_from_the_dead_zone_on_and_counts_add_up() {
        let (controls, mut state) = board();
        let roll = AxisMapping { axis: 1, mode: Mode::Rate { full: 6.0 }, dead_zone: 0.2, is_inverted: true };
        let feed = AxisMapping { axis: 0, mode: Mode::Relative { per_count: 0.5 }, dead_zone: 0.0, is_inverted: false };
        let mut mapper = Mapper::new(Mapping { feed: Some(feed), roll: Some(roll), clutch: None });
        put(&mut state, 0, 0);
        put(&mut state, 1, (0.19 * 32767.0) as i64);
        assert_eq!(mapper.advance(&controls, &state, 0.5), [0.0, 0.0]);
        put(&mut state, 1, 32767);
        put(&mut state, 0, -7);
        let [feed, roll] = mapper.advance(&controls, &state, 0.5);
        assert_eq!(feed, -3.5);
        assert!((roll + 3.0).abs() < 1e-9);
        // An axis that there is not, or a scale that is no number, moves nothing.
        let mut wrong = Mapper::new(Mapping {
            feed: Some(AxisMapping { axis: 99, ..AxisMapping::new(0, Motion::Place, f64::NAN) }),
            ..Mapping::default()
        });
        assert_eq!(wrong.advance(&controls, &state, 0.5), [0.0, 0.0]);
    }
}
