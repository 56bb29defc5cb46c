//! What a user can set: the whole of it, small and serialisable. A result is a function of (file, settings).
//!
//! Each stage's settings are a struct in a file, with their rows in the [`table`] that everything else about settings is made
//! from.

mod decimation;
mod keep;
mod mending;
mod smoothing;
pub mod table;
mod target;

use serde::ser::SerializeStruct as _;
use serde::{Deserialize, Serialize, Serializer};

pub use self::decimation::{Decimation, Method};
pub use self::keep::{Keep, PieceSet};
pub use self::smoothing::{Boundary, Preset, Smoothing, Window};
use self::table::{CommandOption, InLink, Kind, Messages, Range, Setting};
pub use self::target::{Target, reduction_percent};
pub use lumen_mesh::mending::Mending;
use lumen_message::messages;
use lumen_vessel::certificate::TOLERANCE_PERCENT;

/// Settings of all stages, in the order of the method.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// What of the surface is mended; by default nothing.
    #[serde(default)]
    pub mending: Mending,
    /// Which connected pieces go on.
    pub keep: Keep,
    /// The windowed-sinc filter.
    pub smoothing: Smoothing,
    /// How the reduction is made.
    pub decimation: Decimation,
    /// How far it goes.
    pub target: Target,
    /// The change of its calibre in percent that a vessel is allowed, 0 to 100. Surfaces are judged by it; it changes none but
    /// that of [`Target::Auto`].
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

/// What people read says nothing of mending where nothing is mended; a message between threads, whose fields have no names,
/// leaves none out.
impl Serialize for Settings {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { mending, keep, smoothing, decimation, target, tolerance_percent } = self;
        let tells_mending = !to.is_human_readable() || !mending.is_off();
        let mut told = to.serialize_struct("Settings", 5 + usize::from(tells_mending))?;
        if tells_mending {
            told.serialize_field("mending", mending)?;
        }
        told.serialize_field("keep", keep)?;
        told.serialize_field("smoothing", smoothing)?;
        told.serialize_field("decimation", decimation)?;
        told.serialize_field("target", target)?;
        told.serialize_field("tolerance_percent", tolerance_percent)?;
        told.end()
    }
}

fn default_tolerance() -> f64 {
    TOLERANCE_PERCENT
}

/// The row of [`Settings::tolerance_percent`].
static TOLERANCE: [Setting; 1] = [Setting {
    key: "tolerance",
    field: "tolerance_percent",
    kind: Kind::Number {
        at: |settings| &mut settings.tolerance_percent,
        range: Range { bounds: 0.0..=100.0, unit: "%", decimals: 1, logarithmic: false },
    },
    in_link: InLink::Always,
    matters: |_| true,
    option: CommandOption {
        value: "PERCENT",
        help: "The change of calibre that a branch is allowed, in percent, 0 to 100 (2 or 2%) [default: 2]",
    },
    messages: Messages {
        label: "vessels-allowed",
        help: "vessels-allowed-help",
        said: "",
        refused: Some(|value| OutOfRange::Tolerance { value }),
    },
}];

messages! {
    /// A setting that no stage can work with.
    #[derive(Clone, Debug, PartialEq)]
    pub enum SettingsError {
        /// There is no such component.
        "errors-no-component" Component {
            /// The number asked for, from 0.
            wanted: u32,
            /// How many there are.
            count: usize,
        } => "there is no component {wanted}: the surface has {count}",
    } or {
        /// A number is none, or out of its range.
        Range(OutOfRange),
    }
}

messages! {
    /// A number that is none, or out of the range of its setting.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum OutOfRange {
        /// The tolerance of a weld.
        "errors-weld" Weld {
            /// The number.
            value: f64,
        } => "the tolerance of a weld must lie between 0.000001 and 100 mm, not {value} mm",
        /// The size of holes to fill.
        "errors-fill" Fill {
            /// The number.
            value: f64,
        } => "the size of holes to fill must lie between 0.001 and 1000 mm, not {value} mm",
        /// The pass band.
        "errors-pass-band" PassBand {
            /// The number.
            value: f64,
        } => "the pass band must lie between 0.001 and 2, not {value}",
        /// The iterations.
        "errors-iterations" Iterations {
            /// The number.
            value: f64,
        } => "the number of iterations must lie between 0 and 200, not {value}",
        /// The feature angle.
        "errors-feature-angle" FeatureAngle {
            /// The number.
            value: f64,
        } => "the feature angle must lie between 0 and 180 degrees, not {value}",
        /// The reduction rate.
        "errors-reduction" Reduction {
            /// The number.
            value: f64,
        } => "the reduction rate must lie between 0 and 99.9 %, not {value} %",
        /// The bound on the deviation.
        "errors-deviation" Deviation {
            /// The number.
            value: f64,
        } => "the largest deviation must lie between 0.001 and 1000 mm, not {value} mm",
        /// The tolerance.
        "errors-tolerance" Tolerance {
            /// The number.
            value: f64,
        } => "the tolerance must lie between 0 and 100 %, not {value} %",
    }
}

impl Settings {
    /// Whether these make the same level.
    pub fn gives_same(&self, other: &Self) -> bool {
        self.mending == other.mending
            && self.keep == other.keep
            && self.target == other.target
            // By that it is decided what is safe.
            && (self.target != Target::Auto || self.tolerance_percent == other.tolerance_percent)
            && self.smoothing.gives_same(&other.smoothing)
            && self.decimation.gives_same(&other.decimation)
    }

    /// Checks every range; NaN is refused.
    ///
    /// # Errors
    /// The first setting that is out of range.
    pub fn check(&self) -> Result<(), SettingsError> {
        table::all().find_map(|setting| setting.out_of_range(self)).map_or(Ok(()), |out| Err(out.into()))
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
    fn a_target_is_auto_or_a_number_and_never_left_out() {
        let mut told = serde_json::to_value(Settings::default()).unwrap();
        assert_eq!(told["target"], "Auto");
        let target =
            |told: &serde_json::Value| serde_json::from_value::<Settings>(told.clone()).map(|read| read.target);
        assert_eq!(target(&told).unwrap(), Target::Auto);
        told["target"] = serde_json::json!({ "Reduction": 900 });
        assert_eq!(target(&told).unwrap(), Target::Reduction(900));
        told.as_object_mut().unwrap().remove("target");
        assert!(target(&told).unwrap_err().to_string().contains("target"));
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
            assert!(matches!(
                Settings { mending, ..Settings::default() }.check(),
                Err(SettingsError::Range(OutOfRange::Fill { .. }))
            ));
        }
    }

    #[test]
    fn settings_that_are_no_numbers_are_refused() {
        let mut settings = Settings::default();
        assert_eq!(settings.check(), Ok(()));
        settings.smoothing.pass_band = f64::NAN;
        assert!(matches!(settings.check(), Err(SettingsError::Range(OutOfRange::PassBand { .. }))));
        settings = Settings { target: Target::Reduction(1000), ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::Range(OutOfRange::Reduction { .. }))));
        settings = Settings { target: Target::Deviation(0), ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::Range(OutOfRange::Deviation { .. }))));
        settings =
            Settings { decimation: Decimation { feature_angle: -1.0, ..Decimation::default() }, ..Settings::default() };
        assert!(matches!(settings.check(), Err(SettingsError::Range(OutOfRange::FeatureAngle { .. }))));
    }
}
