//! A setting in words and a result in numbers, for people.

use crate::digits::grouped;
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Method, Settings, Target};

/// Parts of a setting.
const PARTS: usize = 8;

/// A setting, part by part; a part that does not apply is empty.
fn parts(settings: &Settings) -> [String; PARTS] {
    let smoothing = &settings.smoothing;
    let [band, iterations, window] = if smoothing.iterations == 0 {
        ["not smoothed".to_owned(), String::new(), String::new()]
    } else {
        [
            format!("pass band {}", smoothing.pass_band),
            format!("{} iterations", smoothing.iterations),
            format!("{} window", smoothing.window.name()),
        ]
    };
    let target = match settings.target {
        Target::Reduction(0) => "not reduced".to_owned(),
        Target::Reduction(per_mille) => format!("reduction {} %", f64::from(per_mille) / 10.0),
        Target::Triangles(count) => format!("{} triangles wanted", grouped(count as usize)),
        Target::Deviation(micrometres) => format!("deviation up to {} mm", f64::from(micrometres) / 1000.0),
    };
    let holds_volume = smoothing.preserve_volume && smoothing.iterations > 0;
    let suits = match (smoothing.adapt, smoothing.guard) {
        _ if smoothing.iterations == 0 => "",
        (true, true) => "suits this surface",
        (true, false) => "adapted to calibre",
        (false, true) => "no crossing",
        (false, false) => "",
    };
    let volume = [(holds_volume, "volume preserved"), (!suits.is_empty(), suits)];
    let volume = volume.into_iter().filter(|(is_on, _)| *is_on).map(|(_, name)| name).collect::<Vec<_>>().join(", ");
    let decimation = &settings.decimation;
    let method = format!("{} method", decimation.method.name());
    // The method of least error has no use for it.
    let angle = match decimation.method {
        Method::Schroeder => format!("feature angle {}°", decimation.feature_angle),
        Method::Quadric => String::new(),
    };
    let spared = if decimation.spare_thin { "thin vessels spared" } else { "" };
    [band, iterations, window, volume, method, angle, spared.to_owned(), target]
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

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A number of a result: what it is, how much, and what it means.
pub(super) struct Number {
    pub(super) what: &'static str,
    pub(super) how_much: String,
    pub(super) help: &'static str,
}

/// The numbers of a result. A dash stands where there is none.
pub(super) fn numbers(report: &Report) -> [Number; 5] {
    let dash = || "–".to_owned();
    let deviation = |found: Option<crate::pipeline::deviation::Deviation>| {
        found.map_or_else(dash, |d| format!("{:.3} / {:.3}", d.mean, d.max))
    };
    let percent = |change: Option<f64>| change.map_or_else(dash, |change| format!("{change:+.2} %"));
    [
        Number { what: "Triangles", how_much: grouped(report.output.triangles), help: "After the reduction" },
        Number {
            what: "Removed",
            how_much: format!("{:.2} %", report.reduction_percent),
            help: "The part of the kept triangles that is gone",
        },
        Number {
            what: "Volume",
            how_much: percent(report.volume_change_percent),
            help: "Change from the kept pieces as opened, open ends capped",
        },
        Number {
            what: "From smoothed",
            how_much: deviation(report.deviation_mm),
            help: "Deviation from the smoothed surface in mm, mean and maximum, measured both ways",
        },
        Number {
            what: "From original",
            how_much: deviation(report.deviation_from_original_mm),
            help: "Deviation from the kept pieces as opened in mm, mean and maximum, measured both ways",
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::paper;
    use crate::pipeline::settings::Keep;

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
        assert_eq!(names, ["Pass band 0.01, 100 iterations, suits this surface, reduction 90 %"]);
        let mut spared = Settings::default();
        spared.decimation.spare_thin = true;
        let (_, names) = titles(&[&Settings::default(), &spared]);
        assert_eq!(names, ["", "Thin vessels spared"]);
        assert_eq!(titles(&[]), (String::new(), vec![]));
    }
}
