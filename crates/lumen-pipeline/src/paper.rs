//! What the paper printed of this method: its tables, and the settings of its figures.
//!
//! "Mesh Optimization of Vessel Surface Model for Computer-Aided Simulation of Percutaneous Coronary Intervention": the
//! surface was one segment of an abdominal aorta, cut from a CT angiogram by marching cubes. It is not published.

use super::settings::{Decimation, Keep, Settings, Smoothing, Target};

/// Table I: polygons of the paper's surface before its connectivity was validated, and after.
pub const TABLE_I: [usize; 2] = [74_307, 74_307];

/// Table II: reduction rates in percent, and the polygons left at each.
pub const TABLE_II: [(u32, usize); 5] = [(10, 66_875), (50, 37_153), (75, 18_576), (90, 7_430), (99, 743)];

/// A row of the paper's tables of its trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrialRow {
    /// Reduction rate in percent.
    pub rate: u32,
    /// Frames a second when the guidewire came into the model.
    pub initial_fps: u32,
    /// Their mean at five places on the way.
    pub average_fps: u32,
    /// Whether the wire came to the given place in the coronary arteries.
    pub success: bool,
}

const fn row(rate: u32, initial_fps: u32, average_fps: u32, success: bool) -> TrialRow {
    TrialRow { rate, initial_fps, average_fps, success }
}

/// Table III: the trial in the models of Table II.
pub const TABLE_III: [TrialRow; 5] = [
    row(10, 30, 6, false),
    row(50, 35, 10, false),
    row(75, 38, 15, true),
    row(90, 41, 18, true),
    row(99, 42, 30, true),
];

/// Table IV: the trial in aorta and coronary arteries together.
pub const TABLE_IV: [TrialRow; 3] = [row(90, 20, 4, false), row(95, 32, 6, false), row(99, 31, 11, true)];

/// Figure 6: pass band and iterations of its six panels, row by row.
pub const FIGURE_6: [(f64, u32); 6] = [(0.1, 30), (0.1, 60), (0.1, 100), (0.01, 30), (0.01, 60), (0.01, 100)];

/// Figure 7: reduction rates of its three columns, in percent.
pub const FIGURE_7: [u32; 3] = [10, 90, 99];

/// The paper's settings at a reduction rate in percent: Hamming window, pass band 0.01, 100 iterations, one order for all vessels.
pub fn reduced(percent: u32, keep: Keep) -> Settings {
    let decimation = Decimation { spare_thin: false, ..Decimation::default() };
    Settings {
        keep,
        smoothing: Smoothing::PAPER,
        decimation,
        target: Target::Reduction(percent * 10),
        ..Settings::default()
    }
}

/// The settings of Figure 6: smoothed in six ways, not reduced.
pub fn figure_6(keep: Keep) -> Vec<Settings> {
    let smoothed = |(pass_band, iterations)| Settings {
        smoothing: Smoothing { pass_band, iterations, ..Smoothing::PAPER },
        ..reduced(0, keep)
    };
    FIGURE_6.into_iter().map(smoothed).collect()
}

/// The settings of Figure 7: smoothed alike, reduced at three rates.
pub fn figure_7(keep: Keep) -> Vec<Settings> {
    FIGURE_7.into_iter().map(|percent| reduced(percent, keep)).collect()
}

/// `settings` at the reduction rates of Figure 7.
pub fn rates_of_figure_7(settings: &Settings) -> Vec<Settings> {
    FIGURE_7
        .into_iter()
        .map(|percent| Settings { target: Target::Reduction(percent * 10), ..settings.clone() })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_settings_are_those_that_the_captions_name() {
        let six = figure_6(Keep::Largest);
        let found: Vec<_> = six.iter().map(|s| (s.smoothing.pass_band, s.smoothing.iterations)).collect();
        assert_eq!(found, FIGURE_6);
        assert!(six.iter().all(|s| s.check().is_ok() && s.target == Target::Reduction(0)));
        let chosen = Smoothing::PAPER;
        assert!(figure_7(Keep::All).iter().all(|s| s.smoothing == chosen && s.keep == Keep::All));
    }
}
