//! The verdict on what is shown, and what a click on a finding asks for.

use crate::app::action::Action;
use crate::app::document::Document;
use crate::app::state::State;
use crate::app::vessels;
use crate::engine::Source;
use crate::language::tell;
use crate::pipeline::connectivity::LeftOut;
use crate::pipeline::verdict::{Finding, FindingKind, Known, Remedied, Remedy, Rest, Verdict, takes_more};

/// Height of what is seen around a place, in widths of the vessel there.
const SEEN: f64 = 8.0;

/// The verdict on what is shown of `document`, the surface of `state`.
pub(in crate::app) fn verdict(state: &State, document: &Document) -> Verdict {
    let measured = document.measured.as_ref().filter(|measured| measured.generation == state.generation());
    let known = Known {
        settings: &state.settings,
        import: &document.import,
        // Samples and scans are in mm.
        has_units: matches!(document.source, Source::File { .. }),
        report: measured.map(|measured| &measured.report),
        shortfall: document
            .shown
            .as_ref()
            .and_then(|shown| shown.level.shortfall.as_ref())
            .filter(|_| measured.is_some()),
        // As the reduction moves, a pinch is known in the same frame; the rest follows.
        pinch: document.pinch(),
        calibre: state.calibre().map(|calibre| &calibre.found),
        safe_percent: safe_percent(state, document),
        left_out: LeftOut::of(&document.pieces.list, state.settings.keep),
        faults: document.faults.as_ref().map(|found| (&found.counts, &found.places[..])),
        rest: if state.is_measuring() { Rest::Coming } else { Rest::Stopped },
    };
    let verdict = Verdict::new(&known);
    if verdict.is_safe == Some(false) && state.is_deciding() {
        // What is wrong with a level that a finer one may follow is not said.
        return Verdict::new(&Known { report: None, shortfall: None, pinch: None, calibre: None, ..known });
    }
    verdict
}

/// The highest rate that is safe, where more is taken away.
fn safe_percent(state: &State, document: &Document) -> Option<f64> {
    let percent = state.safe()?.percent?;
    let entering = document.levels.as_ref()?.1.triangles.len();
    let shown = document.shown.as_ref()?.level.triangles.len();
    takes_more(shown, percent, entering).then_some(percent)
}

/// What goes to the place of a finding.
pub(super) fn look(state: &State, finding: &Finding) -> Option<Action> {
    if let FindingKind::Narrower { name, .. } = &finding.what {
        let found = state.calibre().and_then(|calibre| calibre.found.as_ref().ok());
        let branch = found.and_then(|found| found.branches.iter().find(|branch| branch.label() == *name));
        if let Some(branch) = branch {
            return Some(Action::Vessels(vessels::Action::ShowNarrowing(branch.number)));
        }
    }
    let place = finding.place.as_ref()?;
    let height_mm = (SEEN * place.width_mm).max(1.0) as f32;
    Some(Action::GoTo { at_mm: place.at_mm, height_mm, label: tell(&place.label) })
}

/// What takes a remedy.
pub(super) fn take(remedy: &Remedy) -> Action {
    match &remedy.change {
        Remedied::Settings(settings) => Action::Set(settings.clone()),
        Remedied::Unit(unit) => Action::ReadIn(*unit),
    }
}
