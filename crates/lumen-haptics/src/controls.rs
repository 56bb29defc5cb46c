//! What a hand can move on a device: axes, hats and buttons, found by their usages, and where they are.
//!
//! What an axis's number means is not always what its descriptor says. A six-axis controller tells how far its knob is
//! pushed, whatever the flag for relative numbers says: a SpaceNavigator's says relative, a SpaceMouse Enterprise's
//! absolute, and both send the same (spacenavd reads both so).

use super::field::{Content, Field, Range};
use super::model::{DeviceModel, Kind};
use super::usage::{Usage, desktop, page, pid, simulation};

/// What an axis's numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// A place between two ends.
    Place,
    /// How far it is pushed; let go, it springs back to the middle.
    Deflection,
    /// By how much it was moved.
    Change,
    /// A place on a circle: after the greatest comes the least.
    Circle,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// What it is called.
    pub usage: Usage,
    /// What its numbers are.
    pub motion: Motion,
    /// The least and the greatest of them.
    pub range: Range,
    at: Place,
}

/// Where an element stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    report: u8,
    field: usize,
    element: u32,
}

/// All that a hand can move.
#[derive(Clone, Debug, Default)]
pub struct Controls {
    /// Axes, in the order of reports and bits.
    pub axes: Vec<Axis>,
    hats: Vec<Place>,
    buttons: Vec<(Usage, Place)>,
    /// Fields of buttons that say which are pressed.
    arrays: Vec<Place>,
}

/// Where an axis is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisState {
    /// The last number that came; `None` before the first.
    pub raw: Option<i64>,
    /// How far it has gone since the beginning, in units of its numbers: what a counter would show.
    pub gone: i64,
}

/// Where all is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Of each axis.
    pub axes: Vec<AxisState>,
    /// Of each hat: eighths of a turn from ahead, to the right; `None` where it is let go.
    pub hats: Vec<Option<u8>>,
    /// Of each button, whether it is pressed.
    pub buttons: Vec<bool>,
}

fn is_axis(usage: Usage) -> bool {
    (desktop::X..=desktop::WHEEL).contains(&usage) || (simulation::FIRST_AXIS..=simulation::LAST_AXIS).contains(&usage)
}

impl Controls {
    /// Those of a device.
    pub fn new(model: &DeviceModel) -> Self {
        let mut controls = Self::default();
        for report in model.reports.iter().filter(|report| report.kind == Kind::Input) {
            for (number, field) in report.fields.iter().enumerate() {
                // What the device says of its effects is no hand's.
                if model.is_in(field, pid::STATE_REPORT) {
                    continue;
                }
                let springs = model.is_in(field, desktop::MULTI_AXIS_CONTROLLER);
                let at = |element| Place { report: report.id, field: number, element };
                match field.content {
                    Content::Array if field.usages.get(0).is_some_and(|usage| usage.page() == page::BUTTON) => {
                        controls.arrays.push(at(0));
                        let count =
                            field.usages.position(field.usages.last().unwrap_or_default()).unwrap_or(0).min(255);
                        let pressed = (0..=count).filter_map(|place| field.usages.get(place));
                        controls.buttons.extend(pressed.map(|usage| (usage, Place { element: u32::MAX, ..at(0) })));
                    }
                    Content::Array => {}
                    Content::Variable => {
                        for element in 0..field.count.min(256) {
                            controls.add(field, element, at(element), springs);
                        }
                    }
                }
            }
        }
        controls
    }

    fn add(&mut self, field: &Field, element: u32, at: Place, springs: bool) {
        let Some(usage) = field.usage(element) else { return };
        if usage == desktop::HAT_SWITCH {
            self.hats.push(at);
        } else if is_axis(usage) && field.size > 1 {
            let motion = match field {
                _ if springs => Motion::Deflection,
                Field { is_relative: true, .. } => Motion::Change,
                Field { wraps: true, .. } => Motion::Circle,
                _ => Motion::Place,
            };
            self.axes.push(Axis { usage, motion, range: field.logical, at });
        } else if usage.page() == page::BUTTON && field.usages.get(element).is_some() {
            self.buttons.push((usage, at));
        }
    }

    /// What is to be told before the first report.
    pub fn state(&self) -> State {
        State {
            axes: vec![AxisState::default(); self.axes.len()],
            hats: vec![None; self.hats.len()],
            buttons: vec![false; self.buttons.len()],
        }
    }

    /// Number of buttons.
    pub fn buttons(&self) -> usize {
        self.buttons.len()
    }

    /// The number of the button of this usage.
    pub fn button(&self, usage: Usage) -> Option<usize> {
        self.buttons.iter().position(|(of, _)| *of == usage)
    }

    /// Takes in an input report without its id; `model` is the one that they were found in. Says whether the report has
    /// any of them. What is missing at the end of a report that is too short stays as it was.
    pub fn read(&self, model: &DeviceModel, state: &mut State, id: u8, data: &[u8]) -> bool {
        let Some(report) = model.report(Kind::Input, id) else { return false };
        let field = |at: Place| (at.report == id).then(|| report.fields.get(at.field))?;
        let value = |at: Place| field(at)?.read(data, at.element);
        let mut is_heard = false;
        for (axis, state) in self.axes.iter().zip(&mut state.axes) {
            if let Some(raw) = value(axis.at).filter(|raw| field(axis.at).is_some_and(|field| !field.is_null(*raw))) {
                is_heard = true;
                axis.take(state, raw);
            }
        }
        for (&at, hat) in self.hats.iter().zip(&mut state.hats) {
            if let (Some(field), Some(raw)) = (field(at), value(at)) {
                is_heard = true;
                let Range { least, greatest } = field.logical;
                let steps = greatest.saturating_sub(least).saturating_add(1);
                *hat = (least..=greatest)
                    .contains(&raw)
                    .then(|| ((raw - least) as f64 * 8.0 / steps as f64).round() as u8)
                    .filter(|_| steps >= 4);
            }
        }
        for ((_, at), pressed) in self.buttons.iter().zip(&mut state.buttons) {
            if at.element == u32::MAX {
                *pressed &= at.report != id;
            } else if let Some(raw) = value(*at) {
                is_heard = true;
                *pressed = raw != 0;
            }
        }
        for field in self.arrays.iter().filter_map(|&at| field(at)) {
            is_heard = true;
            for raw in (0..field.count.min(256)).filter_map(|element| field.read(data, element)) {
                let place = raw.checked_sub(field.logical.least).and_then(|place| u32::try_from(place).ok());
                let usage = place.and_then(|place| field.usages.get(place));
                if let Some(button) = usage.and_then(|usage| self.button(usage)) {
                    state.buttons[button] = true;
                }
            }
        }
        is_heard
    }
}

impl Axis {
    fn take(&self, state: &mut AxisState, raw: i64) {
        let change = match (self.motion, state.raw) {
            (Motion::Change, _) => raw,
            (_, None) => 0,
            (Motion::Circle, Some(before)) => {
                // The shorter way around.
                let turn = i128::from(self.range.greatest) - i128::from(self.range.least) + 1;
                let way = i128::from(raw) - i128::from(before);
                if turn < 2 { 0 } else { ((way + turn / 2).rem_euclid(turn) - turn / 2) as i64 }
            }
            (Motion::Place | Motion::Deflection, Some(before)) => raw.saturating_sub(before),
        };
        state.gone = state.gone.saturating_add(change);
        state.raw = Some(raw);
    }

    /// Where it is between its ends, -1 to 1; 0 before the first report.
    pub fn part(&self, state: &AxisState) -> f64 {
        let span = self.range.span();
        match state.raw {
            Some(raw) if span > 0.0 => (2.0 * (raw as f64 - self.range.least as f64) / span - 1.0).clamp(-1.0, 1.0),
            _ => 0.0,
        }
    }

    /// Its name, as it is shown.
    pub fn name(&self) -> String {
        let name = match self.usage {
            desktop::X => "X",
            desktop::Y => "Y",
            desktop::Z => "Z",
            desktop::RX => "Rx",
            desktop::RY => "Ry",
            desktop::RZ => "Rz",
            desktop::SLIDER => "Slider",
            desktop::DIAL => "Dial",
            desktop::WHEEL => "Wheel",
            simulation::STEERING => "Steering",
            other => return format!("Axis {other}"),
        };
        name.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::descriptor::parse;
    use crate::fixtures::descriptor;

    fn device(name: &str) -> (DeviceModel, Controls) {
        let model = parse(&descriptor(name)).unwrap();
        let controls = Controls::new(&model);
        (model, controls)
    }

    fn names(controls: &Controls) -> Vec<String> {
        controls.axes.iter().map(Axis::name).collect()
    }

    #[test]
    fn a_space_navigators_packets_are_what_was_done_to_it() {
        let (model, controls) = device("spacenavigator");
        assert_eq!(names(&controls), ["X", "Y", "Z", "Rx", "Ry", "Rz"]);
        assert!(controls.axes.iter().all(|axis| axis.motion == Motion::Deflection));
        let mut state = controls.state();
        // Packets that were captured, with what the hand did (github.com/AndunHH/spacemouse, SpaceNavigator.md).
        assert!(controls.read(&model, &mut state, 2, &[0x00, 0x00, 0xE2, 0xFF, 0x00, 0x00]));
        assert_eq!(state.axes[4].raw, Some(-30));
        assert!((controls.axes[4].part(&state.axes[4]) + 30.0 / 350.0).abs() < 1e-12);
        controls.read(&model, &mut state, 3, &[0x02, 0x00]);
        assert_eq!(state.buttons, [false, true]);
        controls.read(&model, &mut state, 3, &[0x03, 0x00]);
        assert_eq!(state.buttons, [true, true]);
        assert!(!controls.read(&model, &mut state, 9, &[0; 8]) && !controls.read(&model, &mut state, 1, &[]));
    }

    #[test]
    fn a_g29s_reports_are_read_as_others_read_them() {
        let (model, controls) = device("logitech-g29");
        assert_eq!(names(&controls), ["X", "Y", "Z", "Rz", "Rx", "Ry"]);
        let mut state = controls.state();
        // 4 axes of 8 bits, the hat in the low half of the fifth byte with 8 for none, buttons from its high half on: the
        // layout of hid-sony's and of github.com/nightmode/logitech-g29.
        controls.read(&model, &mut state, 1, &[0x80, 0x80, 0xFF, 0x00, 0x28, 0x00, 0x00, 0, 0]);
        assert_eq!(state.hats, [None]);
        assert_eq!(state.buttons.iter().position(|&pressed| pressed), Some(1));
        controls.read(&model, &mut state, 1, &[0x80, 0x80, 0xFF, 0x00, 0x02, 0x01, 0x00, 0, 0]);
        assert_eq!((state.hats[0], state.buttons.iter().position(|&pressed| pressed)), (Some(2), Some(4)));
        assert_eq!(
            state.axes.iter().map(|axis| axis.raw).take(3).collect::<Vec<_>>(),
            [Some(0x80), Some(0x80), Some(0xFF)]
        );
    }

    #[test]
    fn a_board_with_force_has_eight_axes_and_none_from_its_effects() {
        for name in ["openffboard-1", "openffboard-2", "openffboard-2-32"] {
            let (model, controls) = device(name);
            assert_eq!(names(&controls), ["X", "Y", "Z", "Rx", "Ry", "Rz", "Dial", "Slider"], "{name}");
            assert_eq!(controls.buttons.len(), 64);
            let mut state = controls.state();
            let mut report = vec![0; model.report(Kind::Input, 1).unwrap().bytes()];
            report[8..12].copy_from_slice(&[0xFF, 0xFF, 0xFF, 0xFF]);
            controls.read(&model, &mut state, 1, &report);
            assert_eq!(state.axes[0].raw, Some(-1));
        }
    }

    #[test]
    fn a_circle_goes_on_behind_its_end() {
        let axis = Axis {
            usage: desktop::DIAL,
            motion: Motion::Circle,
            range: Range { least: 0, greatest: 255 },
            at: Place { report: 0, field: 0, element: 0 },
        };
        let mut state = AxisState::default();
        [250, 254, 2, 5, 1, 255].into_iter().for_each(|raw| axis.take(&mut state, raw));
        assert_eq!(state.gone, 4 + 4 + 3 - 4 - 2);
    }

    #[test]
    fn buttons_of_an_array_are_those_that_it_names() {
        // Two bytes that name up to two of buttons 1 to 8.
        let bytes = [5, 1, 9, 4, 0xA1, 1, 5, 9, 0x19, 1, 0x29, 8, 0x15, 1, 0x25, 8, 0x75, 8, 0x95, 2, 0x81, 0, 0xC0];
        let model = parse(&bytes).unwrap();
        let controls = Controls::new(&model);
        let mut state = controls.state();
        assert!(controls.read(&model, &mut state, 0, &[3, 8]));
        assert_eq!(state.buttons, [false, false, true, false, false, false, false, true]);
        controls.read(&model, &mut state, 0, &[0, 99]);
        assert!(!state.buttons.contains(&true));
    }
}
