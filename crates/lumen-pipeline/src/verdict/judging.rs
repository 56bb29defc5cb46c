//! What of a result is to be said, and how much it weighs.

use super::super::connectivity::LeftOut;
use super::super::pinch::Pinch;
use super::super::progressive::Shortfall;
use super::super::report::Report;
use super::super::run::Pipeline;
use super::super::settings::{Keep, Mending, Preset, Settings, Smoothing, Target};
use super::super::shape::Shape;
use super::finding::{Finding, FindingKind, Head, PlaceLabel, Remedied, Remedy, RemedyLabel, Verdict};
use lumen_io::{ImportReport, Unit, UnusualSize, Warning};
use lumen_mesh::mending::{FaultCounts, FaultKind, FaultPlace};
use lumen_vessel::certificate::{BranchCalibre, CalibreError, Certificate, Verdict as Calibre};
use lumen_vessel::summary::{in_order, place, summary};

/// The change of an inlet's or outlet's area that is allowed, in percent: it is the boundary condition of a flow.
const AREA_PERCENT: f64 = 0.5;

/// What becomes of that which is not known of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rest {
    /// It is on its way.
    Coming,
    /// It was, and is no longer.
    Stopped,
    /// Nobody has asked for it.
    NotAsked,
}

/// What is known of a result, from which the verdict follows.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// The settings in force.
    pub settings: &'a Settings,
    /// What was found when the surface was opened.
    pub import: &'a ImportReport,
    /// Whether it can be read in another unit: samples and scans are in mm.
    pub has_units: bool,
    /// The numbers, if they are those of the settings.
    pub report: Option<&'a Report>,
    /// Why the target was not met, if it was not.
    pub shortfall: Option<&'a Shortfall>,
    /// The vessel that is pinched or lost, if one is: it may be known before the numbers.
    pub pinch: Option<&'a Pinch>,
    /// What became of the vessels, or why there are none.
    pub calibre: Option<&'a Result<Certificate, CalibreError>>,
    /// The highest rate that is safe, in percent, where more is taken away.
    pub safe_percent: Option<f64>,
    /// What is left out of the surface, where that is much.
    pub left_out: Option<LeftOut>,
    /// What is wrong with the file, and where, if that is known.
    pub faults: Option<(&'a FaultCounts, &'a [FaultPlace])>,
    /// What becomes of that which is not known.
    pub rest: Rest,
}

impl Verdict {
    /// On what is known.
    pub fn new(known: &Known<'_>) -> Self {
        let mut findings = Vec::new();
        let unusual = known.import.unusual_size();
        let is_wall = known.faults.is_some_and(|(counts, _)| counts.wall.is_some());
        let of_vessels = unusual.as_ref().filter(|found| !(is_wall && matches!(found, UnusualSize::Calibre { .. })));
        findings.extend(of_vessels.map(|found| size(known, found)));
        // What is measured of a wall says nothing of vessels.
        findings.extend(faults(known));
        findings.extend(left_out(known));
        findings.extend(pinch(known));
        if let Some(report) = known.report {
            findings.extend(of_report(known, report));
        }
        findings.extend(calibre(known));
        findings.extend(uneven(known));
        let of_file = known.import.warnings.iter().filter(|warning| !matches!(warning, Warning::Size(_)));
        findings.extend(
            of_file
                .map(|warning| Finding { is_grave: *warning == Warning::NoInside, ..Finding::note(warning.clone()) }),
        );
        findings.sort_by_key(|finding| !finding.is_grave);
        // Nothing is said twice, and what is grave stays.
        let mut said: Vec<FindingKind> = Vec::new();
        findings.retain(|finding| {
            let is_new = !said.contains(&finding.what);
            said.push(finding.what.clone());
            is_new
        });
        let grave = findings.iter().filter(|finding| finding.is_grave).count();
        let certificate = known.calibre.and_then(|found| found.as_ref().ok());
        let coverage = certificate.map(|found| found.coverage);
        let is_known = known.report.is_some() && known.calibre.is_some();
        let is_kept = certificate.is_some_and(|found| found.verdict == Calibre::Kept);
        let is_covered = coverage.is_some_and(|found| found.is_enough());
        let head = match grave {
            0 if is_known && is_kept && is_covered => Head::Safe,
            0 if is_known && is_kept => Head::KeptWhereMeasured,
            0 if is_known || known.rest == Rest::NotAsked => Head::NoneMeasured,
            0 if known.rest == Rest::Stopped => Head::NotMeasured,
            0 => Head::Coming,
            count => Head::ToLookAt { count },
        };
        let is_safe = match head {
            Head::Safe => Some(true),
            Head::ToLookAt { .. } => Some(false),
            _ => None,
        };
        Self { head, is_safe, coverage, calibre: known.calibre.map(summary), findings }
    }

    /// On a run that is over: `report` is of what `pipeline` has made.
    pub fn of_run(pipeline: &Pipeline, report: &Report, import: &ImportReport, has_units: bool) -> Self {
        let found = pipeline.certified().map(|found| match found {
            Ok(found) => Ok(found.certificate.clone()),
            Err(why) => Err(why.clone()),
        });
        let entering = report.after_connectivity.triangles;
        // A coarser level may open a vessel again.
        let is_open = report.narrowing.is_some_and(|found| found.pinched_places == 0);
        let pinch = report.pinch.as_ref().filter(|pinch| !is_open && report.output.triangles <= pinch.triangles);
        Self::new(&Known {
            settings: &report.settings,
            import,
            has_units,
            report: Some(report),
            shortfall: pipeline.reduced().and_then(|reduced| reduced.level.shortfall.as_ref()),
            pinch,
            calibre: found.as_ref(),
            safe_percent: report
                .safe
                .as_ref()
                .and_then(|safe| safe.percent)
                .filter(|&percent| takes_more(report.output.triangles, percent, entering)),
            left_out: pipeline.connectivity().and_then(|found| LeftOut::of(&found.components, report.settings.keep)),
            faults: None,
            rest: Rest::NotAsked,
        })
    }
}

/// Whether a level of so many triangles takes more away from the `entering` than a rate in percent: it may have one fewer than
/// its rate.
pub fn takes_more(triangles: usize, percent: f64, entering: usize) -> bool {
    triangles + 1 < rate(percent).triangles(entering)
}

/// The target of a rate in percent, to a tenth.
pub fn rate(percent: f64) -> Target {
    Target::Reduction((percent * 10.0).round() as u32)
}

/// Other settings for a remedy, if they are others.
fn remedy(known: &Known<'_>, label: RemedyLabel, change: impl FnOnce(&mut Settings)) -> Option<Remedy> {
    let mut settings = known.settings.clone();
    change(&mut settings);
    let is_other = settings != *known.settings;
    is_other.then(|| Remedy { label, change: Remedied::Settings(Box::new(settings)) })
}

/// The smoothing that suits the surface, where another is set.
fn suit(known: &Known<'_>) -> Option<Remedy> {
    remedy(known, RemedyLabel::Smoothing(Preset::Auto), |settings| {
        let preserve_volume = settings.smoothing.preserve_volume;
        settings.smoothing = Smoothing { preserve_volume, ..Preset::Auto.smoothing() };
    })
}

/// The highest rate that is safe, where more is taken away.
fn less(known: &Known<'_>) -> Option<Remedy> {
    let percent = known.safe_percent?;
    remedy(known, RemedyLabel::ReduceTo { percent }, |settings| settings.target = rate(percent))
}

fn size(known: &Known<'_>, found: &UnusualSize) -> Finding {
    let finding = if matches!(found, UnusualSize::Small { .. }) { Finding::note } else { Finding::grave };
    let mut finding = finding(found.clone());
    if known.has_units {
        let read = |&unit: &Unit| Remedy { label: RemedyLabel::ReadIn { unit }, change: Remedied::Unit(unit) };
        finding.remedies = found.units().iter().map(read).collect();
    }
    finding
}

/// What is wrong with the file and not mended under these settings.
fn faults(known: &Known<'_>) -> Vec<Finding> {
    let Some((counts, places)) = known.faults else { return Vec::new() };
    let asked = known.settings.mending;
    let helped = |label: RemedyLabel, change: &dyn Fn(&mut Mending)| {
        let mut mending = asked;
        change(&mut mending);
        let is_other = mending != asked;
        remedy(known, label, |settings| {
            settings.mending = mending;
            // A piece that is kept by its number may be another one then.
            settings.keep = settings.keep.without_numbers();
        })
        .filter(|_| is_other)
    };
    let mut findings = Vec::new();
    if let Some(wall) = counts.wall.filter(|_| !asked.lumen) {
        let lumen = helped(RemedyLabel::TakeLumen, &|asked| asked.lumen = true);
        findings.push(Finding::grave(FindingKind::Wall { thickness: wall.thickness_mm }).helped_by(lumen));
    }
    let of = |kind| places.iter().find(move |place| place.kind == kind);
    let largest = counts.largest_hole_mm.filter(|&mm| asked.fill_mm.is_none_or(|limit| limit < mm));
    if let Some((mm, place)) = largest.zip(of(FaultKind::Hole)) {
        let what = FindingKind::Holes { count: counts.holes, diameter: mm };
        let fill = helped(RemedyLabel::Fill, &|asked| asked.fill_mm = Some(Mending::filling(mm)));
        findings.push(Finding::note(what).at(place.at_mm, mm, PlaceLabel::Hole).helped_by(fill));
    }
    let crowded = counts.non_manifold_edges + counts.non_manifold_vertices;
    if crowded > 0 && !asked.split {
        let split = helped(RemedyLabel::Split, &|asked| asked.split = true);
        let finding = Finding::note(FindingKind::Crowded { count: crowded }).helped_by(split);
        findings.push(match of(FaultKind::Edge).or_else(|| of(FaultKind::Vertex)) {
            Some(place) => finding.at(place.at_mm, f64::from(place.size_mm), PlaceLabel::Here),
            None => finding,
        });
    }
    findings
}

fn left_out(known: &Known<'_>) -> Option<Finding> {
    let LeftOut { percent, pieces } = known.left_out?;
    let all = remedy(known, RemedyLabel::AllPieces, |settings| settings.keep = Keep::All);
    Some(Finding::grave(FindingKind::LeftOut { percent, pieces }).helped_by(all))
}

fn pinch(known: &Known<'_>) -> Option<Finding> {
    let Some(pinch) = known.pinch else {
        let what = known.report.and_then(Report::pinch_warning)?;
        let found = known.report?.narrowing?;
        let finding = Finding::grave(what).at(found.at_mm, found.diameter_before_mm, PlaceLabel::Narrowed);
        return Some(finding.helped_by(less(known)));
    };
    let (before, percent) = (pinch.diameter_before_mm, pinch.from_percent);
    let (what, label) = if pinch.diameter_after_mm > 0.0 {
        (FindingKind::PinchedFirst { before, percent }, PlaceLabel::Pinched)
    } else {
        (FindingKind::LostFirst { before, percent }, PlaceLabel::Lost)
    };
    let finding = Finding::grave(what).at(pinch.at_mm, pinch.diameter_before_mm, label);
    Some(finding.helped_by(less(known)))
}

fn of_report(known: &Known<'_>, report: &Report) -> Vec<Finding> {
    let mut findings = Vec::new();
    if let Some(what) = report.smoothing_warning() {
        let lumen = report.smoothed_shape.as_ref().and_then(|shape| shape.smallest_lumen);
        let finding = Finding::grave(what).helped_by(suit(known));
        findings.push(match lumen {
            Some(lumen) => finding.at(lumen.at_mm, lumen.diameter_mm, PlaceLabel::Shut),
            None => finding,
        });
    }
    let crossing = |shape: &Option<Shape>| shape.as_ref().map_or(0, |shape| shape.self_intersecting_faces);
    let (now, before) = (crossing(&report.output_shape), crossing(&report.smoothed_shape));
    if now > 0 {
        let what = match before {
            0 => FindingKind::Crossing { count: now },
            _ => FindingKind::CrossingBefore { count: now, before },
        };
        let guard = remedy(known, RemedyLabel::NoCrossings, |settings| settings.smoothing.guard = true);
        findings.push(Finding::grave(what).helped_by(guard));
    }
    findings.extend(caps(known, report));
    findings.extend(report.volume_warning().map(|what| Finding::grave(what).helped_by(suit(known))));
    findings.extend(report.mending_warnings().into_iter().map(Finding::note));
    findings.extend(known.shortfall.map(|shortfall| Finding::note(shortfall.message())));
    if report.pass_band_missed {
        findings.push(Finding::note(FindingKind::FewIterations));
    }
    if report.settings.smoothing.iterations == 0 {
        findings.push(Finding::note(FindingKind::NotSmoothed).helped_by(suit(known)));
    }
    findings.extend(report.volume_held_warning().map(Finding::note));
    findings
}

/// The flat caps that change their areas by more than [`AREA_PERCENT`].
fn caps(known: &Known<'_>, report: &Report) -> Option<Finding> {
    let caps = || report.caps.iter().flatten();
    let is_rounded = caps().any(|cap| !cap.is_flat());
    let changed = caps().filter(|cap| cap.change_percent().abs() > AREA_PERCENT && cap.is_flat() != is_rounded);
    let count = changed.clone().count();
    let worst = changed.reduce(|a, b| if b.change_percent().abs() > a.change_percent().abs() { b } else { a })?;
    let percent = worst.change_percent();
    let hold = remedy(known, RemedyLabel::HoldCaps, |settings| settings.smoothing.hold_caps = true);
    let (what, label) = if worst.is_flat() {
        (FindingKind::Caps { count, percent }, PlaceLabel::Cap { percent })
    } else {
        (FindingKind::CapsRounded { count }, PlaceLabel::Rounded)
    };
    Some(Finding::grave(what).helped_by(hold).at(worst.centre, worst.diameter_mm(), label))
}

fn calibre(known: &Known<'_>) -> Option<Finding> {
    let found = known.calibre?;
    let certificate = found.as_ref().ok().filter(|found| found.verdict == Calibre::Changed)?;
    let worst = in_order(certificate).into_iter().next()?;
    let by_smoothing = certificate.branches.iter().any(|branch| branch.verdict_smoothed == Calibre::Changed);
    let help = if by_smoothing { suit(known) } else { None };
    let finding = Finding::grave(summary(found));
    let finding = match worst.reduced.largest_change {
        Some(change) => finding.at(change.at_mm, width(worst, change.abscissa_mm), place(worst, &change)),
        None => finding,
    };
    Some(finding.helped_by(help.or_else(|| less(known))))
}

/// The stretches that are most narrower and most wider than on either side, as opened.
fn uneven(known: &Known<'_>) -> Vec<Finding> {
    let Some(Ok(certificate)) = known.calibre else { return Vec::new() };
    let most = |side: usize| {
        let each = certificate.branches.iter().filter_map(|branch| Some((branch.label(), branch.uneven()[side]?)));
        each.reduce(|most, next| if next.1.degree_percent > most.1.degree_percent { next } else { most })
    };
    let narrower = most(0).map(|(name, found)| {
        let (percent, length, reference) = (found.degree_percent, found.length_mm, found.reference());
        let what = FindingKind::Narrower { name, percent, length, reference };
        Finding::note(what).at(found.at_mm, found.diameter_mm, PlaceLabel::Narrower { percent })
    });
    let wider = most(1).map(|(name, found)| {
        let (percent, length, reference) = (found.degree_percent, found.length_mm, found.reference());
        let what = FindingKind::Wider { name, percent, length, reference };
        Finding::note(what).at(found.at_mm, found.diameter_mm, PlaceLabel::Wider { percent })
    });
    narrower.into_iter().chain(wider).collect()
}

/// How wide a branch is at a place, in mm.
fn width(branch: &BranchCalibre, abscissa_mm: f64) -> f64 {
    let i = branch.abscissas_mm.partition_point(|&at| f64::from(at) < abscissa_mm);
    let radius = branch.opened.inscribed_radii_mm.get(i).copied().flatten();
    2.0 * f64::from(radius.unwrap_or(1.0).max(0.1))
}
