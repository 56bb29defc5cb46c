//! What there is to say of a result, the weightiest first.

use crate::app::action::Action;
use crate::app::document::Document;
use crate::app::state::State;
use crate::app::vessels::{go_to, in_order, sentence};
use crate::digits::grouped;
use crate::engine::Source;
use crate::io::{NO_INSIDE, Unit, UnusualSize};
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Preset, Settings, Smoothing, Target};
use crate::vessel::certificate::Verdict as Calibre;

/// Height of what is seen around a place, in widths of the vessel there.
const SEEN: f64 = 8.0;

/// Something to say of a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finding {
    /// One or two sentences.
    pub(super) text: String,
    /// Whether a trial had better not rest on the result; else it is a note.
    pub(super) is_grave: bool,
    /// Goes to where it is.
    pub(super) place: Option<Action>,
    /// What would help, each with the words of its button.
    pub(super) remedies: Vec<(String, Action)>,
}

impl Finding {
    fn grave(text: String) -> Self {
        Self { text, is_grave: true, place: None, remedies: Vec::new() }
    }

    fn note(text: String) -> Self {
        Self { is_grave: false, ..Self::grave(text) }
    }

    fn at(self, at_mm: [f32; 3], wide_mm: f64, label: &str) -> Self {
        let height_mm = (SEEN * wide_mm).max(1.0) as f32;
        Self { place: Some(Action::GoTo { at_mm, height_mm, label: label.to_owned() }), ..self }
    }

    fn helped_by(mut self, remedy: Option<(String, Action)>) -> Self {
        self.remedies.extend(remedy);
        self
    }
}

/// What is known of a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Verdict {
    /// In a few words.
    pub(super) head: String,
    /// Grave ones first, in the order of their weight.
    pub(super) findings: Vec<Finding>,
    /// What is said of the vessels where no finding is grave.
    pub(super) calibre: Option<String>,
    /// Whether a trial may rest on it; `None` while that is not known.
    pub(super) is_safe: Option<bool>,
}

impl Verdict {
    /// On what is shown of `document`, the surface of `state`.
    pub(super) fn new(state: &State, document: &Document) -> Self {
        let mut findings = Vec::new();
        let unusual = document.import.unusual_size();
        findings.extend(unusual.as_ref().map(|found| size(document, found)));
        let measured = document.measured.as_ref();
        let is_current = measured.is_some_and(|measured| measured.generation == state.generation());
        // As the reduction moves, a pinch is known in the same frame; the rest follows.
        findings.extend(pinch(state, document));
        if let Some(measured) = measured.filter(|_| is_current) {
            findings.extend(of_report(state, &measured.report));
        }
        let found = state.calibre().map(|calibre| &calibre.found);
        findings.extend(calibre(state));
        let of_file = document.import.warnings.iter();
        let of_file = of_file.filter(|text| unusual.as_ref().is_none_or(|found| found.sentence != **text));
        findings.extend(of_file.map(|text| Finding { is_grave: text == NO_INSIDE, ..Finding::note(text.clone()) }));
        findings.sort_by_key(|finding| !finding.is_grave);
        let grave = findings.iter().filter(|finding| finding.is_grave).count();
        let is_known = is_current && found.is_some();
        let is_measured = matches!(found, Some(Ok(found)) if found.verdict == Calibre::Kept);
        let head = match (grave, is_known) {
            (0, false) => "Being measured...".to_owned(),
            (0, true) if is_measured => "Safe to simulate on".to_owned(),
            (0, true) => "Nothing wrong was found".to_owned(),
            (1, _) => "One thing to look at".to_owned(),
            (many, _) => format!("{many} things to look at"),
        };
        let is_safe = if grave > 0 { Some(false) } else { is_known.then_some(is_measured) };
        Self { head, findings, calibre: found.map(sentence), is_safe }
    }
}

/// Other settings for a remedy, if they are others.
fn remedy(state: &State, words: &str, change: impl FnOnce(&mut Settings)) -> Option<(String, Action)> {
    let mut settings = state.settings.clone();
    change(&mut settings);
    (settings != state.settings).then(|| (words.to_owned(), Action::Set(Box::new(settings))))
}

/// The smoothing that suits the surface, where another is set.
fn suit(state: &State) -> Option<(String, Action)> {
    remedy(state, Preset::Auto.label(), |settings| {
        let preserve_volume = settings.smoothing.preserve_volume;
        settings.smoothing = Smoothing { preserve_volume, ..Preset::Auto.smoothing() };
    })
}

/// The highest rate that is safe, where more is taken away.
fn less(state: &State, document: &Document) -> Option<(String, Action)> {
    let percent = state.safe()?.percent?;
    let entering = document.levels.as_ref()?.1.triangles.len();
    let per_mille = (percent * 10.0).round() as u32;
    let is_more = document.shown.as_ref()?.level.triangles.len() < Target::Reduction(per_mille).triangles(entering);
    let words = format!("Reduce to {percent:.1} %");
    remedy(state, &words, |settings| settings.target = Target::Reduction(per_mille)).filter(|_| is_more)
}

fn size(document: &Document, found: &UnusualSize) -> Finding {
    let mut finding = Finding::grave(found.sentence.clone());
    // Samples and scans are in mm.
    if matches!(document.source, Source::File { .. }) {
        let read = |&unit: &Unit| (format!("Read in {unit}"), Action::ReadIn(unit));
        finding.remedies = found.units.iter().map(read).collect();
    }
    finding
}

fn pinch(state: &State, document: &Document) -> Option<Finding> {
    let pinch = document.pinch()?;
    let fate = if pinch.diameter_after_mm > 0.0 { "pinched" } else { "lost" };
    let text =
        format!("A vessel of {:.1} mm is {fate}, first at {:.1} %.", pinch.diameter_before_mm, pinch.from_percent);
    let finding = Finding::grave(text).at(pinch.at_mm, pinch.diameter_before_mm, fate);
    Some(finding.helped_by(less(state, document)))
}

fn of_report(state: &State, report: &Report) -> Vec<Finding> {
    let mut findings = Vec::new();
    if let Some(text) = report.smoothing_warning() {
        let lumen = report.smoothed_shape.as_ref().and_then(|shape| shape.smallest_lumen);
        let finding = Finding::grave(text).helped_by(suit(state));
        findings.push(match lumen {
            Some(lumen) => finding.at(lumen.at_mm, lumen.diameter_mm, "Drawn shut"),
            None => finding,
        });
    }
    let crossing =
        |shape: &Option<crate::pipeline::shape::Shape>| shape.as_ref().map_or(0, |shape| shape.self_intersecting_faces);
    let (now, before) = (crossing(&report.output_shape), crossing(&report.smoothed_shape));
    if now > 0 {
        let text = match before {
            0 => format!("{} triangles run into others.", grouped(now)),
            _ => format!("{} triangles run into others; {} did before the reduction.", grouped(now), grouped(before)),
        };
        let guard = remedy(state, "No crossings", |settings| settings.smoothing.guard = true);
        findings.push(Finding::grave(text).helped_by(guard));
    }
    findings.extend(report.volume_warning().map(|text| Finding::grave(text).helped_by(suit(state))));
    if report.pass_band_missed {
        findings.push(Finding::note("Too few iterations for this pass band: more are needed to smooth.".to_owned()));
    }
    findings.extend(report.volume_held_warning().map(Finding::note));
    findings
}

fn calibre(state: &State) -> Option<Finding> {
    let document = state.document.as_ref()?;
    let found = &state.calibre()?.found;
    let certificate = found.as_ref().ok().filter(|found| found.verdict == Calibre::Changed)?;
    let worst = in_order(certificate).into_iter().next()?;
    let by_smoothing = certificate.branches.iter().any(|branch| branch.verdict_smoothed == Calibre::Changed);
    let help = if by_smoothing { suit(state) } else { None };
    let place = worst.reduced.largest_change.map(|change| go_to(worst, &change));
    let finding = Finding { place, ..Finding::grave(sentence(found)) };
    Some(finding.helped_by(help.or_else(|| less(state, document))))
}
