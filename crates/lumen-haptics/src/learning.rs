//! Learns which axis feeds and which rolls: the user pushes, then turns, and the axis that moved is the one.

use serde::{Deserialize, Serialize};

use super::controls::{Axis, Controls, Motion, State};
use super::mapping::{AxisMapping, Mapping};

/// An axis is taken once it has gone this part of its way, or this many counts...
const ENOUGH: (f64, f64) = (0.25, 12.0);
/// ... and so many times as far as any other, each by that measure.
const CLEARLY: f64 = 2.0;

/// What the user is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Ask {
    /// To push forward.
    Push,
    /// To turn to the right.
    Turn,
    /// Nothing more.
    Done,
}

/// A mapping that is being learnt.
#[derive(Clone, Debug)]
pub struct Learning {
    /// Where all was when the user was asked.
    rest: Option<State>,
    /// The farthest that each axis has gone since then, in parts of what is enough; its sign says which way.
    farthest: Vec<f64>,
    learnt: Mapping,
    ask: Ask,
    travel: [f64; 2],
}

impl Learning {
    /// Asks for a push. `travel` is what one way of an axis is to feed, in mm, and to roll, in radians.
    pub fn new(travel: [f64; 2]) -> Self {
        Self { rest: None, farthest: Vec::new(), learnt: Mapping::default(), ask: Ask::Push, travel }
    }

    /// What the user is to do now.
    pub fn ask(&self) -> Ask {
        self.ask
    }

    /// What has been learnt so far.
    pub fn mapping(&self) -> Mapping {
        self.learnt
    }

    /// Goes on without this motion: the device has none for it.
    pub fn skip(&mut self) {
        self.next();
    }

    /// Takes in where all is now; says whether an axis was just found.
    pub fn observe(&mut self, controls: &Controls, state: &State) -> bool {
        if self.ask == Ask::Done {
            return false;
        }
        let rest = self.rest.get_or_insert_with(|| state.clone());
        self.farthest.resize(controls.axes.len(), 0.0);
        for (i, axis) in controls.axes.iter().enumerate() {
            let (Some(at), Some(began)) = (state.axes.get(i), rest.axes.get_mut(i)) else { continue };
            // The first report tells where it rests.
            if began.raw.is_none() {
                *began = *at;
            }
            let way = match axis.motion {
                Motion::Place | Motion::Deflection => 0.5 * (axis.part(at) - axis.part(began)) / ENOUGH.0,
                Motion::Change | Motion::Circle => (at.gone - began.gone) as f64 / ENOUGH.1,
            };
            if way.abs() > self.farthest[i].abs() {
                self.farthest[i] = way;
            }
        }
        let Some((axis, way)) = self.clear() else { return false };
        self.learn(axis, &controls.axes[axis], way);
        true
    }

    /// The axis that has gone far enough, and clearly farther than any other.
    fn clear(&self) -> Option<(usize, f64)> {
        let fed = self.learnt.feed.map(|feed| feed.axis);
        let free = self.farthest.iter().copied().enumerate().filter(|(axis, _)| Some(*axis) != fed);
        let (axis, way) = free.clone().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        let next = free.filter(|(other, _)| *other != axis).map(|(_, way)| way.abs()).fold(0.0, f64::max);
        (way.abs() >= 1.0 && way.abs() >= CLEARLY * next).then_some((axis, way))
    }

    fn learn(&mut self, number: usize, axis: &Axis, way: f64) {
        let which = usize::from(self.ask == Ask::Turn);
        let found = AxisMapping { is_inverted: way < 0.0, ..AxisMapping::new(number, axis.motion, self.travel[which]) };
        match self.ask {
            Ask::Push => self.learnt.feed = Some(found),
            Ask::Turn | Ask::Done => self.learnt.roll = Some(found),
        }
        self.next();
    }

    fn next(&mut self) {
        self.ask = if self.ask == Ask::Push { Ask::Turn } else { Ask::Done };
        self.rest = None;
        self.farthest.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::descriptor::parse;
    use crate::fixtures::descriptor;
    use crate::mapping::{Mode, TRAVEL};

    #[test]
    fn a_push_and_a_turn_of_a_six_axis_knob_are_told_apart_from_what_moves_along() {
        let model = parse(&descriptor("spacenavigator")).unwrap();
        let controls = Controls::new(&model);
        let (mut state, mut learning) = (controls.state(), Learning::new(TRAVEL));
        let six = |values: [i16; 3]| values.into_iter().flat_map(i16::to_le_bytes).collect::<Vec<_>>();
        let mut tell = |id: u8, values: [i16; 3]| {
            controls.read(&model, &mut state, id, &six(values));
            learning.observe(&controls, &state);
            (learning.ask(), learning.mapping())
        };
        assert_eq!(tell(1, [0, 0, 0]).0, Ask::Push);
        assert_eq!(tell(1, [30, -100, 10]).0, Ask::Push, "not far enough");
        assert_eq!(tell(2, [0, 0, 40]).0, Ask::Push);
        let (ask, mapping) = tell(1, [60, -200, 10]);
        let feed = mapping.feed.unwrap();
        assert_eq!((ask, feed.axis, feed.is_inverted), (Ask::Turn, 1, true));
        assert_eq!(feed.mode, Mode::Rate { full: 200.0 });
        assert_eq!(tell(1, [0, 0, 0]).0, Ask::Turn, "the push is let go");
        let (ask, mapping) = tell(2, [20, 30, 300]);
        assert_eq!((ask, mapping.roll.unwrap().axis, mapping.roll.unwrap().is_inverted), (Ask::Done, 5, false));
    }

    #[test]
    fn two_that_move_as_far_are_neither() {
        let model = parse(&descriptor("openffboard-2")).unwrap();
        let controls = Controls::new(&model);
        let (mut state, mut learning) = (controls.state(), Learning::new(TRAVEL));
        let mut report = [0; 24];
        controls.read(&model, &mut state, 1, &report);
        learning.observe(&controls, &state);
        report[8..12].copy_from_slice(&[0xFF, 0x7F, 0xFF, 0x6F]);
        controls.read(&model, &mut state, 1, &report);
        assert!(!learning.observe(&controls, &state));
        learning.skip();
        assert_eq!((learning.ask(), learning.mapping().feed), (Ask::Turn, None));
    }
}
