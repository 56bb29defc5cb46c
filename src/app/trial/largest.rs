//! The largest forces of all runs on a surface: the bars and the colours of the wall grow with them.

use crate::trial::frame::{Frame, Touch};

/// The end of a bar while forces are small, in N: a floppy wire presses with less.
const MIN_SCALE: f64 = 0.001;

/// The largest forces so far, in N.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Largest {
    wall: f32,
    push: f32,
}

impl Largest {
    /// Takes what a frame tells.
    pub(super) fn take(&mut self, frame: &Frame) {
        self.wall = self.wall.max(frame.max_wall_force_n as f32);
        self.push = self.push.max(frame.push_n.abs() as f32);
    }

    /// Takes what the wall has felt.
    pub(super) fn feel(&mut self, touches: &[Touch]) {
        self.wall = touches.iter().fold(self.wall, |most, touch| most.max(touch.force));
    }

    /// The force at one place of the wall that has the last colour and the end of its bar, in N.
    pub(super) fn wall_scale(&self) -> f32 {
        scale(self.wall)
    }

    /// The end of the bar of the push, in N.
    pub(super) fn push_scale(&self) -> f32 {
        scale(self.push)
    }
}

/// Where a bar ends for forces of up to `peak`: the next of 0.001, 0.002, 0.005, 0.01, ... N.
fn scale(peak: f32) -> f32 {
    let mut scale = MIN_SCALE;
    for growth in [2.0, 2.5, 2.0].into_iter().cycle().take(24) {
        if scale as f32 >= peak {
            break;
        }
        scale *= growth;
    }
    scale as f32
}

#[cfg(test)]
mod tests {
    #[test]
    fn bars_grow_by_round_steps() {
        let peaks = [0.0, 0.001, 0.0011, 0.009, 0.011, 0.101, 0.35, 0.6, 1.0, 1.1, 4.9, 11.0];
        assert_eq!(peaks.map(super::scale), [0.001, 0.001, 0.002, 0.01, 0.02, 0.2, 0.5, 1.0, 1.0, 2.0, 5.0, 20.0]);
        assert!(super::scale(f32::INFINITY).is_finite());
    }
}
