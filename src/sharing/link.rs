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
    Boundary, Decimation, Keep, Method, Settings, SettingsError, Smoothing, Target, Window,
};

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
    #[error("The link is longer than any that Lumen makes: it has {0} bytes.")]
    Long(usize),
    /// A later version.
    #[error("The link was made by a newer Lumen: its version is {found}, and this Lumen reads {VERSION}.")]
    Newer {
        /// The version in the link.
        found: u32,
    },
    /// A pair is not there: part of the link was lost.
    #[error("The link is not whole: it does not say \"{0}\".")]
    Missing(&'static str),
    /// Two values of one name.
    #[error("The link says \"{0}\" twice.")]
    Twice(String),
    /// A name without a meaning, or with none beside the others.
    #[error("The link says \"{0}\", which means nothing here.")]
    Unknown(String),
    /// A value that the name cannot have.
    #[error("The link cannot be read: \"{value}\" is no value for \"{key}\".")]
    Value {
        /// The name.
        key: &'static str,
        /// The value, cut to what can be shown.
        value: String,
    },
    /// A number is out of range.
    #[error("The link cannot be used: {0}.")]
    Range(#[from] SettingsError),
}

impl Link {
    /// The link's fragment, without `#`.
    pub fn fragment(&self) -> String {
        // All by name: a setting that is new has to find its pair here and in `parse`.
        let Settings { keep, smoothing, decimation, target, tolerance_percent } = &self.shared.settings;
        let Smoothing { window, pass_band, iterations, boundary, preserve_volume, adapt, guard } = smoothing;
        let Decimation { method, feature_angle, spare_thin } = decimation;
        let mut pairs = vec![("v", VERSION.to_string())];
        pairs.push(match self.surface {
            SharedSurface::File(digest) => ("file", digest.to_string()),
            SharedSurface::Sample(sample) => ("sample", sample.to_string()),
        });
        if let Some(unit) = self.shared.unit {
            pairs.push(("unit", unit.to_string()));
        }
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
        let link = Self {
            surface: match pairs.find("sample") {
                Some(value) => SharedSurface::Sample(read("sample", value)?),
                None => SharedSurface::File(pairs.read("file")?),
            },
            shared: SharedSettings {
                unit: pairs.find("unit").map(|value| read::<Unit>("unit", value)).transpose()?,
                settings: Settings {
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

    fn target(&mut self) -> Result<Target, LinkError> {
        if let Some(value) = self.find("triangles") {
            return read("triangles", value).map(Target::Triangles);
        }
        if let Some(value) = self.find("max-deviation") {
            let thousandths = read::<f64>("max-deviation", value)? * 1e3;
            return Ok(Target::Deviation(nearest(thousandths)));
        }
        Ok(Target::Reduction(nearest(self.read::<f64>("reduction")? * 10.0)))
    }
}

/// The nearest integer; what is none (NaN, negative, huge) becomes one that `Settings::check` refuses.
fn nearest(value: f64) -> u32 {
    if value.is_nan() || value < 0.0 { u32::MAX } else { value.round() as u32 }
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
        let decimation = (prop::sample::select(Method::ALL.to_vec()), 0.0..=180.0, any::<bool>())
            .prop_map(|(method, feature_angle, spare_thin)| Decimation { method, feature_angle, spare_thin });
        let unit = prop::option::of(prop::sample::select(Unit::ALL.to_vec()));
        let surface = prop_oneof![
            any::<[u8; 4]>().prop_map(|bytes| SharedSurface::File(Digest::of(&bytes).short())),
            prop::sample::select(Sample::ALL.to_vec()).prop_map(SharedSurface::Sample)
        ];
        (surface, unit, keep, smoothing, decimation, target, 0.0..=100.0).prop_map(
            |(surface, unit, keep, smoothing, decimation, target, tolerance_percent)| Link {
                surface,
                shared: SharedSettings {
                    unit,
                    settings: Settings { keep, smoothing, decimation, target, tolerance_percent },
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
        for rate in ["-1", "100", "1e300", "NaN"] {
            let error = Link::parse(&whole.replace("reduction=90", &format!("reduction={rate}"))).unwrap_err();
            assert!(matches!(error, LinkError::Range(_)), "{rate}: {error}");
        }
    }
}
