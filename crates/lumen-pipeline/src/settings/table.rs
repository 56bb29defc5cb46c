//! The table of settings: one row for each, with its name, its range, its unit and where it stands in [`Settings`].
//!
//! The command line's options, links, lessons, the panel's controls, comparisons, reports and the check of ranges are made
//! from it. The settings file is not: it is [`Settings`] itself as JSON. Each row stands beside the struct that it is of, in
//! the order of the method; a test compares the rows with the fields of the structs.
//!
//! One more setting is a field and a row in one file of this folder, its messages in `locales/`, and the stage that uses it.

use std::fmt;
use std::ops::RangeInclusive;

use super::{Keep, OutOfRange, Settings, Target};
use super::{TOLERANCE, decimation, keep, mending, smoothing, target};

/// The rows, a group each, in the order of the method.
static GROUPS: [&[Setting]; 6] =
    [&mending::ROWS, &keep::ROWS, &smoothing::ROWS, &decimation::ROWS, &target::ROWS, &TOLERANCE];

/// All settings, in the order of the method.
pub fn all() -> impl Iterator<Item = &'static Setting> {
    GROUPS.into_iter().flatten()
}

/// The settings of a stage, whose fields begin with `stage`: `smoothing`.
pub fn of(stage: &str) -> impl Iterator<Item = &'static Setting> {
    all().filter(move |setting| setting.field.split('.').next() == Some(stage))
}

/// The setting of this name.
pub fn find(key: &str) -> Option<&'static Setting> {
    all().find(|setting| setting.key == key)
}

/// Where a value of type `T` stands in the settings.
pub type At<T> = fn(&mut Settings) -> &mut T;

/// A setting: a row of the table.
pub struct Setting {
    /// Its name in links and lessons, and with `--` before it on the command line: `pass-band`.
    pub key: &'static str,
    /// Its place in the settings file: `smoothing.pass_band`.
    pub field: &'static str,
    /// What values it has, and where they stand.
    pub kind: Kind,
    /// When a link names it.
    pub in_link: InLink,
    /// Whether it changes the result, given the others.
    pub matters: fn(&Settings) -> bool,
    /// Its option on the command line.
    pub option: CommandOption,
    /// Its messages in `locales/`.
    pub messages: Messages,
}

/// The values of a setting.
pub enum Kind {
    /// On or off.
    Switch {
        /// Where it stands.
        at: At<bool>,
    },
    /// A number.
    Number {
        /// Where it stands.
        at: At<f64>,
        /// What it can be.
        range: Range,
    },
    /// A whole number.
    Count {
        /// Where it stands.
        at: At<u32>,
        /// What it can be.
        range: Range,
    },
    /// A number, or none: then nothing is done.
    Limit {
        /// Where it stands.
        at: At<Option<f64>>,
        /// What it can be.
        range: Range,
        /// The number to begin with where a user turns it on.
        proposed: f64,
    },
    /// One of several.
    Choice {
        /// Their names, the default first. Links and the command line have them in lower case.
        names: &'static [&'static str],
        /// The place in `names` of the one that is set.
        index: fn(&Settings) -> usize,
        /// Sets the one at a place in `names`.
        choose: fn(&mut Settings, usize),
    },
    /// Connected pieces: `largest`, `all`, or the numbers of some.
    Pieces {
        /// Where it stands.
        at: At<Keep>,
    },
    /// One way to say how far the reduction goes. The ways exclude each other.
    Target {
        /// Steps in one of the unit.
        steps: u32,
        /// The steps, where the target is said in this way.
        get: fn(Target) -> Option<u32>,
        /// The target of so many steps.
        make: fn(u32) -> Target,
        /// The one that has a name in place of a number, and that name.
        named: Option<(&'static str, Target)>,
        /// What it can be, in the unit.
        range: Range,
    },
}

/// What a number can be, and how it is shown.
pub struct Range {
    /// The least and the most.
    pub bounds: RangeInclusive<f64>,
    /// Its unit: `mm`, `%`, `°`; empty where it has none.
    pub unit: &'static str,
    /// Digits after the point that a control shows.
    pub decimals: usize,
    /// Whether a slider is logarithmic.
    pub logarithmic: bool,
}

/// When a link names a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InLink {
    /// Always: a link without it is refused.
    Always,
    /// Where it is not the default. A setting that is newer than the first links has to be so: without it they are read.
    Changed,
}

/// The option of a setting on the command line.
pub struct CommandOption {
    /// What stands for its value in the help; empty for a switch.
    pub value: &'static str,
    /// What it does, in English. That of a switch is of the direction that is not the default.
    pub help: &'static str,
}

/// The messages of a setting, in `locales/` by their names. An empty one is not there.
#[derive(Clone, Copy, Debug)]
pub struct Messages {
    /// What it is called.
    pub label: &'static str,
    /// What it does.
    pub help: &'static str,
    /// What a list of settings says of it, with `$value`; of a switch, where it is on.
    pub said: &'static str,
    /// That a number is out of its range.
    pub refused: Option<fn(f64) -> OutOfRange>,
}

/// A value of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Of a switch.
    Switch(bool),
    /// Of a number, with its unit.
    Number(f64),
    /// The name of what is chosen.
    Name(&'static str),
    /// Connected pieces.
    Pieces(Keep),
}

impl fmt::Display for Value {
    /// As links have it: a number with the fewest digits that read back as the same number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Switch(is_on) => f.write_str(if *is_on { "yes" } else { "no" }),
            Self::Number(number) => number.fmt(f),
            Self::Name(name) => f.write_str(&name.to_lowercase()),
            Self::Pieces(keep) => keep.fmt(f),
        }
    }
}

/// A text that is no value of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoValue;

impl Setting {
    /// Its value; `None` where there is none: of a limit that is off, of another way to say the target.
    pub fn value(&self, settings: &Settings) -> Option<Value> {
        // Where a value stands can be had for writing only; settings are small.
        let settings = &mut settings.clone();
        Some(match self.kind {
            Kind::Switch { at } => Value::Switch(*at(settings)),
            Kind::Number { at, .. } => Value::Number(*at(settings)),
            Kind::Count { at, .. } => Value::Number(f64::from(*at(settings))),
            Kind::Limit { at, .. } => Value::Number((*at(settings))?),
            Kind::Choice { names, index, .. } => Value::Name(names[index(settings)]),
            Kind::Pieces { at } => Value::Pieces(*at(settings)),
            Kind::Target { named: Some((name, target)), .. } if target == settings.target => Value::Name(name),
            Kind::Target { steps, get, .. } => Value::Number(f64::from(get(settings.target)?) / f64::from(steps)),
        })
    }

    /// Its value in the default settings.
    pub fn default(&self) -> Option<Value> {
        self.value(&Settings::default())
    }

    /// Sets what a text says, written as a link writes it. A number may be out of range: [`Settings::check`] finds that.
    ///
    /// # Errors
    /// When it says no value, or one between two steps.
    pub fn read(&self, settings: &mut Settings, text: &str) -> Result<(), NoValue> {
        match self.kind {
            Kind::Switch { at } => {
                *at(settings) = match text {
                    "yes" => true,
                    "no" => false,
                    _ => return Err(NoValue),
                }
            }
            Kind::Number { at, .. } => *at(settings) = text.parse().map_err(|_| NoValue)?,
            Kind::Count { at, .. } => *at(settings) = text.parse().map_err(|_| NoValue)?,
            Kind::Limit { at, .. } => *at(settings) = Some(text.parse().map_err(|_| NoValue)?),
            Kind::Choice { names, choose, .. } => {
                let place = names.iter().position(|name| name.to_lowercase() == text);
                choose(settings, place.ok_or(NoValue)?);
            }
            Kind::Pieces { at } => *at(settings) = text.parse()?,
            Kind::Target { steps, make, named, .. } => {
                let named = named.filter(|(name, _)| name.to_lowercase() == text);
                settings.target = match named {
                    Some((_, target)) => target,
                    None => make(in_steps(text, steps)?),
                };
            }
        }
        Ok(())
    }

    /// What a number can be; `None` of what is none.
    pub fn range(&self) -> Option<&Range> {
        match &self.kind {
            Kind::Number { range, .. }
            | Kind::Count { range, .. }
            | Kind::Limit { range, .. }
            | Kind::Target { range, .. } => Some(range),
            Kind::Switch { .. } | Kind::Choice { .. } | Kind::Pieces { .. } => None,
        }
    }

    /// That its number is out of range, where it is.
    pub(super) fn out_of_range(&self, settings: &Settings) -> Option<OutOfRange> {
        let Value::Number(number) = self.value(settings)? else { return None };
        let refused =
            self.messages.refused.filter(|_| !self.range().is_some_and(|range| range.bounds.contains(&number)));
        refused.map(|refused| refused(number))
    }
}

impl fmt::Debug for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Setting").field(&self.key).finish()
    }
}

/// A number as a count of steps, of which there are so many in one; a number between two is refused. What is none (NaN,
/// negative, huge) becomes one that [`Settings::check`] refuses.
fn in_steps(text: &str, in_one: u32) -> Result<u32, NoValue> {
    if in_one == 1 {
        return text.parse().map_err(|_| NoValue);
    }
    let number = text.parse::<f64>().map_err(|_| NoValue)? * f64::from(in_one);
    if !(0.0..=f64::from(u32::MAX)).contains(&number) {
        return Ok(u32::MAX);
    }
    // A tenth is no binary fraction.
    let is_step = (number - number.round()).abs() < 1e-6;
    if is_step { Ok(number.round() as u32) } else { Err(NoValue) }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::Value as Json;

    use super::*;
    use crate::settings::Mending;

    /// The fields of settings, with their values; what is written of a field where it is set.
    fn fields(settings: &Settings) -> Vec<(String, Json)> {
        let Json::Object(whole) = serde_json::to_value(settings).unwrap() else { panic!("settings are an object") };
        let stages = ["mending", "smoothing", "decimation"];
        let mut all = Vec::new();
        for (name, value) in whole {
            match value {
                Json::Object(parts) if stages.contains(&name.as_str()) => {
                    all.extend(parts.into_iter().map(|(part, value)| (format!("{name}.{part}"), value)));
                }
                value => all.push((name, value)),
            }
        }
        all
    }

    /// Settings of which every field is written: those of mending are where something is mended.
    fn told() -> Settings {
        Settings { mending: Mending { weld_mm: Some(1.0), ..Mending::default() }, ..Settings::default() }
    }

    /// A value that is not the default, as text.
    fn other(setting: &Setting) -> String {
        match &setting.kind {
            Kind::Switch { at } => Value::Switch(!*at(&mut told())).to_string(),
            Kind::Choice { names, .. } => names[1].to_lowercase(),
            Kind::Pieces { .. } => "7".to_owned(),
            _ => setting.range().unwrap().bounds.start().to_string(),
        }
    }

    #[test]
    fn every_field_has_a_row_and_every_row_a_field() {
        let written: BTreeSet<String> = fields(&told()).into_iter().map(|(name, _)| name).collect();
        let rows: BTreeSet<String> = all().map(|setting| setting.field.to_owned()).collect();
        assert_eq!(written, rows);
        let keys: BTreeSet<&str> = all().map(|setting| setting.key).collect();
        assert_eq!(keys.len(), all().count(), "no name stands twice");
    }

    #[test]
    fn a_row_sets_its_field_and_no_other() {
        for setting in all() {
            let mut settings = told();
            let text = other(setting);
            setting.read(&mut settings, &text).unwrap();
            assert_eq!(setting.value(&settings).unwrap().to_string(), text, "{setting:?}");
            assert_ne!(setting.value(&settings), setting.value(&told()), "{setting:?}");
            let changed: Vec<String> = fields(&settings)
                .into_iter()
                .zip(fields(&told()))
                .filter(|(now, before)| now != before)
                .map(|((name, _), _)| name)
                .collect();
            assert_eq!(changed, [setting.field], "{setting:?}");
            assert_eq!(settings.check(), Ok(()), "{setting:?}");
        }
    }

    #[test]
    fn numbers_out_of_their_range_are_refused_by_name() {
        for setting in all().filter(|setting| setting.range().is_some_and(|range| range.bounds.end() < &1e6)) {
            let mut settings = Settings::default();
            let beyond = setting.range().unwrap().bounds.end() + 1.0;
            setting.read(&mut settings, &beyond.to_string()).unwrap();
            let error = settings.check().unwrap_err();
            let refused = setting.messages.refused.expect("a number can be out of range");
            assert_eq!(error, refused(beyond).into());
            assert!(error.to_string().contains(&format!("not {beyond}")), "{error}");
        }
    }
}
