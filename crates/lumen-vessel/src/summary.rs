//! What became of the vessels, in words.

use super::certificate::{BranchCalibre, Certificate, Change, Verdict, measured_percent};
use lumen_language::say;
use lumen_language::{decimal, signed};

/// The branches as they are listed: those that change first, the most changed before the others.
pub fn in_order(found: &Certificate) -> Vec<&BranchCalibre> {
    let mut rows: Vec<&BranchCalibre> = found.branches.iter().collect();
    let change = |branch: &BranchCalibre| {
        let change = branch.reduced.largest_change.filter(|_| branch.verdict == Verdict::Changed);
        change.map_or(0.0, |change| change.percent.abs())
    };
    rows.sort_by(|a, b| change(b).total_cmp(&change(a)));
    rows
}

/// Below this part of all vessels, in percent, a verdict is said to rest on little.
const LITTLE: f64 = 25.0;

/// What became of all of them, in a sentence or two.
pub fn sentence(found: &Result<Certificate, String>) -> String {
    let found = match found {
        Ok(found) => found,
        Err(why) => return say!("vessels-none", why = why),
    };
    let of = |verdict: Verdict| found.branches.iter().filter(move |branch| branch.verdict == verdict);
    let (kept, changed, unknown) =
        (of(Verdict::Kept).count(), of(Verdict::Changed).count(), of(Verdict::NotMeasured).count());
    let tolerance = found.tolerance_percent;
    let largest = |branch: &&BranchCalibre| branch.reduced.largest_change.map_or(0.0, |change| change.percent.abs());
    let worst = of(Verdict::Changed).max_by(|a, b| largest(a).total_cmp(&largest(b)));
    let mut text = match (kept, changed, worst.and_then(|worst| Some((worst, worst.reduced.largest_change?)))) {
        (0, 0, _) => say!("vessels-none-measured"),
        (_, 0, _) => say!("vessels-all-kept", count = kept, tolerance = tolerance),
        (_, _, Some((worst, change))) => {
            let (all, name, by) = (kept + changed, worst.label(), signed(change.percent, 1));
            say!("vessels-changed-most", changed = changed, all = all, tolerance = tolerance, name = name, by = by)
        }
        (_, _, None) => say!("vessels-changed", changed = changed, all = kept + changed, tolerance = tolerance),
    };
    if let Some(percent) = measured_percent(&found.branches).filter(|&part| part < LITTLE && kept + changed > 0) {
        text = format!("{text} {}", say!("vessels-little", percent = decimal(percent, 0)));
    }
    let by_smoothing = of(Verdict::Changed).filter(|branch| branch.verdict_smoothed == Verdict::Changed).count();
    if by_smoothing > 0 {
        text = format!("{text} {}", say!("vessels-by-smoothing", count = by_smoothing));
    }
    if unknown > 0 && kept + changed > 0 {
        text = format!("{text} {}", say!("vessels-unknown", count = unknown));
    }
    text
}

/// What a vessel of this name, which is English and kept in files, is called in the language that is spoken.
pub fn called(name: &str) -> String {
    match name.strip_prefix("branch ") {
        Some(number) => say!("vessels-branch", number = number),
        None => name.to_owned(),
    }
}

/// What there is to say of a place.
pub fn place(branch: &BranchCalibre, change: &Change) -> String {
    say!("vessels-place", name = branch.label(), percent = signed(change.percent, 1))
}

/// Made-up branches, for tests of what is said of certificates.
#[doc(hidden)]
pub mod fixtures {
    use super::*;
    use crate::certificate::{OnSurface, Spread};

    /// Branch `number`, whose calibre has changed by `percent`.
    pub fn branch(number: u32, percent: Option<f64>) -> BranchCalibre {
        let change = |percent| Change { percent, at_mm: [1.0, 2.0, 3.0], abscissa_mm: 4.0 };
        let on = |percent: Option<f64>| OnSurface { largest_change: percent.map(change), ..OnSurface::default() };
        BranchCalibre {
            number,
            name: format!("branch {number}"),
            parent: None,
            length_mm: 12.34,
            tortuosity: None,
            verdict: match percent {
                None => Verdict::NotMeasured,
                Some(percent) if percent.abs() <= 2.0 => Verdict::Kept,
                Some(_) => Verdict::Changed,
            },
            verdict_smoothed: Verdict::Kept,
            stations_counted: 0,
            abscissas_mm: Vec::new(),
            at_mm: Vec::new(),
            standings: Vec::new(),
            opened: OnSurface {
                radius_mm: Some(Spread { least: 1.0, mean: 1.5, largest: 2.0 }),
                ..OnSurface::default()
            },
            smoothed: on(Some(0.04)),
            reduced: on(percent),
            variations: Vec::new(),
        }
    }

    /// A certificate of such branches.
    pub fn certificate(percents: &[Option<f64>]) -> Result<Certificate, String> {
        let branches = (1..).zip(percents).map(|(number, &percent)| branch(number, percent)).collect();
        Ok(Certificate { tolerance_percent: 2.0, verdict: Verdict::Kept, branches })
    }
}

#[cfg(test)]
mod tests {
    use super::fixtures::certificate;
    use super::*;
    use crate::certificate::Standing;
    use lumen_language::{Language, built_in, speak};

    #[test]
    fn the_sentence_says_how_many_and_which_is_worst() {
        assert_eq!(sentence(&certificate(&[Some(0.5)])), "The vessel keeps its calibre to 2 %.");
        assert_eq!(sentence(&certificate(&[Some(0.5), Some(-2.0)])), "All 2 vessels keep their calibre to 2 %.");
        let found = certificate(&[Some(2.5), Some(-9.04), None, Some(1.0)]);
        let order: Vec<u32> = in_order(found.as_ref().unwrap()).iter().map(|branch| branch.number).collect();
        assert_eq!(order, [2, 1, 3, 4]);
        let text = sentence(&found);
        assert_eq!(
            text,
            "2 of 3 vessels change by more than 2 %, branch 2 the most: -9.0 %. \
             One is too short or too coarse to be measured."
        );
        assert_eq!(sentence(&certificate(&[None])), "No vessel can be measured.");
        assert!(sentence(&Err("the surface has no inside".to_owned())).ends_with("the surface has no inside."));
    }

    #[test]
    fn the_sentence_is_in_the_language_that_is_spoken() {
        let found = certificate(&[Some(2.5), Some(-9.04), None, Some(1.0)]);
        speak(Language::German, built_in(Language::German).unwrap());
        let (text, name) = (sentence(&found), called("branch 3"));
        speak(Language::English, &[]);
        assert!(text.contains("2 von 3") && text.contains("Ast 2: -9,0 %"), "{text}");
        assert_eq!((&*name, &*called("branch 3"), &*called("aorta")), ("Ast 3", "branch 3", "aorta"));
    }

    #[test]
    fn a_verdict_that_rests_on_little_says_so() {
        let mut found = certificate(&[Some(0.5)]).unwrap();
        found.branches[0].standings = vec![Standing::Thin; 10];
        found.branches[0].stations_counted = 2;
        assert!(sentence(&Ok(found.clone())).contains("That is said of 20 % of their length"));
        found.branches[0].stations_counted = 3;
        assert_eq!(sentence(&Ok(found)), "The vessel keeps its calibre to 2 %.");
    }
}
