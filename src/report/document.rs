//! What stands in a report, as plain data, whatever it is written as.

use std::cmp::Reverse;

use serde::{Deserialize, Serialize};

use super::picture::Picture;
use super::plot::{Plot, radius, response};
use super::viewer::Carried;
use super::words::{others, said};
use crate::io::{Axes, ImportReport, ThresholdReport};
use crate::language::{decimal, exact, grouped, inner, signed, tell};
use crate::pipeline::caps::changes_percent;
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Keep, Preset, Settings, Target};
use crate::pipeline::verdict::{FindingKind, Verdict};
use crate::prepare::{Patch, PatchKind};
use crate::say;
use crate::sharing::Digest;
use crate::sharing::measures::Measure;
use crate::vessel::certificate::{BranchCalibre, OnSurface, Verdict as Calibre};
use crate::vessel::variation::{Kind as VariationKind, Variation};

/// Vessels whose radius is drawn: those that are narrower or wider somewhere, or change most.
const DRAWN: usize = 3;

/// What stands at the head of a report. It goes into the report alone: no settings, no link and nothing that is kept on
/// the device has it, for it may name a patient.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Heading {
    /// What the report is called: a name that the user has chosen, for names of files and scans can be those of patients.
    pub title: Option<String>,
    /// The day on which it is made, as ISO 8601 writes it.
    pub date: String,
    /// Which case it is of; empty for none.
    pub case: String,
    /// What else is to be said, in lines; empty for nothing.
    pub comment: String,
}

impl Heading {
    /// What is known of it, row by row.
    fn rows(&self) -> Vec<Row> {
        let rows = [
            (say!("report-date"), &self.date),
            (say!("report-case"), &self.case),
            (say!("report-comment"), &self.comment),
        ];
        let said = rows.into_iter().map(|(name, value)| (name, value.trim().to_owned()));
        said.filter(|(_, value)| !value.is_empty()).collect()
    }
}

/// What a report is made from.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// What stands at its head.
    pub heading: &'a Heading,
    /// By what the file is known; none of a sample or a scan.
    pub digest: Option<Digest>,
    /// What was found when it was opened.
    pub import: &'a ImportReport,
    /// All numbers.
    pub report: &'a Report,
    /// The verdict.
    pub verdict: &'a Verdict,
    /// What a user has measured.
    pub measures: &'a [Measure],
    /// The patches of the level that was made ready for a solver, the wall first; none where it was not.
    pub patches: &'a [Patch],
}

/// A name and what it is.
pub type Row = (String, String);

/// A table: heads, then rows of as many cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What stands in the columns.
    pub heads: Vec<String>,
    /// The cells; the first of a row is a name.
    pub rows: Vec<Vec<String>>,
}

/// A report.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// What it is called.
    pub title: String,
    /// The version of Lumen, and what it is not for.
    pub line: String,
    /// The day on which it was made, and what the user says of it.
    pub about: Vec<Row>,
    /// What the file is.
    pub file: Vec<Row>,
    /// What it was made with.
    pub settings: Vec<Row>,
    /// What came of it.
    pub numbers: Vec<Row>,
    /// The verdict in a few words.
    pub head: String,
    /// Whether a trial may rest on it, as far as that is known.
    pub is_safe: Option<bool>,
    /// What is said of the vessels, then the findings, the weightiest first.
    pub findings: Vec<String>,
    /// The calibre of the vessels.
    pub vessels: Table,
    /// Where they are narrower or wider than on either side.
    pub stretches: Table,
    /// What a user has measured.
    pub measures: Table,
    /// The patches of the level that was made ready for a solver.
    pub patches: Table,
    /// The surface itself, for a web page.
    pub surface: Option<Carried>,
    /// The surface, with a caption each; or none.
    pub pictures: Vec<Picture>,
    /// The filter, and the radii of some vessels.
    pub plots: Vec<Plot>,
}

impl Document {
    /// A report on a run that is over, with these pictures.
    pub fn new(subject: &Subject<'_>, pictures: Vec<Picture>) -> Self {
        let Subject { heading, report, verdict, .. } = *subject;
        let branches = report.branches.as_deref().unwrap_or_default();
        let mut plots: Vec<Plot> =
            response(&report.settings.smoothing, report.smoothing_response.as_ref()).into_iter().collect();
        let tolerance = report.settings.tolerance_percent;
        plots.extend(drawn(branches).into_iter().filter_map(|branch| radius(branch, tolerance)));
        let findings = verdict.findings.iter().map(|finding| {
            let at = finding.place.as_ref().map(|place| place.at_mm.map(|at| decimal(at, 1)));
            let text = tell(&finding.what);
            match at.filter(|_| !finding.what.says_where()) {
                Some([x, y, z]) => format!("{text} {}", say!("report-at", x = x, y = y, z = z)),
                None => text,
            }
        });
        // Where they change that is a finding already.
        let is_found = verdict.findings.iter().any(|finding| matches!(finding.what, FindingKind::Calibre(_)));
        let calibre = verdict.calibre.as_ref().filter(|_| !is_found).map(|calibre| tell(calibre));
        Self {
            title: heading.title.clone().unwrap_or_else(|| say!("report-title")),
            about: heading.rows(),
            line: format!("Lumen {}. {}", report.lumen, say!("report-not-clinical")),
            file: file(subject),
            settings: settings(report),
            numbers: numbers(report),
            head: tell(&verdict.head_text()),
            is_safe: verdict.is_safe,
            findings: calibre.into_iter().chain(findings).collect(),
            vessels: vessels(branches),
            stretches: stretches(branches),
            measures: measures(subject.measures),
            patches: patches(subject.patches),
            surface: None,
            pictures,
            plots,
        }
    }
}

/// A place, whose numbers are in mm.
fn point(at: [f64; 3]) -> String {
    let [x, y, z] = at.map(|number| decimal(number, 1));
    say!("report-point", x = x, y = y, z = z)
}

/// The vessels whose radius is drawn: of those that can be measured over most of their length, first what is not as it was.
fn drawn(branches: &[BranchCalibre]) -> Vec<&BranchCalibre> {
    let mut all: Vec<&BranchCalibre> = branches.iter().filter(|branch| branch.stations_counted > 0).collect();
    let key = |branch: &&BranchCalibre| {
        let is_kept = branch.verdict != Calibre::Changed;
        (branch.variations.is_empty(), is_kept, Reverse(branch.stations_counted))
    };
    all.sort_by_key(key);
    all.truncate(DRAWN);
    all
}

fn file(subject: &Subject<'_>) -> Vec<Row> {
    let Subject { digest, import, report, .. } = *subject;
    let bounds = import.bounds_mm.size();
    let opened = &report.opened;
    let fingerprint = digest.map_or_else(|| say!("report-no-fingerprint"), |digest| digest.to_string());
    let [x, y, z] = [bounds.x, bounds.y, bounds.z].map(|length| decimal(length, 1));
    let threshold = import.threshold.map(|ThresholdReport { value, lower_mm, higher_mm }| {
        let [lower, higher] = [lower_mm, higher_mm].map(|mm| signed(mm, 2));
        (say!("report-threshold"), say!("report-threshold-moves", value = exact(value), lower = lower, higher = higher))
    });
    let rows = [
        (say!("report-fingerprint"), fingerprint),
        (
            say!("report-format"),
            say!("report-format-in", format = import.format.to_string(), unit = import.unit.to_string()),
        ),
        (say!("report-opened"), say!("report-counts", triangles = opened.triangles, pieces = opened.components)),
        (say!("report-size"), say!("report-size-mm", x = x, y = y, z = z)),
        (
            say!("report-axes"),
            if report.axes == Axes::Unknown { say!("report-axes-unknown") } else { report.axes.to_string() },
        ),
    ];
    rows.into_iter().chain(threshold).collect()
}

/// What was mended, on request.
fn mending(settings: &Settings) -> String {
    const KNOWN: [&str; 4] = ["lumen", "weld", "split", "fill-holes"];
    let known = KNOWN.iter().filter_map(|key| said(key, settings));
    let parts: Vec<String> = known.chain(others("mending", &KNOWN, settings)).collect();
    if parts.is_empty() { say!("report-no-mending") } else { parts.join(", ") }
}

/// What was smoothed with.
fn filter(settings: &Settings) -> String {
    const KNOWN: [&str; 7] = ["pass-band", "iterations", "window", "adapt", "guard", "hold-caps", "preserve-volume"];
    let smoothing = &settings.smoothing;
    if smoothing.iterations == 0 {
        return say!("report-no-smoothing");
    }
    let (band, count, window) = (smoothing.pass_band, smoothing.iterations, smoothing.window.name());
    let parts = [
        Some(say!("report-filter", band = band, count = count, window = window)),
        smoothing.adapt.then(|| say!("compare-adapted")),
        smoothing.guard.then(|| say!("report-no-crossings")),
        smoothing.hold_caps.then(|| say!("compare-caps-held")),
        smoothing.preserve_volume.then(|| say!("report-volume-held")),
    ];
    let parts = parts.into_iter().flatten().chain(others("smoothing", &KNOWN, settings));
    let filter = parts.collect::<Vec<_>>().join(", ");
    match Preset::of(smoothing) {
        Some(preset) => say!("report-preset", preset = inner(&tell(&preset)), filter = filter),
        None => filter,
    }
}

/// What was reduced with.
fn method(settings: &Settings) -> String {
    const KNOWN: [&str; 4] = ["method", "feature-angle", "spare-thin", "keep-labels"];
    let parts = [settings.decimation.method.name().to_owned()].into_iter();
    let parts = parts.chain(KNOWN[1..].iter().filter_map(|key| said(key, settings)));
    parts.chain(others("decimation", &KNOWN, settings)).collect::<Vec<_>>().join(", ")
}

/// What the target auto has come to.
fn auto(report: &Report) -> String {
    let Some(found) = &report.auto else { return say!("compare-auto") };
    let percent = decimal(found.percent, 1);
    if found.is_at_most() {
        return say!("report-target-auto", percent = percent);
    }
    match &report.safe {
        Some(safe) if safe.is_covered => say!("report-target-auto-safe", percent = percent),
        Some(safe) if safe.percent.is_none() => say!("report-target-auto-pinched", percent = percent),
        _ => say!("report-target-auto-kept", percent = percent),
    }
}

fn settings(report: &Report) -> Vec<Row> {
    let settings = &report.settings;
    let keep = match settings.keep {
        Keep::Largest => say!("report-keep-largest"),
        Keep::Pieces(_) => say!("report-keep-pieces", numbers = settings.keep.to_string().replace(',', ", ")),
        Keep::Component(number) => say!("report-keep-piece", number = number.to_string()),
        Keep::All => say!("report-keep-all"),
    };
    let target = settings.target;
    let target = match target {
        Target::Auto => auto(report),
        Target::Reduction(_) => say!("report-target-reduction", percent = decimal(target.percent(1), 1)),
        Target::Triangles(count) => say!("report-target-triangles", count = count),
        Target::Deviation(_) => say!("report-target-deviation", most = exact(target.deviation_mm().unwrap_or(0.0))),
    };
    vec![
        (say!("report-keep"), keep),
        (say!("report-mending"), mending(settings)),
        (say!("report-smoothing"), filter(settings)),
        (say!("report-reduction"), target),
        (say!("report-method"), method(settings)),
        (say!("report-allowed"), format!("{} %", exact(settings.tolerance_percent))),
    ]
}

fn numbers(report: &Report) -> Vec<Row> {
    let (left, all) = (report.output.triangles, report.after_connectivity.triangles);
    let mut rows = vec![
        (say!("report-triangles"), say!("report-triangles-of", left = left, all = all)),
        (say!("report-reduction"), format!("{} %", decimal(report.reduction_percent, 1))),
    ];
    let mut add = |name: String, value: Option<String>| rows.extend(value.map(|value| (name, value)));
    let distance = |of: crate::pipeline::deviation::Deviation| {
        say!("report-distance", mean = decimal(of.mean, 4), most = decimal(of.max, 3))
    };
    let change = |percent: f64| format!("{} %", signed(percent, 2));
    add(say!("report-from-smoothed"), report.deviation_mm.map(distance));
    add(say!("report-from-opened"), report.deviation_from_original_mm.map(distance));
    add(say!("report-volume-change"), report.volume_change_percent.map(change));
    add(say!("report-area-change"), report.area_change_percent.map(change));
    add(
        say!("report-half-gain"),
        report.smoothing_response.and_then(|response| response.half_gain_message()).map(|found| tell(&found)),
    );
    let shape = report.output_shape.as_ref();
    add(say!("report-crossing"), shape.map(|shape| grouped(shape.self_intersecting_faces)));
    let caps = report.caps.as_deref().unwrap_or_default();
    let told = |[least, most]: [f64; 2]| {
        let [least, most] = [least, most].map(|percent| signed(percent, 2));
        say!("panel-caps-changed", count = caps.len(), least = least, most = most)
    };
    add(say!("report-caps"), changes_percent(caps).map(told));
    let lumen = shape.and_then(|shape| shape.smallest_lumen);
    add(say!("report-smallest-lumen"), lumen.map(|lumen| format!("{} mm", decimal(lumen.diameter_mm, 2))));
    let coverage = report.calibre.as_ref().and_then(|calibre| calibre.coverage);
    add(say!("report-measured"), coverage.map(|coverage| tell(&coverage.text())));
    add(say!("report-output-fingerprint"), Some(report.output_fingerprint.clone()));
    rows
}

fn vessels(branches: &[BranchCalibre]) -> Table {
    let none = || "–".to_owned();
    let change =
        |of: &OnSurface| of.largest_change.map_or_else(none, |found| format!("{} %", signed(found.percent, 1)));
    let row = |branch: &BranchCalibre| {
        vec![
            tell(&branch.label()),
            tell(&branch.verdict),
            format!("{} %", decimal(branch.coverage().percent().floor(), 0)),
            change(&branch.smoothed),
            change(&branch.reduced),
            branch.opened.radius_mm.map_or_else(none, |radius| tell(&radius.text())),
            decimal(branch.length_mm, 1),
            branch.tortuosity.map_or_else(none, |tortuosity| decimal(tortuosity, 2)),
        ]
    };
    let heads = vec![
        say!("vessels-column-vessel"),
        say!("report-calibre"),
        say!("vessels-column-measured"),
        say!("vessels-column-smoothed"),
        say!("vessels-column-reduced"),
        say!("report-radius"),
        say!("vessels-column-length"),
        say!("vessels-column-tortuosity"),
    ];
    Table { heads, rows: branches.iter().map(row).collect() }
}

fn stretches(branches: &[BranchCalibre]) -> Table {
    let mut each: Vec<(&BranchCalibre, &Variation)> =
        branches.iter().flat_map(|branch| branch.variations.iter().map(move |found| (branch, found))).collect();
    each.sort_by_key(|(_, found)| found.kind != VariationKind::Narrower);
    let row = |(branch, found): (&BranchCalibre, &Variation)| {
        let [diameter, reference] = [found.diameter_mm, found.reference_mm].map(|mm| decimal(mm, 2));
        vec![
            tell(&branch.label()),
            tell(&found.degree()),
            format!("{} %", decimal(found.area_percent, 0)),
            found.reduced_degree_percent.map_or("–".to_owned(), |degree| format!("{} %", decimal(degree, 0))),
            say!("report-diameter-of", diameter = diameter, reference = reference),
            found.sides.iter().flatten().map(|side| decimal(side.abscissa_mm, 1)).collect::<Vec<_>>().join("; "),
            decimal(found.length_mm, 1),
            format!("{} {}", decimal(found.abscissa_mm, 1), point(found.at_mm.map(f64::from))),
        ]
    };
    let heads = vec![
        say!("vessels-column-vessel"),
        say!("report-diameter"),
        say!("report-by-area"),
        say!("vessels-column-reduced"),
        say!("report-diameter-mm"),
        say!("report-reference-at"),
        say!("vessels-column-length"),
        say!("report-at-mm"),
    ];
    Table { heads, rows: each.into_iter().map(row).collect() }
}

fn measures(measures: &[Measure]) -> Table {
    let row = |measure: &Measure| {
        let at = measure.extent().0;
        vec![measure.name.clone(), measure.value(), measure.made(), point(at.as_dvec3().to_array())]
    };
    let heads = vec![say!("report-measure"), say!("report-found"), say!("report-made-on"), say!("report-middle")];
    Table { heads, rows: measures.iter().map(row).collect() }
}

fn patches(patches: &[Patch]) -> Table {
    let row = |patch: &Patch| {
        let is_end = patch.kind != PatchKind::Wall;
        let of_end = |text: String| if is_end { text } else { "–".to_owned() };
        vec![
            patch.name.clone(),
            patch.id.to_string(),
            decimal(patch.area_mm2, 2),
            of_end(decimal(patch.radius_mm(), 2)),
            of_end(point(patch.centre)),
            of_end(point(patch.normal)),
        ]
    };
    let heads = vec![
        say!("solver-name"),
        say!("solver-id"),
        say!("report-area"),
        say!("report-end-radius"),
        say!("report-middle"),
        say!("report-normal"),
    ];
    Table { heads, rows: patches.iter().map(row).collect() }
}
