//! The options that the table of settings makes: one for each setting, called as its pair in a link is.
//!
//! A switch has two, so that it can be turned on and off over a settings file: `--adapt` and `--no-adapt`. The last one
//! counts.

use clap::builder::{PossibleValuesParser, ValueParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};

use crate::pipeline::settings::table::{self, Kind, Setting, Value};
use crate::pipeline::settings::{Mending, Settings, Target};
use crate::pipeline::verdict::rate;

/// The settings that were given, in the order of the table, as a link says them.
#[derive(Clone, Debug, Default)]
pub(super) struct Given {
    values: Vec<(&'static Setting, String)>,
    /// `--reduction`, which says more than a target.
    pub(super) reduction: Option<Reduction>,
}

impl Given {
    /// Sets what was given.
    pub(super) fn put(&self, settings: &mut Settings) {
        for (setting, value) in &self.values {
            let is_read = setting.read(settings, value);
            debug_assert!(is_read.is_ok(), "{setting:?}: {value}");
        }
        match self.reduction {
            Some(Reduction::Percent(percent)) => settings.target = rate(percent),
            // For it the pipeline finds how far is safe.
            Some(Reduction::Auto | Reduction::Safe) => settings.target = Target::Auto,
            None => {}
        }
    }

    fn of(rows: impl Iterator<Item = &'static Setting>, matches: &ArgMatches) -> Result<Self, Error> {
        let mut given = Self::default();
        for setting in rows {
            let key = setting.key;
            if let Kind::Switch { .. } = setting.kind {
                for (name, is_on) in [(key.to_owned(), true), (opposite(setting), false)] {
                    if matches.try_contains_id(&name).unwrap_or(false) && matches.get_flag(&name) {
                        given.values.push((setting, Value::Switch(is_on).to_string()));
                    }
                }
            } else if key == "reduction" {
                given.reduction = matches.get_one(key).copied();
            } else if let Some(value) = matches.get_one::<String>(key) {
                given.values.push((setting, value.to_lowercase()));
            }
        }
        Ok(given)
    }
}

impl FromArgMatches for Given {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        Self::of(table::all(), matches)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Given {
    fn augment_args(command: Command) -> Command {
        command.args(table::all().flat_map(|setting| arguments(setting, true)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// What of a surface is mended before anything else, where nothing else is done: there is no settings file to go over.
#[derive(Clone, Debug, Default)]
pub(super) struct MendingOptions(Given);

impl MendingOptions {
    /// What is asked for.
    pub(super) fn asked(&self) -> Mending {
        let mut settings = Settings::default();
        self.0.put(&mut settings);
        settings.mending
    }
}

impl FromArgMatches for MendingOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        Given::of(table::of("mending"), matches).map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for MendingOptions {
    fn augment_args(command: Command) -> Command {
        command.args(table::of("mending").flat_map(|setting| arguments(setting, false)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The name of the option that turns a switch off.
fn opposite(setting: &Setting) -> String {
    format!("no-{}", setting.key)
}

/// The options of a setting: of a switch that which is not the default, and the other one where it can be `begun` otherwise.
fn arguments(setting: &'static Setting, begun: bool) -> Vec<Arg> {
    let (key, option) = (setting.key, &setting.option);
    let arg = |name: &str| Arg::new(name.to_owned()).long(name.to_owned());
    if let Kind::Switch { .. } = setting.kind {
        let mut names = [key.to_owned(), opposite(setting)];
        if setting.default() == Some(Value::Switch(true)) {
            names.reverse();
        }
        let [changed, default] = names;
        let switch = arg(&changed).action(ArgAction::SetTrue).help(option.help);
        if !begun {
            return vec![switch];
        }
        let help = format!("The opposite of --{changed}, over what --settings or --smoothing says");
        let other = arg(&default).action(ArgAction::SetTrue).help(help).overrides_with(changed);
        return vec![switch.overrides_with(default), other];
    }
    let others = table::of("target").map(|way| way.key).filter(|way| *way != key && setting.field == "target");
    let arg = arg(key).value_name(option.value).help(option.help).conflicts_with_all(others);
    vec![match setting.kind {
        Kind::Choice { names, .. } => {
            let names = names.iter().map(|name| name.to_lowercase());
            arg.value_parser(PossibleValuesParser::new(names)).ignore_case(true)
        }
        _ => arg.value_parser(parser(setting)),
    }]
}

/// How the value of an option is read: all but `--reduction` are kept as a link has them.
fn parser(setting: &'static Setting) -> ValueParser {
    let value = move |text: &str| -> Result<String, String> {
        let number = || number(text, setting.range().map_or("", |range| range.unit));
        match setting.kind {
            // A link may ask for no triangles; nobody types that.
            Kind::Target { steps: 1, .. } if text.parse() == Ok(0) => {
                Err("at least one triangle has to be kept".to_owned())
            }
            Kind::Target { steps: 1000, .. } => Ok((f64::from(micrometres(text)?) / 1000.0).to_string()),
            Kind::Number { .. } | Kind::Limit { .. } => Ok(number()?.to_string()),
            _ => {
                let text = text.to_lowercase();
                let is_read = setting.read(&mut Settings::default(), &text);
                is_read.map_err(|_| format!("{text} is no value of --{}", setting.key))?;
                Ok(text)
            }
        }
    };
    if setting.key == "reduction" { ValueParser::new(reduction) } else { ValueParser::new(value) }
}

/// How far to reduce.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reduction {
    /// By this part of the triangles.
    Percent(f64),
    /// As far as every vessel keeps its calibre.
    Safe,
    /// By 90 % or as far as that, whichever is less.
    Auto,
}

fn reduction(text: &str) -> Result<Reduction, String> {
    match text.trim().to_lowercase().as_str() {
        "safe" => Ok(Reduction::Safe),
        "auto" => Ok(Reduction::Auto),
        _ => percent(text).map(Reduction::Percent),
    }
}

/// A reduction rate in percent.
pub(super) fn percent(text: &str) -> Result<f64, String> {
    let value = number(text, "%")?;
    let most = f64::from(Target::MAX_PER_MILLE) / 10.0;
    if (0.0..=most).contains(&value) { Ok(value) } else { Err(format!("{text} is not between 0 and {most} %")) }
}

/// A number, with or without its unit.
fn number(text: &str, unit: &str) -> Result<f64, String> {
    let number = text.trim();
    let number = number.strip_suffix(unit).unwrap_or(number).trim_end();
    number.parse().map_err(|_| match unit {
        "%" => format!("{text} is not a percentage"),
        "mm" => format!("{text} is not a length in mm"),
        _ => format!("{text} is not a number"),
    })
}

/// A length in mm as thousandths, rounded down: what is within them is within the length.
fn micrometres(text: &str) -> Result<u32, String> {
    // The nearest binary fraction of 0.29 is a little less than 0.29.
    let thousandths = (number(text, "mm")? * 1000.0 + 1e-6).floor();
    let range = f64::from(*Target::DEVIATION.start())..=f64::from(*Target::DEVIATION.end());
    if range.contains(&thousandths) {
        Ok(thousandths as u32)
    } else {
        Err(format!("{text} is not between 0.001 and 1000 mm"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::settings::Keep;

    /// What a command line makes of settings.
    fn given(arguments: &str, settings: &Settings) -> Result<Settings, Error> {
        let command = Given::augment_args(Command::new("lumen").no_binary_name(true));
        let given = Given::from_arg_matches(&command.try_get_matches_from(arguments.split_whitespace())?)?;
        let mut settings = settings.clone();
        given.put(&mut settings);
        Ok(settings)
    }

    #[test]
    fn every_setting_can_be_given_as_a_link_says_it() {
        for setting in table::all() {
            for text in told(setting) {
                let mut meant = Settings::default();
                setting.read(&mut meant, &text).unwrap();
                let option = match (&setting.kind, text.as_str()) {
                    (Kind::Switch { .. }, "yes") => format!("--{}", setting.key),
                    (Kind::Switch { .. }, _) => format!("--no-{}", setting.key),
                    _ => format!("--{}={text}", setting.key),
                };
                assert_eq!(given(&option, &Settings::default()).unwrap(), meant, "{option}");
            }
        }
    }

    /// Values of a setting as a link has them.
    fn told(setting: &Setting) -> Vec<String> {
        match &setting.kind {
            Kind::Switch { .. } => vec!["yes".to_owned(), "no".to_owned()],
            Kind::Choice { names, .. } => names.iter().map(|name| name.to_lowercase()).collect(),
            Kind::Pieces { .. } => ["largest", "all", "3", "0,3"].map(str::to_owned).to_vec(),
            Kind::Target { named: Some((name, _)), range, .. } => {
                vec![name.to_lowercase(), range.bounds.end().to_string()]
            }
            _ => vec![setting.range().unwrap().bounds.end().to_string()],
        }
    }

    #[test]
    fn every_switch_goes_on_and_off_over_other_settings_and_the_last_one_counts() {
        for setting in table::all() {
            let Kind::Switch { at } = setting.kind else { continue };
            for begun in [false, true] {
                let mut settings = Settings::default();
                *at(&mut settings) = begun;
                let (on, off) = (format!("--{}", setting.key), format!("--no-{}", setting.key));
                for (options, meant) in [
                    (String::new(), begun),
                    (on.clone(), true),
                    (off.clone(), false),
                    (format!("{on} {off}"), false),
                    (format!("{off} {on}"), true),
                ] {
                    let mut given = given(&options, &settings).unwrap();
                    assert_eq!(*at(&mut given), meant, "{setting:?}: {options}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for options in [
            "--keep=some",
            "--window=boxcar",
            "--iterations=1.5",
            "--pass-band=x",
            "--triangles=0",
            "--triangles=5 --reduction=50",
            "--max-deviation=1 --triangles=5",
        ] {
            assert!(given(options, &Settings::default()).is_err(), "{options}");
        }
        let settings = Settings { target: Target::Triangles(5), ..Settings::default() };
        assert_eq!(given("--reduction=Auto", &settings).unwrap().target, Target::Auto);
        assert_eq!(given("", &settings).unwrap().target, Target::Triangles(5), "those of the settings file stay");
        assert_eq!(given("--window=NUTTALL --keep=ALL", &Settings::default()).unwrap().keep, Keep::All);
    }

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
