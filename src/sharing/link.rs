//! The settings in a link: the part of an address after `#`, which a browser sends to no server.
//!
//! `v=1&file=ba7816bf8f01cfea&keep=largest&window=hamming&pass-band=0.01&...`: each pair is called as the option of
//! `lumen optimise` is, in any order, each once, and none may be missing. Numbers are written with the fewest digits that
//! read back as the same number. No value needs an escape.

use std::str::FromStr;

use thiserror::Error;

use super::{SharedSettings, ShortDigest};
use crate::io::Unit;
use crate::phantom::Sample;
use crate::pipeline::settings::{
    Boundary, Decimation, Keep, Mending, Method, Settings, SettingsError, Smoothing, Target, Window,
};
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
    #[error("{}", say!("app-link-range", why = .0.to_string()))]
    Range(#[from] SettingsError),
}

impl Link {
    /// The link's fragment, without `#`.
    pub fn fragment(&self) -> String {
        // All by name: a setting that is new has to find its pair here and in `parse`.
        let Settings { mending, keep, smoothing, decimation, target, tolerance_percent } = &self.shared.settings;
        let Smoothing { window, pass_band, iterations, boundary, preserve_volume, adapt, guard } = smoothing;
        let Decimation { method, feature_angle, spare_thin, keep_labels } = decimation;
        let Mending { weld_mm, split, fill_mm, lumen } = mending;
        let mut pairs = vec![("v", VERSION.to_string())];
        pairs.push(match self.surface {
            SharedSurface::File(digest) => ("file", digest.to_string()),
            SharedSurface::Sample(sample) => ("sample", sample.to_string()),
        });
        if let Some(unit) = self.shared.unit {
            pairs.push(("unit", unit.to_string()));
        }
        // Only where they are asked for: a link without them is as it was before there was mending.
        pairs.extend(weld_mm.map(|mm| ("weld", mm.to_string())));
        pairs.extend(split.then(|| ("split", switch_word(true))));
        pairs.extend(fill_mm.map(|mm| ("fill-holes", mm.to_string())));
        pairs.extend(lumen.then(|| ("lumen", switch_word(true))));
        pairs.extend(keep_labels.then(|| ("keep-labels", switch_word(true))));
        pairs.extend([
            ("keep", keep_word(*keep)),
            ("window", window.name().to_lowercase()),
            ("pass-band", pass_band.to_string()),
            ("iterations", iterations.to_string()),
            ("boundary", boundary_word(*boundary).to_owned()),
            ("preserve-volume", switch_word(*preserve_volume)),
            ("adapt", switch_word(*adapt)),
            ("guard", switch_word(*guard)),
            ("method", method.name().to_lowercase()),
            ("feature-angle", feature_angle.to_string()),
            ("spare-thin", switch_word(*spare_thin)),
            match *target {
                Target::Reduction(per_mille) => ("reduction", (f64::from(per_mille) / 10.0).to_string()),
                Target::Triangles(count) => ("triangles", count.to_string()),
                Target::Deviation(micrometres) => ("max-deviation", (f64::from(micrometres) / 1e3).to_string()),
            },
            ("tolerance", tolerance_percent.to_string()),
        ]);
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
        let mut pairs = Pairs(fragment.split('&').map(|pair| pair.split_once('=').unwrap_or((pair, ""))).collect());
        let version: u32 = pairs.read("v")?;
        if version > VERSION {
            return Err(LinkError::Newer { found: version });
        }
        if version == 0 {
            return Err(LinkError::Value { key: "v", value: version.to_string() });
        }
        let link = Self {
            surface: match pairs.find("sample") {
                Some(value) => SharedSurface::Sample(read("sample", value)?),
                None => SharedSurface::File(pairs.read("file")?),
            },
            shared: SharedSettings {
                unit: pairs.find("unit").map(|value| read::<Unit>("unit", value)).transpose()?,
                settings: Settings {
                    mending: Mending {
                        weld_mm: pairs.find("weld").map(|value| read("weld", value)).transpose()?,
                        split: pairs.optional_switch("split")?,
                        fill_mm: pairs.find("fill-holes").map(|value| read("fill-holes", value)).transpose()?,
                        lumen: pairs.optional_switch("lumen")?,
                    },
                    keep: pairs.with("keep", read_keep)?,
                    smoothing: Smoothing {
                        window: pairs.with("window", |value| named(&Window::ALL, Window::name, value))?,
                        pass_band: pairs.read("pass-band")?,
                        iterations: pairs.read("iterations")?,
                        boundary: pairs.with("boundary", |value| {
                            [Boundary::Loop, Boundary::Vtk15].into_iter().find(|&it| boundary_word(it) == value)
                        })?,
                        preserve_volume: pairs.switch("preserve-volume")?,
                        adapt: pairs.switch("adapt")?,
                        guard: pairs.switch("guard")?,
                    },
                    decimation: Decimation {
                        method: pairs.with("method", |value| named(&Method::ALL, Method::name, value))?,
                        feature_angle: pairs.read("feature-angle")?,
                        spare_thin: pairs.switch("spare-thin")?,
                        keep_labels: pairs.optional_switch("keep-labels")?,
                    },
                    target: pairs.target()?,
                    tolerance_percent: pairs.read("tolerance")?,
                },
            },
        };
        if let Some((key, _)) = pairs.0.first() {
            // What has been read once is gone: what is left of its name came a second time.
            let known = link.fragment();
            let is_known = known.split('&').any(|pair| pair.split_once('=').is_some_and(|(known, _)| known == *key));
            let key = shown(key);
            return Err(if is_known { LinkError::Twice(key) } else { LinkError::Unknown(key) });
        }
        link.shared.settings.check()?;
        Ok(link)
    }
}

/// `settings` with `changes` in place of their own: names and values as in a link.
///
/// # Errors
/// The first of them that is unknown, or a value that it cannot have.
pub fn changed_settings(settings: &Settings, changes: &[(&str, &str)]) -> Result<Settings, LinkError> {
    const TARGETS: [&str; 3] = ["reduction", "triangles", "max-deviation"];
    let surface = SharedSurface::Sample(Sample::Aorta);
    let whole = Link { surface, shared: SharedSettings { unit: None, settings: settings.clone() } }.fragment();
    let has_target = changes.iter().any(|(key, _)| TARGETS.contains(key));
    let is_kept = |pair: &&str| {
        let key = pair.split_once('=').map_or(*pair, |(key, _)| key);
        let is_changed = changes.iter().any(|(changed, _)| *changed == key) && !["v", "sample"].contains(&key);
        !(is_changed || has_target && TARGETS.contains(&key))
    };
    let kept = whole.split('&').filter(is_kept).map(str::to_owned);
    let changed = changes.iter().map(|(key, value)| format!("{key}={value}"));
    Ok(Link::parse(&kept.chain(changed).collect::<Vec<_>>().join("&"))?.shared.settings)
}

/// The pairs that have not been read yet.
struct Pairs<'a>(Vec<(&'a str, &'a str)>);

impl<'a> Pairs<'a> {
    fn find(&mut self, key: &str) -> Option<&'a str> {
        let at = self.0.iter().position(|(found, _)| *found == key)?;
        Some(self.0.remove(at).1)
    }

    fn with<T>(&mut self, key: &'static str, read: impl FnOnce(&str) -> Option<T>) -> Result<T, LinkError> {
        let value = self.find(key).ok_or(LinkError::Missing(key))?;
        read(value).ok_or_else(|| LinkError::Value { key, value: shown(value) })
    }

    fn read<T: FromStr>(&mut self, key: &'static str) -> Result<T, LinkError> {
        self.with(key, |value| value.parse().ok())
    }

    fn switch(&mut self, key: &'static str) -> Result<bool, LinkError> {
        self.with(key, |value| [true, false].into_iter().find(|&is_on| switch_word(is_on) == value))
    }

    /// Off where it is not there.
    fn optional_switch(&mut self, key: &'static str) -> Result<bool, LinkError> {
        if self.0.iter().any(|(found, _)| *found == key) { self.switch(key) } else { Ok(false) }
    }

    fn target(&mut self) -> Result<Target, LinkError> {
        if let Some(value) = self.find("triangles") {
            return read("triangles", value).map(Target::Triangles);
        }
        if let Some(value) = self.find("max-deviation") {
            return steps("max-deviation", value, 1e3).map(Target::Deviation);
        }
        let value = self.find("reduction").ok_or(LinkError::Missing("reduction"))?;
        steps("reduction", value, 10.0).map(Target::Reduction)
    }
}

/// A number as a count of steps, of which there are so many in one; a number between two is refused. What is none (NaN,
/// negative, huge) becomes one that `Settings::check` refuses.
fn steps(key: &'static str, value: &str, in_one: f64) -> Result<u32, LinkError> {
    let number = read::<f64>(key, value)? * in_one;
    if !(0.0..=f64::from(u32::MAX)).contains(&number) {
        return Ok(u32::MAX);
    }
    // A tenth is no binary fraction.
    let is_step = (number - number.round()).abs() < 1e-6;
    if is_step { Ok(number.round() as u32) } else { Err(LinkError::Value { key, value: shown(value) }) }
}

fn read<T: FromStr>(key: &'static str, value: &str) -> Result<T, LinkError> {
    value.parse().map_err(|_| LinkError::Value { key, value: shown(value) })
}

fn named<T: Copy>(all: &[T], name: fn(T) -> &'static str, value: &str) -> Option<T> {
    all.iter().copied().find(|&it| name(it).to_lowercase() == value)
}

fn switch_word(is_on: bool) -> String {
    if is_on { "yes" } else { "no" }.to_owned()
}

fn boundary_word(boundary: Boundary) -> &'static str {
    match boundary {
        Boundary::Loop => "loop",
        Boundary::Vtk15 => "vtk15",
    }
}

fn keep_word(keep: Keep) -> String {
    match keep {
        Keep::Largest => "largest".to_owned(),
        Keep::All => "all".to_owned(),
        Keep::Component(number) => number.to_string(),
    }
}

fn read_keep(value: &str) -> Option<Keep> {
    match value {
        "largest" => Some(Keep::Largest),
        "all" => Some(Keep::All),
        number => number.parse().ok().map(Keep::Component),
    }
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

    fn example() -> Link {
        Link { surface: SharedSurface::File(Digest::of(b"abc").short()), shared: SharedSettings::default() }
    }

    fn links() -> impl Strategy<Value = Link> {
        let keep = prop_oneof![Just(Keep::Largest), Just(Keep::All), any::<u32>().prop_map(Keep::Component)];
        let target = prop_oneof![
            (0..=Target::MAX_PER_MILLE).prop_map(Target::Reduction),
            any::<u32>().prop_map(Target::Triangles),
            Target::DEVIATION.prop_map(Target::Deviation)
        ];
        let smoothing = (
            prop::sample::select(Window::ALL.to_vec()),
            Smoothing::PASS_BAND,
            0..=Smoothing::MAX_ITERATIONS,
            any::<[bool; 4]>(),
        )
            .prop_map(|(window, pass_band, iterations, [vtk, preserve_volume, adapt, guard])| Smoothing {
                window,
                pass_band,
                iterations,
                boundary: if vtk { Boundary::Vtk15 } else { Boundary::Loop },
                preserve_volume,
                adapt,
                guard,
            });
        let decimation = (prop::sample::select(Method::ALL.to_vec()), 0.0..=180.0, any::<bool>(), any::<bool>())
            .prop_map(|(method, feature_angle, spare_thin, keep_labels)| Decimation {
                method,
                feature_angle,
                spare_thin,
                keep_labels,
            });
        let unit = prop::option::of(prop::sample::select(Unit::ALL.to_vec()));
        let surface = prop_oneof![
            any::<[u8; 4]>().prop_map(|bytes| SharedSurface::File(Digest::of(&bytes).short())),
            prop::sample::select(Sample::ALL.to_vec()).prop_map(SharedSurface::Sample)
        ];
        let mending =
            (prop::option::of(Mending::WELD_MM), any::<bool>(), prop::option::of(Mending::FILL_MM), any::<bool>())
                .prop_map(|(weld_mm, split, fill_mm, lumen)| Mending { weld_mm, split, fill_mm, lumen });
        (surface, unit, mending, keep, smoothing, decimation, target, 0.0..=100.0).prop_map(
            |(surface, unit, mending, keep, smoothing, decimation, target, tolerance_percent)| Link {
                surface,
                shared: SharedSettings {
                    unit,
                    settings: Settings { mending, keep, smoothing, decimation, target, tolerance_percent },
                },
            },
        )
    }

    proptest! {
        #[test]
        fn a_link_comes_back_to_the_last_bit(link in links()) {
            let fragment = link.fragment();
            prop_assert!(fragment.len() < 500, "{}", fragment);
            prop_assert!(fragment.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-.=&".contains(&byte)));
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
             preserve-volume=no&adapt=yes&guard=yes&method=schroeder&feature-angle=60&spare-thin=no&reduction=90&\
             tolerance=2"
        );
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
            said(&whole.replace("reduction=90", "reduction=90.04")),
            "The link cannot be read: \"90.04\" is no value for \"reduction\"."
        );
        for rate in ["-1", "100", "1e300", "NaN"] {
            let error = Link::parse(&whole.replace("reduction=90", &format!("reduction={rate}"))).unwrap_err();
            assert!(matches!(error, LinkError::Range(_)), "{rate}: {error}");
        }
    }
}
