//! What a user can set: the whole of it, small and serialisable. A result is a function of (file, settings).

use serde::{Deserialize, Serialize};

use lumen_language::exact;
use lumen_language::say;
pub use lumen_mesh::mending::Mending;
use lumen_vessel::certificate::TOLERANCE_PERCENT;

/// Settings of all stages, in the order of the method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// What of the surface is mended; by default nothing.
    #[serde(default, skip_serializing_if = "Mending::is_off")]
    pub mending: Mending,
    /// Which connected pieces go on.
    pub keep: Keep,
    /// The windowed-sinc filter.
    pub smoothing: Smoothing,
    /// How the reduction is made.
    pub decimation: Decimation,
    /// How far it goes.
    pub target: Target,
    /// The change of its calibre in percent that a vessel is allowed, 0 to 100. It changes no surface: it is what they are
    /// judged by.
    #[serde(default = "default_tolerance")]
    pub tolerance_percent: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            mending: Mending::default(),
            keep: Keep::default(),
            smoothing: Smoothing::default(),
            decimation: Decimation::default(),
            target: Target::default(),
            tolerance_percent: TOLERANCE_PERCENT,
        }
    }
}

fn default_tolerance() -> f64 {
    TOLERANCE_PERCENT
}

/// Which connected pieces of the surface are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Keep {
    /// The piece with the most triangles.
    #[default]
    Largest,
    /// The piece with this number (pieces are numbered by their first triangle).
    Component(u32),
    /// Every piece.
    All,
}

/// Settings of the windowed-sinc filter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Smoothing {
    /// The window that tapers the Chebyshev coefficients.
    pub window: Window,
    /// Pass band: eigenvalues k of the Laplacian below this pass; `0 < pass_band <= 2`, without unit.
    pub pass_band: f64,
    /// Degree of the polynomial; `0` skips smoothing.
    pub iterations: u32,
    /// What happens at open ends.
    pub boundary: Boundary,
    /// Whether the volume enclosed, open ends capped, is held to 0.01 % of what it was.
    #[serde(default)]
    pub preserve_volume: bool,
    /// Whether each vessel is smoothed by a pass band that leaves it its calibre: nowhere less than [`Self::pass_band`].
    #[serde(default)]
    pub adapt: bool,
    /// Whether the filter is weakened where it would make triangles cross that did not.
    #[serde(default)]
    pub guard: bool,
}

impl Smoothing {
    /// The range of the pass band.
    pub const PASS_BAND: std::ops::RangeInclusive<f64> = 0.001..=2.0;
    /// The largest number of iterations.
    pub const MAX_ITERATIONS: u32 = 200;

    /// The setting that the paper chose: Hamming window, pass band 0.01, 100 iterations, the same everywhere.
    pub const PAPER: Self = Self {
        window: Window::Hamming,
        pass_band: 0.01,
        iterations: 100,
        boundary: Boundary::Loop,
        preserve_volume: false,
        adapt: false,
        guard: false,
    };

    /// What suits a surface whatever its calibres: as [`Self::PAPER`] where vessels are wide, and nowhere so much that a
    /// vessel loses its calibre or triangles cross.
    pub const AUTO: Self = Self { adapt: true, guard: true, ..Self::PAPER };

    /// No smoothing.
    pub const NONE: Self = Self { iterations: 0, ..Self::AUTO };
}

impl Default for Smoothing {
    /// [`Self::AUTO`].
    fn default() -> Self {
        Self::AUTO
    }
}

impl Smoothing {
    /// Whether these make the same surface: without iterations, the rest does not matter.
    pub fn gives_same(&self, other: &Self) -> bool {
        self == other || (self.iterations == 0 && other.iterations == 0)
    }
}

/// Settings of the filter that have a name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// [`Smoothing::AUTO`].
    #[default]
    Auto,
    /// [`Smoothing::PAPER`].
    Paper,
    /// [`Smoothing::NONE`].
    None,
}

impl Preset {
    /// All, the default first.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Paper, Self::None];

    /// The preset's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Paper => "paper",
            Self::None => "none",
        }
    }

    /// What it is called where a user chooses, in the language that is spoken.
    pub fn label(self) -> String {
        match self {
            Self::Auto => say!("panel-preset-auto"),
            Self::Paper => say!("panel-preset-paper"),
            Self::None => say!("panel-preset-none"),
        }
    }

    /// The settings.
    pub fn smoothing(self) -> Smoothing {
        match self {
            Self::Auto => Smoothing::AUTO,
            Self::Paper => Smoothing::PAPER,
            Self::None => Smoothing::NONE,
        }
    }

    /// The one that makes the same surface as `smoothing`, if one does.
    pub fn of(smoothing: &Smoothing) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.smoothing().gives_same(smoothing))
    }
}

/// The window of the windowed-sinc filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Window {
    /// 0.54 + 0.46 cos t: the paper's.
    #[default]
    Hamming,
    /// 0.5 + 0.5 cos t.
    Hanning,
    /// 0.42 + 0.5 cos t + 0.08 cos 2t.
    Blackman,
    /// Four terms, the lowest side lobes.
    Nuttall,
}

impl Window {
    /// All windows, the default first.
    pub const ALL: [Self; 4] = [Self::Hamming, Self::Hanning, Self::Blackman, Self::Nuttall];

    /// The window's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hamming => "Hamming",
            Self::Hanning => "Hanning",
            Self::Blackman => "Blackman",
            Self::Nuttall => "Nuttall",
        }
    }
}

/// What the filter does at the boundary of an open surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Boundary {
    /// A boundary vertex is smoothed along its loop: its neighbours are the two on the boundary.
    #[default]
    Loop,
    /// VTK's rule, for comparison: as `Loop`, but a vertex where the boundary turns by more than 15 degrees stays.
    Vtk15,
}

/// How a surface is reduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// The paper's: vertices are deleted, none moves.
    #[default]
    Schroeder,
    /// Least error: edges become vertices where they fit best.
    Quadric,
}

impl Method {
    /// Both methods, the default first.
    pub const ALL: [Self; 2] = [Self::Schroeder, Self::Quadric];

    /// The method's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Schroeder => "Schroeder",
            Self::Quadric => "Quadric",
        }
    }
}

/// Settings of the decimation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Decimation {
    /// The method.
    #[serde(default)]
    pub method: Method,
    /// An edge whose two triangles' normals differ by more than this is a feature edge, for [`Method::Schroeder`];
    /// degrees, 0 to 180.
    pub feature_angle: f64,
    /// Whether thin vessels are spared: the error that says which vertex goes next counts the more, the thinner its
    /// vessel is.
    #[serde(default)]
    pub spare_thin: bool,
    /// Whether borders between labels are held as feature edges.
    #[serde(default)]
    pub keep_labels: bool,
}

impl Default for Decimation {
    /// 60 degrees: above the 35 to 55 degrees of a marching-cubes stair-step, which is no feature of a vessel.
    fn default() -> Self {
        Self { method: Method::default(), feature_angle: 60.0, spare_thin: false, keep_labels: false }
    }
}

impl Decimation {
    /// Whether these make the same levels: [`Method::Quadric`] knows no feature edges.
    pub fn gives_same(&self, other: &Self) -> bool {
        let angle = |of: &Self| (of.method == Method::Schroeder).then_some(of.feature_angle);
        let all = |of: &Self| (of.method, of.spare_thin, of.keep_labels, angle(of));
        all(self) == all(other)
    }
}

/// How many triangles are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Target {
    /// The part removed of the triangles that enter the stage, in tenths of a percent: 900 is 90 %.
    Reduction(u32),
    /// A number of triangles.
    Triangles(u32),
    /// As few as stay within this distance of the surface that enters the stage, both ways, in thousandths of a mm.
    Deviation(u32),
}

impl Default for Target {
    fn default() -> Self {
        Self::Reduction(900)
    }
}

impl Target {
    /// The largest reduction rate that can be asked for: 99.9 %.
    pub const MAX_PER_MILLE: u32 = 999;

    /// The bounds on the deviation that can be asked for, in thousandths of a mm.
    pub const DEVIATION: std::ops::RangeInclusive<u32> = 1..=1_000_000;

    /// The bound on the deviation in mm, if that is what is asked for.
    pub fn deviation_mm(self) -> Option<f64> {
        match self {
            Self::Deviation(micrometres) => Some(f64::from(micrometres) / 1000.0),
            Self::Reduction(_) | Self::Triangles(_) => None,
        }
    }

    /// The number of triangles wanted of `n`: `n (1000 - r) / 1000` in integers. All of them for a bound on the
    /// deviation, which says nothing on their number.
    pub fn triangles(self, n: usize) -> usize {
        match self {
            // In u64: five million triangles times a thousand are more than wasm's usize holds.
            Self::Reduction(per_mille) => (n as u64 * u64::from(1000 - per_mille.min(1000)) / 1000) as usize,
            Self::Triangles(count) => n.min(count as usize),
            Self::Deviation(_) => n,
        }
    }

    /// The reduction rate in percent, of `n` triangles.
    pub fn percent(self, n: usize) -> f64 {
        match self {
            Self::Reduction(per_mille) => f64::from(per_mille) / 10.0,
            Self::Triangles(_) | Self::Deviation(_) => reduction_percent(n, self.triangles(n)),
        }
    }
}

/// Equation (7) of the paper: the part of `before` triangles that is gone when `after` are left, in percent.
pub fn reduction_percent(before: usize, after: usize) -> f64 {
    if before == 0 { 0.0 } else { (before - after.min(before)) as f64 / before as f64 * 100.0 }
}

/// A setting that no stage can work with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// The pass band is not a number in `(0, 2]`.
    #[error("{}", say!("errors-pass-band", value = exact(*.0)))]
    PassBand(f64),
    /// Too many iterations.
    #[error("{}", say!("errors-iterations", value = .0.to_string()))]
    Iterations(u32),
    /// The feature angle is not a number in `[0, 180]`.
    #[error("{}", say!("errors-feature-angle", value = exact(*.0)))]
    FeatureAngle(f64),
    /// The tolerance is not a number in `[0, 100]`.
    #[error("{}", say!("errors-tolerance", value = exact(*.0)))]
    Tolerance(f64),
    /// The reduction rate is above 99.9 %.
    #[error("{}", say!("errors-reduction", value = exact(*.0)))]
    Reduction(f64),
    /// The bound on the deviation is too small or too large.
    #[error("{}", say!("errors-deviation", value = exact(*.0)))]
    Deviation(f64),
    /// The tolerance of a weld is too small or too large.
    #[error("{}", say!("errors-weld", value = exact(*.0)))]
    Weld(f64),
    /// The size of holes to fill is too small or too large.
    #[error("{}", say!("errors-fill", value = exact(*.0)))]
    Fill(f64),
    /// There is no such component.
    #[error("{}", say!("errors-no-component", wanted = .wanted.to_string(), number = .count.to_string()))]
    Component {
        /// The number asked for, from 0.
        wanted: u32,
        /// How many there are.
        count: usize,
    },
}

impl Settings {
    /// Whether these make the same level.
    pub fn gives_same(&self, other: &Self) -> bool {
        self.mending == other.mending
            && self.keep == other.keep
            && self.target == other.target
            && self.smoothing.gives_same(&other.smoothing)
            && self.decimation.gives_same(&other.decimation)
    }

    /// Checks every range; NaN is refused.
    ///
    /// # Errors
    /// The first setting that is out of range.
    pub fn check(&self) -> Result<(), SettingsError> {
        if let Some(tolerance) = self.mending.weld_mm.filter(|mm| !Mending::WELD_MM.contains(mm)) {
            return Err(SettingsError::Weld(tolerance));
        }
        if let Some(size) = self.mending.fill_mm.filter(|mm| !Mending::FILL_MM.contains(mm)) {
            return Err(SettingsError::Fill(size));
        }
        if !Smoothing::PASS_BAND.contains(&self.smoothing.pass_band) {
            return Err(SettingsError::PassBand(self.smoothing.pass_band));
        }
        if self.smoothing.iterations > Smoothing::MAX_ITERATIONS {
            return Err(SettingsError::Iterations(self.smoothing.iterations));
        }
        if !(0.0..=180.0).contains(&self.decimation.feature_angle) {
            return Err(SettingsError::FeatureAngle(self.decimation.feature_angle));
        }
        if !(0.0..=100.0).contains(&self.tolerance_percent) {
            return Err(SettingsError::Tolerance(self.tolerance_percent));
        }
        match self.target {
            Target::Reduction(r) if r > Target::MAX_PER_MILLE => Err(SettingsError::Reduction(f64::from(r) / 10.0)),
            Target::Deviation(bound) if !Target::DEVIATION.contains(&bound) => {
                Err(SettingsError::Deviation(f64::from(bound) / 1000.0))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_two_of_the_paper() {
        // The paper prints 37,153 for 50 %: 74,307 / 2 = 37,153.5.
        let rates = [(100, 66_875), (500, 37_153), (750, 18_576), (900, 7_430), (990, 743)];
        for (rate, printed) in rates {
            let target = Target::Reduction(rate).triangles(74_307);
            assert!(target.abs_diff(printed) <= 1, "{rate}: {target} beside the paper's {printed}");
        }
    }

    #[test]
    fn settings_from_before_a_field_was_there_say_what_they_said() {
        let mut told = serde_json::to_value(Settings::default()).unwrap();
        told["decimation"].as_object_mut().unwrap().remove("spare_thin");
        let read: Settings = serde_json::from_value(told).unwrap();
        assert!(!read.decimation.spare_thin);
        let spared = Decimation { spare_thin: true, method: Method::Quadric, ..Decimation::default() };
        assert!(!spared.gives_same(&Decimation { spare_thin: false, ..spared }));
        assert!(spared.gives_same(&Decimation { feature_angle: 10.0, ..spared }));
    }

    #[test]
    fn mending_is_told_only_where_something_is_mended() {
        let plain = serde_json::to_value(Settings::default()).unwrap();
        assert!(plain.get("mending").is_none());
        let mending = Mending { fill_mm: Some(2.0), split: true, ..Mending::default() };
        let settings = Settings { mending, ..Settings::default() };
        let told = serde_json::to_value(&settings).unwrap();
        assert_eq!(serde_json::from_value::<Settings>(told).unwrap(), settings);
        for fill_mm in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mending = Mending { fill_mm: Some(fill_mm), ..mending };
            assert!(matches!(Settings { mending, ..Settings::default() }.check(), Err(SettingsError::Fill(_))));
        }
    }

    #[test]
    fn settings_that_are_no_numbers_are_refused() {
        let mut settings = Settings::default();
        assert_eq!(settings.check(), Ok(()));
        settings.smoothing.pass_band = f64::NAN;
        assert!(matches!(settings.check(), Err(SettingsError::PassBand(_))));
        settings = Settings { target: Target::Reduction(1000), ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::Reduction(_))));
        settings = Settings { target: Target::Deviation(0), ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::Deviation(_))));
        settings =
            Settings { decimation: Decimation { feature_angle: -1.0, ..Decimation::default() }, ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::FeatureAngle(_))));
    }
}
