//! How far the reduction goes, and the ways to say it in the table of settings.

use serde::{Deserialize, Serialize};

use super::OutOfRange;
use super::table::{CommandOption, InLink, Kind, Messages, Range, Setting};

/// How many triangles are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Target {
    /// 90 %, or as far as is safe, whichever is less: how far that is the pipeline finds
    /// ([`Safe::auto`](crate::safe::Safe::auto)).
    #[default]
    Auto,
    /// The part removed of the triangles that enter the stage, in tenths of a percent: 900 is 90 %.
    Reduction(u32),
    /// A number of triangles.
    Triangles(u32),
    /// As few as stay within this distance of the surface that enters the stage, both ways, in thousandths of a mm.
    Deviation(u32),
}

impl Target {
    /// The largest reduction rate that can be asked for: 99.9 %.
    pub const MAX_PER_MILLE: u32 = 999;

    /// The rate of [`Self::Auto`] where nothing is known to stop it, in tenths of a percent: 90 %, the paper's.
    pub const AUTO_PER_MILLE: u32 = 900;

    /// The bounds on the deviation that can be asked for, in thousandths of a mm.
    pub const DEVIATION: std::ops::RangeInclusive<u32> = 1..=1_000_000;

    /// The bound on the deviation in mm, if that is what is asked for.
    pub fn deviation_mm(self) -> Option<f64> {
        match self {
            Self::Deviation(micrometres) => Some(f64::from(micrometres) / 1000.0),
            Self::Auto | Self::Reduction(_) | Self::Triangles(_) => None,
        }
    }

    /// Whether the levels alone do not say which of them it means: the pipeline has to find it.
    pub fn is_searched(self) -> bool {
        matches!(self, Self::Auto | Self::Deviation(_))
    }

    /// The number of triangles wanted of `n`: `n (1000 - r) / 1000` in integers. For [`Self::Auto`] those of 90 %, the fewest
    /// that it can come to; all of them for a bound on the deviation, which says nothing on their number.
    pub fn triangles(self, n: usize) -> usize {
        match self {
            Self::Auto => Self::Reduction(Self::AUTO_PER_MILLE).triangles(n),
            // In u64: five million triangles times a thousand are more than wasm's usize holds.
            Self::Reduction(per_mille) => (n as u64 * u64::from(1000 - per_mille.min(1000)) / 1000) as usize,
            Self::Triangles(count) => n.min(count as usize),
            Self::Deviation(_) => n,
        }
    }

    /// The reduction rate in percent, of `n` triangles.
    pub fn percent(self, n: usize) -> f64 {
        match self {
            Self::Auto => f64::from(Self::AUTO_PER_MILLE) / 10.0,
            Self::Reduction(per_mille) => f64::from(per_mille) / 10.0,
            Self::Triangles(_) | Self::Deviation(_) => reduction_percent(n, self.triangles(n)),
        }
    }
}

/// Equation (7) of the paper: the part of `before` triangles that is gone when `after` are left, in percent.
pub fn reduction_percent(before: usize, after: usize) -> f64 {
    if before == 0 { 0.0 } else { (before - after.min(before)) as f64 / before as f64 * 100.0 }
}

/// The rows of [`Target`]: the ways to say it.
pub(super) static ROWS: [Setting; 3] = [
    Setting {
        key: "reduction",
        field: "target",
        kind: Kind::Target {
            steps: 10,
            get: |target| match target {
                Target::Reduction(per_mille) => Some(per_mille),
                Target::Auto | Target::Triangles(_) | Target::Deviation(_) => None,
            },
            make: Target::Reduction,
            named: Some(("Auto", Target::Auto)),
            range: Range {
                bounds: 0.0..=Target::MAX_PER_MILLE as f64 / 10.0,
                unit: "%",
                decimals: 1,
                logarithmic: false,
            },
        },
        in_link: InLink::Always,
        matters: |_| true,
        option: CommandOption {
            value: "PERCENT",
            help: "The part of the triangles to remove, in percent, 0 to 99.9 (90 or 90%); or safe: as many as leave every \
                   vessel its calibre to --tolerance; or auto: 90 or safe, whichever is less [default: auto]",
        },
        messages: Messages {
            label: "panel-reduction",
            help: "panel-reduction-help",
            said: "",
            refused: Some(|value| OutOfRange::Reduction { value }),
        },
    },
    Setting {
        key: "triangles",
        field: "target",
        kind: Kind::Target {
            steps: 1,
            get: |target| match target {
                Target::Triangles(count) => Some(count),
                Target::Auto | Target::Reduction(_) | Target::Deviation(_) => None,
            },
            make: Target::Triangles,
            named: None,
            range: Range { bounds: 0.0..=u32::MAX as f64, unit: "", decimals: 0, logarithmic: false },
        },
        in_link: InLink::Always,
        matters: |_| true,
        option: CommandOption { value: "N", help: "How many triangles to keep, in place of --reduction" },
        messages: Messages { label: "panel-wanted", help: "panel-wanted-help", said: "", refused: None },
    },
    Setting {
        key: "max-deviation",
        field: "target",
        kind: Kind::Target {
            steps: 1000,
            get: |target| match target {
                Target::Deviation(micrometres) => Some(micrometres),
                Target::Auto | Target::Reduction(_) | Target::Triangles(_) => None,
            },
            make: Target::Deviation,
            named: None,
            range: Range {
                bounds: *Target::DEVIATION.start() as f64 / 1000.0..=*Target::DEVIATION.end() as f64 / 1000.0,
                unit: "mm",
                decimals: 3,
                logarithmic: true,
            },
        },
        in_link: InLink::Always,
        matters: |_| true,
        option: CommandOption {
            value: "MM",
            help: "The farthest that the result may be from the smoothed surface, both ways, in mm, 0.001 to 1000, in place \
                   of --reduction: as few triangles as stay within it",
        },
        messages: Messages {
            label: "panel-bound",
            help: "panel-bound-help",
            said: "",
            refused: Some(|value| OutOfRange::Deviation { value }),
        },
    },
];
