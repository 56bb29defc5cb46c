//! The settings as options: a settings file if one is named, and what is said beside it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::misuse::misuse;
use super::source::UnitOption;
use crate::pipeline::settings::{Decimation, Keep, Mending, Method, Preset, Settings, Smoothing, Target, Window};
use crate::pipeline::verdict::rate;
use crate::sharing::{self, SharedSettings};

/// What is made of a surface. An option that is given counts for more than the settings file.
#[derive(Debug, Args)]
pub(super) struct SettingsOptions {
    /// Begin with the settings of this file, written by --save-settings or in the window
    #[arg(long, value_name = "FILE.json")]
    settings: Option<PathBuf>,
    /// How to smooth: auto leaves every vessel its calibre and makes no triangles cross; paper is 0.01 and 100 iterations
    /// everywhere [default: auto]
    #[arg(long, value_name = "NAME", value_parser = one_of(&Preset::ALL, Preset::name), ignore_case = true)]
    smoothing: Option<Preset>,
    /// Pass band of the smoothing filter, 0.001 to 2; with auto that of wide vessels [auto and paper: 0.01]
    #[arg(long, value_name = "F")]
    pass_band: Option<f64>,
    /// Iterations of the smoothing filter, 0 to 200; 0 skips smoothing [auto and paper: 100]
    #[arg(long, value_name = "N")]
    iterations: Option<u32>,
    /// Window of the smoothing filter [hamming]
    #[arg(long, value_name = "NAME", value_parser = one_of(&Window::ALL, Window::name), ignore_case = true)]
    window: Option<Window>,
    /// Hold the volume to 0.01 % of what it is before smoothing, open ends capped
    #[arg(long)]
    preserve_volume: bool,
    /// Smooth all vessels by the same pass band, though thin ones lose their calibre
    #[arg(long)]
    no_adapt: bool,
    /// Let smoothing make triangles cross
    #[arg(long)]
    no_guard: bool,
    /// The part of the triangles to remove, in percent, 0 to 99.9 (90 or 90%); or safe: as many as leave every vessel its
    /// calibre to --tolerance [default: 90]
    #[arg(long, value_name = "PERCENT", value_parser = reduction, conflicts_with = "triangles")]
    reduction: Option<Reduction>,
    /// How many triangles to keep, in place of --reduction
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    triangles: Option<u32>,
    /// The farthest that the result may be from the smoothed surface, both ways, in mm, 0.001 to 1000, in place of
    /// --reduction: as few triangles as stay within it
    #[arg(long, value_name = "MM", value_parser = micrometres, conflicts_with_all = ["reduction", "triangles"])]
    max_deviation: Option<u32>,
    /// How to reduce [default: schroeder]
    #[arg(long, value_name = "NAME", value_parser = one_of(&Method::ALL, Method::name), ignore_case = true)]
    method: Option<Method>,
    /// Edges sharper than this are kept as edges, degrees, 0 to 180; for schroeder [default: 60]
    #[arg(long, value_name = "DEG")]
    feature_angle: Option<f64>,
    /// Spare thin vessels: an error counts the more, the thinner the vessel is
    #[arg(long)]
    spare_thin: bool,
    /// Hold the borders between labels of the file's arrays as feature edges
    #[arg(long)]
    keep_labels: bool,
    /// The unit of the numbers in the file: mm, cm or m; auto takes the one in which the size would be that of vessels,
    /// where it is not and only one would do
    #[arg(long, value_name = "UNIT")]
    unit: Option<UnitOption>,
    #[command(flatten)]
    mending: MendingOptions,
    /// Keep every connected piece, not only the largest
    #[arg(long)]
    keep_all_components: bool,
    /// The change of calibre that a branch is allowed, in percent, 0 to 100 (2 or 2%) [default: 2]
    #[arg(long, value_name = "PERCENT", value_parser = tolerance)]
    tolerance: Option<f64>,
}

/// What of a surface is mended before anything else.
#[derive(Clone, Debug, Args)]
pub(super) struct MendingOptions {
    /// Join open edges that are this near, in mm, 0.000001 to 100; nothing collapses
    #[arg(long, value_name = "MM")]
    weld: Option<f64>,
    /// Part the sheets that share an edge or a vertex
    #[arg(long)]
    split: bool,
    /// Fill holes in walls up to this distance across, in mm, 0.001 to 1000; ends of vessels stay open
    #[arg(long, value_name = "MM")]
    fill_holes: Option<f64>,
    /// Take the lumen where the surface is a wall with two sides
    #[arg(long)]
    lumen: bool,
}

impl MendingOptions {
    /// What is asked for, or else what `begun` has.
    pub(super) fn asked(&self, begun: Mending) -> Mending {
        Mending {
            weld_mm: self.weld.or(begun.weld_mm),
            split: self.split || begun.split,
            fill_mm: self.fill_holes.or(begun.fill_mm),
            lumen: self.lumen || begun.lumen,
        }
    }
}

/// What the options come to.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    /// The settings and the unit; none where it is to be found by the size.
    pub(super) shared: SharedSettings,
    /// The unit as it was asked for.
    pub(super) unit: Option<UnitOption>,
    /// Whether the rate is to be the highest at which every vessel keeps its calibre; the target is the default until it
    /// is known.
    pub(super) wants_safe: bool,
}

impl SettingsOptions {
    /// The settings file that is begun with.
    pub(super) fn file(&self) -> Option<&Path> {
        self.settings.as_deref()
    }

    /// The settings file, with what else was asked for.
    pub(super) fn asked(&self) -> Result<Asked> {
        let begun = self.settings.as_deref().map(read).transpose()?.unwrap_or_default();
        let SharedSettings { unit, settings: begun } = begun;
        let wants_safe = self.reduction == Some(Reduction::Safe);
        let target = match (self.triangles, self.max_deviation, self.reduction) {
            (Some(count), ..) => Target::Triangles(count),
            (None, Some(bound), _) => Target::Deviation(bound),
            (None, None, Some(Reduction::Percent(percent))) => rate(percent),
            (None, None, Some(Reduction::Safe)) => Target::default(),
            (None, None, None) => begun.target,
        };
        let settings = Settings {
            mending: self.mending.asked(begun.mending),
            keep: if self.keep_all_components { Keep::All } else { begun.keep },
            smoothing: self.smoothing(begun.smoothing),
            decimation: Decimation {
                method: self.method.unwrap_or(begun.decimation.method),
                feature_angle: self.feature_angle.unwrap_or(begun.decimation.feature_angle),
                spare_thin: self.spare_thin || begun.decimation.spare_thin,
                keep_labels: self.keep_labels || begun.decimation.keep_labels,
            },
            target,
            tolerance_percent: self.tolerance.unwrap_or(begun.tolerance_percent),
        };
        settings.check().map_err(misuse)?;
        if let Some(Reduction::Percent(percent)) = self.reduction
            && 0.0 < percent
            && percent < 1.0
        {
            eprintln!(
                "lumen: warning: --reduction {percent} removes less than one percent; nine tenths are --reduction 90"
            );
        }
        let unit = self.unit.or(unit.map(UnitOption::Given));
        let shared = SharedSettings { unit: unit.and_then(UnitOption::given), settings };
        Ok(Asked { shared, unit, wants_safe })
    }

    /// The preset, or else `begun`, with what else was asked for.
    fn smoothing(&self, begun: Smoothing) -> Smoothing {
        let begun = self.smoothing.map_or(begun, Preset::smoothing);
        Smoothing {
            window: self.window.unwrap_or(begun.window),
            pass_band: self.pass_band.unwrap_or(begun.pass_band),
            iterations: self.iterations.unwrap_or(begun.iterations),
            boundary: begun.boundary,
            preserve_volume: self.preserve_volume || begun.preserve_volume,
            adapt: begun.adapt && !self.no_adapt,
            guard: begun.guard && !self.no_guard,
        }
    }
}

fn read(path: &Path) -> Result<SharedSettings> {
    let name = || path.display().to_string();
    let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", name()))?;
    sharing::read_settings(&bytes).with_context(name)
}

/// Parses one of `all` by its name.
fn one_of<T: Copy + Send + Sync>(all: &'static [T], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T> {
    let word = move |value: &T| name(*value).to_lowercase();
    PossibleValuesParser::new(all.iter().map(word)).map(move |given| {
        let found = all.iter().find(|value| word(value).eq_ignore_ascii_case(&given));
        *found.expect("clap lets no other value through")
    })
}

/// How far to reduce.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reduction {
    Percent(f64),
    /// As far as every vessel keeps its calibre.
    Safe,
}

fn reduction(text: &str) -> Result<Reduction, String> {
    if text.trim().eq_ignore_ascii_case("safe") { Ok(Reduction::Safe) } else { percent(text).map(Reduction::Percent) }
}

/// A reduction rate in percent.
pub(super) fn percent(text: &str) -> Result<f64, String> {
    percentage(text, f64::from(Target::MAX_PER_MILLE) / 10.0)
}

/// A tolerance in percent.
fn tolerance(text: &str) -> Result<f64, String> {
    percentage(text, 100.0)
}

/// A percentage up to `most`, with or without the sign.
fn percentage(text: &str, most: f64) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end();
    let value: f64 = number.parse().map_err(|_| format!("{text} is not a percentage"))?;
    if (0.0..=most).contains(&value) { Ok(value) } else { Err(format!("{text} is not between 0 and {most} %")) }
}

/// A length in mm as thousandths, rounded down: what is within them is within the length.
fn micrometres(text: &str) -> Result<u32, String> {
    let number = text.trim().trim_end_matches("mm").trim_end();
    let value: f64 = number.parse().map_err(|_| format!("{text} is not a length in mm"))?;
    // The nearest binary fraction of 0.29 is a little less than 0.29.
    let thousandths = (value * 1000.0 + 1e-6).floor();
    let range = f64::from(*Target::DEVIATION.start())..=f64::from(*Target::DEVIATION.end());
    if range.contains(&thousandths) {
        Ok(thousandths as u32)
    } else {
        Err(format!("{text} is not between 0.001 and 1000 mm"))
    }
}

#[cfg(test)]
mod tests {
    use super::{micrometres, percent};

    #[test]
    fn a_length_becomes_as_many_thousandths_as_it_holds() {
        let lengths = ["0.1", "0.29", "1.0009", "0.001", "1000", "0.25 mm"];
        assert_eq!(lengths.map(micrometres), [100, 290, 1000, 1, 1_000_000, 250].map(Ok));
        assert!(["0", "-1", "nan", "inf", "0.0009", "1001", "", "mm"].iter().all(|text| micrometres(text).is_err()));
    }

    #[test]
    fn a_percentage_is_what_is_removed_with_or_without_its_sign() {
        assert_eq!(percent("90"), Ok(90.0));
        assert_eq!(percent("90%"), Ok(90.0));
        assert_eq!(percent(" 99.9 % "), Ok(99.9));
        assert!(["100", "-1", "nan", "", "%", "ninety"].iter().all(|text| percent(text).is_err()));
    }
}
