//! What a trial shows of itself: rows of its log, and frames.

use glam::DVec3;

use super::{ROW_STEPS, Trial};
use crate::STEP;
use crate::frame::Frame;
use crate::log::Row;

impl Trial {
    /// The row of the log from now on.
    pub(super) fn row(&self) -> Row {
        let state = &self.state;
        let simulation = &state.simulation;
        let (forces, since) = (state.meter.forces, state.meter.since_row);
        Row {
            step: simulation.steps(),
            input: state.input,
            wire: state.wire,
            inserted_mm: simulation.inserted(),
            roll: simulation.roll(),
            tip: simulation.tip(),
            tip_direction: simulation.tip_direction(),
            arc_mm: state.arc,
            branch: state.located.map_or(0, |located| located.branch),
            is_off: state.is_off,
            target_mm: self.course.route.distance_to_target(simulation.tip()),
            path_ratio: state.meter.path_mm / self.course.route.length_mm,
            contacts: forces.contacts,
            wall_force_n: forces.wall_force_n,
            max_wall_force_n: since.max_wall_force_n,
            max_at: if since.max_wall_force_n > 0.0 { since.max_at } else { simulation.tip() },
            tip_force_n: forces.tip_force_n,
            push_n: forces.push_n,
            torque_n_mm: forces.torque_n_mm,
            retractions: state.meter.retractions,
            wrong_branches: state.meter.wrong_branches,
            step_ms: self.stopwatch.last_ms(ROW_STEPS as usize),
            since,
        }
    }

    /// The wire and all that is told of it now; what depends on the clock is filled in by the caller.
    pub fn frame(&self) -> Frame {
        let state = &self.state;
        let simulation = &state.simulation;
        let plain = |v: DVec3| v.as_vec3().to_array();
        let forces = state.meter.forces;
        let [direction, side] = self.tip_side();
        Frame {
            step: simulation.steps(),
            time_s: simulation.steps() as f64 * STEP,
            wire: state.wire,
            nodes: simulation.nodes().map(plain).collect(),
            report: simulation.report(),
            step_kinds: state.meter.counts,
            contacts: forces.contacts,
            tip_direction: plain(direction),
            tip_side: plain(side.reject_from(direction).normalize_or(side)),
            inserted_mm: simulation.inserted(),
            roll: simulation.roll(),
            feed: state.input.feed,
            push_n: forces.push_n,
            torque_n_mm: forces.torque_n_mm,
            wall_force_n: forces.wall_force_n,
            max_wall_force_n: forces.max_wall_force_n,
            tip_force_n: forces.tip_force_n,
            arc_mm: state.arc,
            target_mm: self.course.route.distance_to_target(simulation.tip()),
            branch: state.located.map_or(0, |located| located.branch),
            is_wrong_branch: state.is_off,
            is_looped: state.is_looped,
            progress: state.progress,
            doing: self.is_steered.then(|| self.task()),
            steps_per_second: 0.0,
            is_behind: false,
        }
    }
}
