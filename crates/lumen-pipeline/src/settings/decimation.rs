//! Settings of the reduction, and their rows in the table of settings.

use serde::{Deserialize, Serialize};

use super::OutOfRange;
use super::table::{CommandOption, InLink, Kind, Messages, Range, Setting};

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

    /// Their names.
    const NAMES: [&'static str; 2] = ["Schroeder", "Quadric"];

    /// The method's name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
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
        let used = |of: &Self| match of.method {
            Method::Schroeder => *of,
            Method::Quadric => Self { feature_angle: 0.0, ..*of },
        };
        used(self) == used(other)
    }
}

/// The rows of [`Decimation`].
pub(super) static ROWS: [Setting; 4] = [
    Setting {
        key: "method",
        field: "decimation.method",
        kind: Kind::Choice {
            names: &Method::NAMES,
            index: |settings| settings.decimation.method as usize,
            choose: |settings, i| settings.decimation.method = Method::ALL[i],
        },
        in_link: InLink::Always,
        matters: |_| true,
        option: CommandOption { value: "NAME", help: "How to reduce [default: schroeder]" },
        messages: Messages { label: "panel-method", help: "panel-method-help", said: "compare-method", refused: None },
    },
    Setting {
        key: "feature-angle",
        field: "decimation.feature_angle",
        kind: Kind::Number {
            at: |settings| &mut settings.decimation.feature_angle,
            range: Range { bounds: 0.0..=180.0, unit: "°", decimals: 0, logarithmic: false },
        },
        in_link: InLink::Always,
        matters: |settings| settings.decimation.method == Method::Schroeder,
        option: CommandOption {
            value: "DEG",
            help: "Edges sharper than this are kept as edges, degrees, 0 to 180; for schroeder [default: 60]",
        },
        messages: Messages {
            label: "panel-feature-angle",
            help: "panel-feature-angle-help",
            said: "compare-feature-angle",
            refused: Some(|value| OutOfRange::FeatureAngle { value }),
        },
    },
    Setting {
        key: "spare-thin",
        field: "decimation.spare_thin",
        kind: Kind::Switch { at: |settings| &mut settings.decimation.spare_thin },
        in_link: InLink::Always,
        matters: |_| true,
        option: CommandOption {
            value: "",
            help: "Spare thin vessels: an error counts the more, the thinner the vessel is",
        },
        messages: Messages {
            label: "panel-spare-thin",
            help: "panel-spare-thin-help",
            said: "compare-thin-spared",
            refused: None,
        },
    },
    Setting {
        key: "keep-labels",
        field: "decimation.keep_labels",
        kind: Kind::Switch { at: |settings| &mut settings.decimation.keep_labels },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption {
            value: "",
            help: "Hold the borders between labels of the file's arrays as feature edges",
        },
        messages: Messages {
            label: "panel-keep-labels",
            help: "panel-keep-labels-help",
            said: "compare-labels-kept",
            refused: None,
        },
    },
];
