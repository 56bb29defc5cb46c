//! The settings in a link: the part of an address after `#`, which a browser sends to no server.
//!
//! `v=1&file=ba7816bf8f01cfea&keep=largest&window=hamming&pass-band=0.01&...`: each pair is called as the option of
//! `lumen optimise` is ([`table`]), in any order, each once, and none that a link always has may be missing. Numbers are written with the fewest digits that
//! read back as the same number. No value needs an escape.

use std::str::FromStr;

use thiserror::Error;

use super::{Eye, SharedSettings, ShortDigest};
use crate::io::Unit;
use crate::language::tell;
use crate::phantom::Sample;
use crate::pipeline::settings::table::{self, InLink, Setting, Value};
use crate::pipeline::settings::{Settings, SettingsError};
use crate::say;

/// The version that is written and read.
const VERSION: u32 = 1;
/// The most bytes of a link that is read: Lumen makes less than 500.
const LONGEST: usize = 2000;

/// Which surface a link is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SharedSurface {
    /// The file whose hash begins so.
    File(ShortDigest),
    /// A sample, which everybody has.
    Sample(Sample),
}

/// What a link says.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The surface, without which nothing can be shown.
    pub surface: SharedSurface,
    /// What is made of it.
    pub shared: SharedSettings,
    /// From where it is looked at; `None` for from where all of it is seen.
    pub eye: Option<Eye>,
}

/// Why a link was not understood.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LinkError {
    /// Too long to be one.
    #[error("{}", say!("app-link-long", bytes = .0.to_string()))]
    Long(usize),
    /// A later version.
    #[error("{}", say!("app-link-newer", found = .found.to_string(), known = VERSION.to_string()))]
    Newer {
        /// The version in the link.
        found: u32,
    },
    /// A pair is not there: part of the link was lost.
    #[error("{}", say!("app-link-missing", pair = *.0))]
    Missing(&'static str),
    /// Two values of one name.
    #[error("{}", say!("app-link-twice", pair = .0))]
    Twice(String),
    /// A name without a meaning, or with none beside the others.
    #[error("{}", say!("app-link-unknown", pair = .0))]
    Unknown(String),
    /// A value that the name cannot have.
    #[error("{}", say!("app-link-value", value = .value, key = *.key))]
    Value {
        /// The name.
        key: &'static str,
        /// The value, cut to what can be shown.
        value: String,
    },
    /// A number is out of range.
    #[error("{}", say!("app-link-range", why = tell(.0)))]
    Range(#[from] SettingsError),
}

impl Link {
    /// The link's fragment, without `#`.
    pub fn fragment(&self) -> String {
        let mut pairs = vec![("v", VERSION.to_string())];
        pairs.push(match self.surface {
            SharedSurface::File(digest) => ("file", digest.to_string()),
            SharedSurface::Sample(sample) => ("sample", sample.to_string()),
        });
        if let Some(unit) = self.shared.unit {
            pairs.push(("unit", unit.to_string()));
        }
        if let Some(eye) = self.eye {
            pairs.push(("eye", eye.to_string()));
        }
        let settings = &self.shared.settings;
        let mut add = |in_link, is_told: fn(&Setting, Value) -> bool| {
            let rows = table::all().filter(|setting| setting.in_link == in_link);
            let values = rows.filter_map(|setting| Some((setting, setting.value(settings)?)));
            let told = values.filter(|&(setting, value)| is_told(setting, value));
            pairs.extend(told.map(|(setting, value)| (setting.key, value.to_string())));
        };
        add(InLink::Changed, |setting, value| setting.default() != Some(value));
        add(InLink::Always, |_, _| true);
        let pairs: Vec<String> = pairs.into_iter().map(|(key, value)| format!("{key}={value}")).collect();
        pairs.join("&")
    }

    /// Reads a fragment, with `#` or without.
    ///
    /// # Errors
    /// The first thing that is missing, unknown or out of range.
    pub fn parse(fragment: &str) -> Result<Self, LinkError> {
        let fragment = fragment.strip_prefix('#').unwrap_or(fragment);
        if fragment.len() > LONGEST {
            return Err(LinkError::Long(fragment.len()));
        }
        let mut pairs = Pairs::new(fragment.split('&').map(|pair| pair.split_once('=').unwrap_or((pair, ""))));
        let version: u32 = pairs.read("v")?;
        if version > VERSION {
            return Err(LinkError::Newer { found: version });
        }
        if version == 0 {
            return Err(LinkError::Value { key: "v", value: version.to_string() });
        }
        let surface = match pairs.find("sample") {
            Some(value) => SharedSurface::Sample(read("sample", value)?),
            None => SharedSurface::File(pairs.read("file")?),
        };
        let unit = pairs.find("unit").map(|value| read::<Unit>("unit", value)).transpose()?;
        let eye = pairs.find("eye").map(|value| read::<Eye>("eye", value)).transpose()?;
        let mut settings = Settings::default();
        pairs.read_settings(&mut settings, true)?;
        Ok(Self { surface, shared: SharedSettings { unit, settings }, eye })
    }
}

/// `settings` with `changes` in place of their own: names and values as in a link.
///
/// # Errors
/// The first of them that is unknown, or a value that it cannot have.
pub fn changed_settings(settings: &Settings, changes: &[(&str, &str)]) -> Result<Settings, LinkError> {
    let mut changed = settings.clone();
    Pairs::new(changes.iter().copied()).read_settings(&mut changed, false)?;
    Ok(changed)
}

/// The pairs of a link.
struct Pairs<'a> {
    /// Those that have not been read yet.
    left: Vec<(&'a str, &'a str)>,
    /// The names of those that have.
    read: Vec<&'static str>,
}

impl<'a> Pairs<'a> {
    fn new(pairs: impl Iterator<Item = (&'a str, &'a str)>) -> Self {
        Self { left: pairs.collect(), read: Vec::new() }
    }

    fn find(&mut self, key: &'static str) -> Option<&'a str> {
        let at = self.left.iter().position(|(found, _)| *found == key)?;
        self.read.push(key);
        Some(self.left.remove(at).1)
    }

    fn read<T: FromStr>(&mut self, key: &'static str) -> Result<T, LinkError> {
        read(key, self.find(key).ok_or(LinkError::Missing(key))?)
    }

    /// Reads all that is left into `settings`. A whole link names every setting but those that have to be named only where
    /// they are not the default.
    fn read_settings(mut self, settings: &mut Settings, is_whole: bool) -> Result<(), LinkError> {
        let ways: Vec<&Setting> = table::of("target").collect();
        let is_said = |way: &&&Setting| self.left.iter().any(|(key, _)| *key == way.key);
        // Another way to say the target beside this one is left over.
        let way = ways.iter().rev().find(is_said).unwrap_or(&ways[0]).key;
        for setting in table::all().filter(|setting| setting.field != "target" || setting.key == way) {
            let key = setting.key;
            match self.find(key) {
                Some(value) => {
                    setting.read(settings, value).map_err(|_| LinkError::Value { key, value: shown(value) })?;
                }
                None if is_whole && setting.in_link == InLink::Always => return Err(LinkError::Missing(key)),
                None => {}
            }
        }
        if let Some((key, _)) = self.left.first() {
            // What has been read once is gone: what is left of its name came a second time.
            let is_twice = self.read.contains(key);
            return Err(if is_twice { LinkError::Twice(shown(key)) } else { LinkError::Unknown(shown(key)) });
        }
        Ok(settings.check()?)
    }
}

fn read<T: FromStr>(key: &'static str, value: &str) -> Result<T, LinkError> {
    value.parse().map_err(|_| LinkError::Value { key, value: shown(value) })
}

/// As much of a stranger's text as is worth showing.
fn shown(text: &str) -> String {
    text.chars().filter(|letter| !letter.is_control()).take(40).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::Digest;
    use super::*;
    use crate::pipeline::settings::table::Kind;
    use crate::pipeline::settings::{Keep, Target};

    fn example() -> Link {
        Link { surface: SharedSurface::File(Digest::of(b"abc").short()), shared: SharedSettings::default(), eye: None }
    }

    /// A value of a setting as a link has it; `None` where it has none.
    fn values(setting: &'static Setting) -> BoxedStrategy<Option<String>> {
        match &setting.kind {
            Kind::Switch { .. } => any::<bool>().prop_map(|is_on| Some(Value::Switch(is_on).to_string())).boxed(),
            Kind::Number { range, .. } => range.bounds.clone().prop_map(|number| Some(number.to_string())).boxed(),
            Kind::Count { range, .. } => {
                (0..=*range.bounds.end() as u32).prop_map(|count| Some(count.to_string())).boxed()
            }
            Kind::Limit { range, .. } => {
                prop::option::of(range.bounds.clone()).prop_map(|limit| Some(limit?.to_string())).boxed()
            }
            Kind::Choice { names, .. } => {
                prop::sample::select(names.to_vec()).prop_map(|name| Some(Value::Name(name).to_string())).boxed()
            }
            Kind::Pieces { .. } => {
                let some = prop::collection::btree_set(any::<u32>(), 2..5)
                    .prop_map(|numbers| Keep::pieces(&Vec::from_iter(numbers)).unwrap());
                prop_oneof![Just(Keep::Largest), Just(Keep::All), any::<u32>().prop_map(Keep::Component), some]
                    .prop_map(|keep| Some(Value::Pieces(keep).to_string()))
                    .boxed()
            }
            Kind::Target { steps, named, range, .. } => {
                let [least, most] =
                    [range.bounds.start(), range.bounds.end()].map(|end| (end * f64::from(*steps)).round() as u32);
                let name = named.map(|(name, _)| name.to_lowercase());
                (prop::option::of(Just(())), least..=most)
                    .prop_map(move |(is_named, count)| {
                        let number = (f64::from(count) / f64::from(*steps)).to_string();
                        Some(name.clone().filter(|_| is_named.is_some()).unwrap_or(number))
                    })
                    .boxed()
            }
        }
    }

    /// Settings with any value of every row of the table.
    fn any_settings() -> impl Strategy<Value = Settings> {
        let values: Vec<_> = table::all().map(values).collect();
        (values, 0..table::of("target").count()).prop_map(|(values, way)| {
            let way = table::of("target").nth(way).unwrap().key;
            let mut settings = Settings::default();
            for (setting, value) in table::all().zip(values) {
                if let Some(value) = value.filter(|_| setting.field != "target" || setting.key == way) {
                    setting.read(&mut settings, &value).unwrap();
                }
            }
            settings
        })
    }

    fn links() -> impl Strategy<Value = Link> {
        let unit = prop::option::of(prop::sample::select(Unit::ALL.to_vec()));
        let surface = prop_oneof![
            any::<[u8; 4]>().prop_map(|bytes| SharedSurface::File(Digest::of(&bytes).short())),
            prop::sample::select(Sample::ALL.to_vec()).prop_map(SharedSurface::Sample)
        ];
        let eye =
            prop::option::of((prop::array::uniform3(-1e4..1e4f32), prop::array::uniform3(-1.0..1.0f32), 1e-3..1e4f32));
        let seen = |(target_mm, [a, b, c], distance_mm): ([f32; 3], [f32; 3], f32)| {
            let rotation = glam::Quat::from_euler(glam::EulerRot::XYZ, a, b, c).to_array();
            Eye { target_mm, rotation, distance_mm }.rounded()
        };
        (surface, unit, any_settings(), eye).prop_map(move |(surface, unit, settings, eye)| Link {
            surface,
            shared: SharedSettings { unit, settings },
            eye: eye.map(seen),
        })
    }

    proptest! {
        #[test]
        fn a_link_comes_back_to_the_last_bit(link in links()) {
            let fragment = link.fragment();
            prop_assert!(fragment.len() < 500, "{}", fragment);
            prop_assert!(fragment.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-.,=&".contains(&byte)));
            prop_assert_eq!(Link::parse(&format!("#{fragment}")), Ok(link));
        }

        #[test]
        fn no_fragment_makes_it_panic(text in ".{0,300}") {
            drop(Link::parse(&text));
        }

        #[test]
        fn no_value_makes_it_panic(which in 0usize..15, value in "[-+.eE0-9nainf%=]{0,40}|.{0,20}") {
            let mut pairs: Vec<String> = example().fragment().split('&').map(str::to_owned).collect();
            let key = pairs[which].split('=').next().unwrap_or_default().to_owned();
            pairs[which] = format!("{key}={value}");
            if let Ok(link) = Link::parse(&pairs.join("&")) {
                prop_assert_eq!(link.shared.settings.check(), Ok(()));
            }
        }
    }

    #[test]
    fn a_fragment_can_be_read_by_a_person() {
        assert_eq!(
            example().fragment(),
            "v=1&file=ba7816bf8f01cfea&keep=largest&window=hamming&pass-band=0.01&iterations=100&boundary=loop&\
             preserve-volume=no&adapt=yes&guard=yes&method=schroeder&feature-angle=60&spare-thin=no&reduction=auto&\
             tolerance=2"
        );
    }

    #[test]
    fn a_link_with_a_number_means_that_number() {
        for (written, target) in
            [("90", Target::Reduction(900)), ("67.1", Target::Reduction(671)), ("auto", Target::Auto)]
        {
            let fragment = example().fragment().replace("reduction=auto", &format!("reduction={written}"));
            let link = Link::parse(&fragment).unwrap();
            assert_eq!((link.shared.settings.target, link.fragment()), (target, fragment));
        }
    }

    #[test]
    fn what_is_wrong_with_a_link_is_said() {
        let whole = example().fragment();
        let said = |fragment: &str| Link::parse(fragment).unwrap_err().to_string();
        assert_eq!(said(""), "The link is not whole: it does not say \"v\".");
        assert_eq!(said(&whole[..whole.len() - 12]), "The link is not whole: it does not say \"tolerance\".");
        assert_eq!(
            said(&whole.replace("v=1", "v=2")),
            "The link was made by a newer Lumen: its version is 2, and this Lumen reads 1."
        );
        assert_eq!(said(&format!("{whole}&guard=no")), "The link says \"guard\" twice.");
        assert_eq!(said(&format!("{whole}&colour=red")), "The link says \"colour\", which means nothing here.");
        assert_eq!(said(&format!("{whole}&triangles=5")), "The link says \"reduction\", which means nothing here.");
        assert_eq!(
            said(&whole.replace("adapt=yes", "adapt=1")),
            "The link cannot be read: \"1\" is no value for \"adapt\"."
        );
        assert_eq!(
            said(&whole.replace("pass-band=0.01", "pass-band=NaN")),
            "The link cannot be used: the pass band must lie between 0.001 and 2, not NaN."
        );
        assert_eq!(said(&whole.replace("v=1", "v=0")), "The link cannot be read: \"0\" is no value for \"v\".");
        assert_eq!(
            said(&whole.replace("reduction=auto", "reduction=90.04")),
            "The link cannot be read: \"90.04\" is no value for \"reduction\"."
        );
        for eye in [
            "1,2,3",
            "0,0,0,0,0,0,1,0",
            "0,0,0,0,0,0,2,5",
            "0,0,NaN,0,0,0,1,5",
            "0,0,0,0,0,0,1,5,6",
            "3e38,0,0,0,0,0,1,9",
        ] {
            assert_eq!(
                said(&format!("{whole}&eye={eye}")),
                format!("The link cannot be read: \"{eye}\" is no value for \"eye\".")
            );
        }
        for rate in ["-1", "100", "1e300", "NaN"] {
            let error = Link::parse(&whole.replace("reduction=auto", &format!("reduction={rate}"))).unwrap_err();
            assert!(matches!(error, LinkError::Range(_)), "{rate}: {error}");
        }
    }
}
