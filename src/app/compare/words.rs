//! A setting in words and a result in numbers, for people.

use super::difference::Difference;
use crate::language::{Key, decimal, exact, grouped, signed};
use crate::pipeline::paper;
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Settings, Target};
use crate::report::words::{others, said};
use crate::say;

/// Parts of a setting: what each of them says stands in `parts`.
const PARTS: usize = 8;
/// The settings that have a place there; others are said where they are not as by default.
const SMOOTHING: [&str; 7] = ["pass-band", "iterations", "window", "preserve-volume", "adapt", "guard", "hold-caps"];
const REDUCTION: [&str; 4] = ["method", "feature-angle", "spare-thin", "keep-labels"];

/// A setting, part by part; a part that does not apply is empty.
fn parts(settings: &Settings) -> [String; PARTS] {
    let smoothing = &settings.smoothing;
    let said = |keys: &[&str]| keys.iter().filter_map(|key| said(key, settings)).collect::<Vec<_>>();
    let one = |key: &str| said(&[key]).concat();
    let band = if smoothing.iterations == 0 { say!("compare-not-smoothed") } else { one("pass-band") };
    let target = match settings.target {
        Target::Auto => say!("compare-auto"),
        Target::Reduction(0) => say!("compare-not-reduced"),
        Target::Reduction(per_mille) => say!("compare-reduction", percent = f64::from(per_mille) / 10.0),
        Target::Triangles(count) => say!("compare-triangles-wanted", count = count),
        Target::Deviation(micrometres) => {
            say!("compare-deviation-up-to", most = exact(f64::from(micrometres) / 1000.0))
        }
    };
    let mut how = said(&["preserve-volume"]);
    if smoothing.iterations > 0 && smoothing.adapt && smoothing.guard && smoothing.hold_caps {
        how.push(say!("compare-suits"));
    } else {
        how.extend(said(&["adapt", "guard", "hold-caps"]));
    }
    how.extend(others("smoothing", &SMOOTHING, settings));
    let mut spared = said(&["spare-thin", "keep-labels"]);
    spared.extend(others("decimation", &REDUCTION, settings));
    let [iterations, window, method, angle] = ["iterations", "window", "method", "feature-angle"].map(one);
    [band, iterations, window, how.join(", "), method, angle, spared.join(", "), target]
}

/// What all settings share, and for each what sets it apart: its title. Where nothing does, the title says the most.
pub(super) fn titles(all: &[&Settings]) -> (String, Vec<String>) {
    let parts: Vec<_> = all.iter().map(|settings| parts(settings)).collect();
    let differs: [bool; PARTS] = std::array::from_fn(|i| parts.windows(2).any(|pair| pair[0][i] != pair[1][i]));
    // The window, the method and the feature angle say little to most readers.
    let named = if differs.contains(&true) { differs } else { [true, true, false, true, false, false, true, true] };
    let join = |parts: &[String; PARTS], wanted: bool| {
        let chosen = parts.iter().zip(named).filter(|(part, named)| *named == wanted && !part.is_empty());
        capital(&chosen.map(|(part, _)| part.as_str()).collect::<Vec<_>>().join(", "))
    };
    let shared = parts.first().map_or(String::new(), |first| join(first, false));
    (shared, parts.iter().map(|parts| join(parts, true)).collect())
}

/// What is compared, in plain words, and the figure of the paper that it is.
pub(super) fn heading(all: &[&Settings]) -> (String, String) {
    let is = |figure: &[Settings]| figure.iter().eq(all.iter().copied());
    let plain = || (say!("compare-heading"), String::new());
    let Some(first) = all.first() else { return plain() };
    if is(&paper::figure_6(first.keep)) {
        (say!("compare-heading-smoothing"), say!("compare-paper-figure-6"))
    } else if is(&paper::figure_7(first.keep)) {
        (say!("compare-heading-triangles"), say!("compare-paper-figure-7"))
    } else if is(&paper::rates_of_figure_7(first)) {
        (say!("compare-heading-triangles"), say!("compare-paper-rates"))
    } else {
        plain()
    }
}

/// How far a surface is from the first.
pub(super) fn difference(found: &Difference) -> String {
    match found.deviation {
        Some(found) => say!("compare-from-a", mean = decimal(found.mean, 3), most = decimal(found.max, 3)),
        None => say!("compare-no-area"),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A number of a result: what it is, how much, and what it means.
pub(super) struct Number {
    pub(super) what: Key,
    pub(super) how_much: String,
    pub(super) help: Option<Key>,
}

/// The numbers of a result. A dash stands where there is none.
pub(super) fn numbers(report: &Report) -> [Number; 5] {
    let dash = || "–".to_owned();
    let deviation = |found: Option<crate::pipeline::deviation::Deviation>| {
        found.map_or_else(dash, |d| format!("{} / {}", decimal(d.mean, 3), decimal(d.max, 3)))
    };
    let percent = |change: Option<f64>| change.map_or_else(dash, |change| format!("{} %", signed(change, 2)));
    let number = |what, how_much, help| Number { what, how_much, help: Some(help) };
    [
        number(Key("compare-triangles"), grouped(report.output.triangles), Key("compare-triangles-help")),
        number(
            Key("compare-removed"),
            format!("{} %", decimal(report.reduction_percent, 2)),
            Key("compare-removed-help"),
        ),
        number(Key("compare-volume"), percent(report.volume_change_percent), Key("compare-volume-help")),
        number(Key("compare-from-smoothed"), deviation(report.deviation_mm), Key("compare-from-smoothed-help")),
        number(
            Key("compare-from-original"),
            deviation(report.deviation_from_original_mm),
            Key("compare-from-original-help"),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::settings::Keep;

    #[test]
    fn the_papers_figures_have_a_plain_heading() {
        let of = |settings: &[Settings]| heading(&settings.iter().collect::<Vec<_>>());
        assert_eq!(of(&paper::figure_6(Keep::All)).1, "Figure 6 of the paper");
        assert_eq!(of(&paper::figure_7(Keep::Largest)).1, "Figure 7 of the paper");
        let rates = paper::rates_of_figure_7(&Settings::default());
        assert!(of(&rates).1.starts_with("Rates of Figure 7") && of(&rates).0 == of(&paper::figure_7(Keep::All)).0);
        assert!(of(&rates[1..]).1.is_empty() && of(&[]).1.is_empty());
    }

    #[test]
    fn titles_say_what_sets_a_setting_apart() {
        let six = paper::figure_6(Keep::Largest);
        let (shared, names) = titles(&six.iter().collect::<Vec<_>>());
        assert_eq!(shared, "Hamming window, Schroeder method, feature angle 60°, not reduced");
        assert_eq!((&*names[0], &*names[5]), ("Pass band 0.1, 30 iterations", "Pass band 0.01, 100 iterations"));
        let (shared, names) = titles(&paper::figure_7(Keep::Largest).iter().collect::<Vec<_>>());
        assert_eq!(shared, "Pass band 0.01, 100 iterations, Hamming window, Schroeder method, feature angle 60°");
        assert_eq!(names, ["Reduction 10 %", "Reduction 90 %", "Reduction 99 %"]);
        let (shared, names) = titles(&[&paper::reduced(90, Keep::Largest)]);
        assert_eq!(
            (&*shared, &*names[0]),
            ("Hamming window, Schroeder method, feature angle 60°", "Pass band 0.01, 100 iterations, reduction 90 %")
        );
        let (_, names) = titles(&[&Settings::default()]);
        assert_eq!(names, ["Pass band 0.01, 100 iterations, suits this surface, automatic reduction"]);
        let mut spared = Settings::default();
        spared.decimation.spare_thin = true;
        let (_, names) = titles(&[&Settings::default(), &spared]);
        assert_eq!(names, ["", "Thin vessels spared"]);
        assert_eq!(titles(&[]), (String::new(), vec![]));
    }
}
