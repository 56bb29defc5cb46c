//! The settings as options: a settings file if one is named, and what is said beside it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::misuse::misuse;
use super::options::{Given, Reduction};
use super::source::{UNIT_HELP, UnitOption};
use crate::pipeline::settings::{Keep, Preset};
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
    #[command(flatten)]
    given: Given,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
    /// Keep every connected piece, not only the largest
    #[arg(long, conflicts_with = "keep")]
    keep_all_components: bool,
}

/// What the options come to.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    /// The settings and the unit; none where it is to be found by the size.
    pub(super) shared: SharedSettings,
    /// The unit as it was asked for.
    pub(super) unit: Option<UnitOption>,
    /// Whether the rate is to be the highest at which every vessel keeps its calibre; the target is auto until it is known.
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
        let SharedSettings { unit, mut settings } = begun;
        if let Some(preset) = self.smoothing {
            settings.smoothing = preset.smoothing();
        }
        if self.keep_all_components {
            settings.keep = Keep::All;
        }
        self.given.put(&mut settings);
        settings.check().map_err(misuse)?;
        if let Some(Reduction::Percent(percent)) = self.given.reduction
            && 0.0 < percent
            && percent < 1.0
        {
            eprintln!(
                "lumen: warning: --reduction {percent} removes less than one percent; nine tenths are --reduction 90"
            );
        }
        let unit = self.unit.or(unit.map(UnitOption::Given));
        let shared = SharedSettings { unit: unit.and_then(UnitOption::given), settings };
        Ok(Asked { shared, unit, wants_safe: self.given.reduction == Some(Reduction::Safe) })
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
