//! What a run came to, as numbers, for programs. The names of the fields are public and stay; its sentences are English.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::caps::CapArea;
use super::deviation::Deviation;
use super::pinch::Pinch;
use super::progressive::Shortfall;
use super::response::SmoothingResponse;
use super::results::{Adapted, StageTimes, Weakened};
use super::run::Pipeline;
use super::safe::{BranchSafe, NoSafeRate, Safe, Stop};
use super::settings::{Settings, Target, reduction_percent};
use super::shape::Shape;
use super::verdict::VerdictReport;
use lumen_io::{Axes, ThresholdReport, Unit};
use lumen_mesh::arrays::infos;
use lumen_mesh::mending::{FaultCounts, MendReport};
use lumen_mesh::{ArrayInfo, Measures, TriMesh, components};
use lumen_vessel::certificate::{BranchCalibre, CalibreError, Coverage, Verdict};
use lumen_vessel::width::Narrowing;

/// What stands in every report.
pub const DISCLAIMER: &str = "Not for clinical decisions.";

/// Size of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Vertices in use.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Connected pieces.
    pub components: usize,
}

impl Counts {
    /// Counts `mesh`, all of whose vertices are in use.
    pub fn of(mesh: &TriMesh) -> Self {
        let components = components(mesh.positions.len(), &mesh.triangles).count();
        Self { vertices: mesh.positions.len(), triangles: mesh.triangles.len(), components }
    }
}

/// In which unit a file was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct UnitReport {
    /// The unit of the file's numbers.
    pub unit: Unit,
    /// Whether it was taken because the surface would be of an unusual size in the one that the format says.
    pub by_size: bool,
}

/// What a bound on the deviation led to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundReport {
    /// The bound that was asked for: no point of the output is farther from the smoothed surface, nor the other way.
    pub max_deviation_mm: f64,
    /// Steps from the smoothed surface to the output.
    pub steps: u32,
    /// A distance that was found between the next coarser level and the smoothed surface: more than the bound, or less
    /// by no more than a thousandth part; null where there is no coarser level.
    pub next_coarser_mm: Option<f64>,
}

/// What the target auto has come to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AutoReport {
    /// The rate in percent: 90, or the highest that is safe where that is less.
    pub percent: f64,
    /// Steps from the smoothed surface to the output.
    pub steps: u32,
    /// Whether it is known how far is safe; before it is, the rate is 90 or that of the settings before.
    pub is_decided: bool,
}

impl AutoReport {
    /// Whether it goes as far as it may; else as far as is safe.
    pub fn is_at_most(&self) -> bool {
        self.percent >= f64::from(Target::AUTO_PER_MILLE) / 10.0
    }
}

/// Where the filter was weakened, in numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WeakenedReport {
    /// Triangles that the filter alone would have made cross.
    pub triangles_spared: usize,
    /// Vertices that were put back, in part or whole.
    pub vertices: usize,
    /// The first of those that were put back farthest, in mm.
    #[serde(default)]
    pub at_mm: [f32; 3],
}

impl WeakenedReport {
    fn new(weakened: &Weakened, smoothed: &TriMesh) -> Self {
        let parts = weakened.parts.iter().copied().enumerate();
        let most = parts.reduce(|most, next| if next.1 > most.1 { next } else { most });
        Self {
            triangles_spared: weakened.spared,
            vertices: weakened.parts.iter().filter(|&&part| part > 0.0).count(),
            at_mm: most.map_or([0.0; 3], |(vertex, _)| smoothed.positions[vertex].to_array()),
        }
    }
}

/// What the pipeline made of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// "Not for clinical decisions."
    pub disclaimer: String,
    /// The version of Lumen.
    pub lumen: String,
    /// The name of the file or sample.
    pub input: String,
    /// The surface as opened: all pieces.
    pub opened: Counts,
    /// What connectivity kept.
    pub after_connectivity: Counts,
    /// What was written or is shown.
    pub output: Counts,
    /// Sixteen hexadecimal digits that differ where outputs do.
    #[serde(default)]
    pub output_fingerprint: String,
    /// What the output's coordinates grow towards, as far as that is known; set by whoever writes it.
    #[serde(default)]
    pub axes: Axes,
    /// The unit that the numbers of the file were taken in; set by whoever read it, null of what is no file.
    #[serde(default)]
    pub unit: Option<UnitReport>,
    /// How the surface hangs on the threshold that it was made by; set by whoever read it, null of what was not made of a scan
    /// by one.
    #[serde(default)]
    pub threshold: Option<ThresholdReport>,
    /// The settings that were used.
    pub settings: Settings,
    /// What was mended before connectivity; null where nothing was asked for.
    #[serde(default)]
    pub mending: Option<MendReport>,
    /// What is wrong with the surface as it was opened; null where that was not asked for.
    #[serde(default)]
    pub faults: Option<FaultCounts>,
    /// The part of the triangles after connectivity that is gone, in percent.
    pub reduction_percent: f64,
    /// Why the target was not met; null where it was.
    pub shortfall: Option<String>,
    /// What the bound on the deviation led to; null for another target.
    #[serde(default)]
    pub bound: Option<BoundReport>,
    /// What auto came to; null for another target.
    #[serde(default)]
    pub auto: Option<AutoReport>,
    /// With so few iterations the filter either misses its pass band by more than 1e-3 or lets everything through.
    pub pass_band_missed: bool,
    /// Where the filter cuts, and which waves on this surface that means; null where smoothing was skipped.
    #[serde(default)]
    pub smoothing_response: Option<SmoothingResponse>,
    /// Whether smoothing held the volume to 0.01 %; null where that was not asked for. Where it did not, the surface is
    /// smoothed as if it had not been asked for.
    #[serde(default)]
    pub volume_held: Option<bool>,
    /// What adapting to the calibre came to; null where no vessel asked for a wider pass band, or was not asked.
    #[serde(default)]
    pub smoothing_adapted: Option<Adapted>,
    /// Where the filter was weakened, so that no triangles cross; null where it was nowhere.
    #[serde(default)]
    pub smoothing_weakened: Option<WeakenedReport>,
    /// Milliseconds a stage.
    pub stages_ms: StageTimes,
    /// Two-sided distance between output and smoothed surface; null where one has no area.
    pub deviation_mm: Option<Deviation>,
    /// Two-sided distance between output and the surface after connectivity.
    pub deviation_from_original_mm: Option<Deviation>,
    /// Change of volume from the surface after connectivity to the output, open ends capped by a fan to each loop's
    /// centroid; null where a surface cannot be oriented.
    pub volume_change_percent: Option<f64>,
    /// Change of area from the surface after connectivity to the output.
    pub area_change_percent: Option<f64>,
    /// As `volume_change_percent`, from the smoothed surface.
    pub volume_change_from_smoothed_percent: Option<f64>,
    /// As `area_change_percent`, from the smoothed surface.
    pub area_change_from_smoothed_percent: Option<f64>,
    /// The arrays of the output; null until they are carried to it.
    #[serde(default)]
    pub arrays: Option<Vec<ArrayInfo>>,
    /// Shape of the smoothed surface; null until it is measured.
    pub smoothed_shape: Option<Shape>,
    /// Shape of the output.
    pub output_shape: Option<Shape>,
    /// Where the output has narrowed a vessel of the smoothed surface most; null where there is none.
    pub narrowing: Option<Narrowing>,
    /// The area of each flat cap (an inlet or outlet of a closed model) before and after; null until it is measured, empty
    /// where there is none.
    #[serde(default)]
    pub caps: Option<Vec<CapArea>>,
    /// The first reduction rate, of all, at which a vessel is pinched or lost; null where there is none.
    pub pinch: Option<Pinch>,
    /// How far a reduction is safe; null where that was not asked for, and until it is known.
    #[serde(default)]
    pub safe: Option<SafeReport>,
    /// Whether the vessels keep their calibre; null where that was not asked for.
    #[serde(default)]
    pub calibre: Option<CalibreReport>,
    /// The calibre of each branch; null where that was not asked for, and where there is no vessel tree.
    #[serde(default)]
    pub branches: Option<Vec<BranchCalibre>>,
    /// What there is to say of the result, the weightiest first; set by whoever writes it, null before.
    #[serde(default)]
    pub verdict: Option<Box<VerdictReport>>,
}

/// Whether the vessels keep their calibre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalibreReport {
    /// The change in percent that is allowed.
    pub tolerance_percent: f64,
    /// Changed where one branch is, kept where the others are; null where there is no vessel tree.
    pub verdict: Option<Verdict>,
    /// How much of the vessels that is said of; null where there is no vessel tree.
    #[serde(default)]
    pub coverage: Option<Coverage>,
    /// The part of the length that is measured, in percent; null likewise.
    #[serde(default)]
    pub measured_percent: Option<f64>,
    /// Why there is no vessel tree; null where there is one.
    pub refused: Option<String>,
    /// Milliseconds that it took.
    pub ms: f64,
}

/// How far a reduction is safe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SafeReport {
    /// The change of calibre in percent that is allowed.
    pub tolerance_percent: f64,
    /// The highest rate up to which every vessel keeps its calibre, as far as it is measured, in percent; null where no vessel
    /// can be measured.
    pub percent: Option<f64>,
    /// Triangles at that rate.
    pub triangles: Option<usize>,
    /// How much of the vessels is measured at that rate; null where there is none.
    #[serde(default)]
    pub coverage: Option<Coverage>,
    /// Whether so much is measured that the rate is safe for the whole surface.
    #[serde(default)]
    pub is_covered: bool,
    /// Why it does not go further: a branch that is changed at the next rate, or a pinch; null where nothing stops it.
    pub stopped_by: Option<String>,
    /// Each branch by itself.
    pub branches: Vec<BranchSafe>,
    /// Why there is no such rate; null where there is one.
    pub refused: Option<String>,
}

impl SafeReport {
    fn new(safe: &Safe) -> Self {
        Self {
            tolerance_percent: safe.tolerance_percent,
            percent: safe.percent,
            triangles: safe.triangles,
            coverage: safe.coverage,
            is_covered: safe.is_covered(),
            stopped_by: safe.stopped_by.as_ref().map(Stop::to_string),
            branches: safe.branches.clone(),
            refused: safe.refused.as_ref().map(NoSafeRate::to_string),
        }
    }
}

impl Report {
    /// Sums up a pipeline; `None` until there is a level. Deviations are null until they are there.
    pub fn new(input: &str, pipeline: &Pipeline) -> Option<Self> {
        let (kept, smoothed, reduced) = (pipeline.kept()?, pipeline.smoothed()?, pipeline.reduced()?);
        let comparison = |first: bool| {
            let found = pipeline.deviations()?;
            let one = if first { &found.from_smoothed } else { &found.from_original };
            Some(one.as_ref()?.deviation)
        };
        let (from_kept, from_smoothed) =
            (change(&kept.measures, &reduced.measures), change(&smoothed.measures, &reduced.measures));
        let (opened, entering) = (pipeline.opened(), pipeline.entering()?);
        let pass_band = pipeline.settings().smoothing.pass_band;
        let certified = pipeline.certified();
        Some(Self {
            disclaimer: DISCLAIMER.to_owned(),
            lumen: env!("CARGO_PKG_VERSION").to_owned(),
            input: input.to_owned(),
            opened: if Arc::ptr_eq(opened, &entering.mesh) {
                Counts {
                    vertices: opened.positions.len(),
                    triangles: opened.triangles.len(),
                    components: pipeline.connectivity()?.components.len(),
                }
            } else {
                Counts::of(opened)
            },
            after_connectivity: Counts::of(&kept.mesh),
            output: Counts::of(&reduced.mesh),
            output_fingerprint: format!("{:016x}", reduced.fingerprint),
            axes: Axes::Unknown,
            unit: None,
            threshold: None,
            settings: pipeline.settings().clone(),
            mending: entering.report,
            faults: pipeline.faults().map(|found| found.counts()),
            reduction_percent: reduction_percent(kept.mesh.triangles.len(), reduced.mesh.triangles.len()),
            shortfall: reduced.level.shortfall.as_ref().map(Shortfall::to_string),
            bound: pipeline.bound().zip(pipeline.settings().target.deviation_mm()).map(|(found, asked)| BoundReport {
                max_deviation_mm: asked,
                steps: found.steps,
                next_coarser_mm: found.next_coarser_mm,
            }),
            auto: match (pipeline.settings().target, reduced.target) {
                (Target::Auto, Target::Reduction(per_mille)) => Some(AutoReport {
                    percent: f64::from(per_mille) / 10.0,
                    steps: reduced.level.steps,
                    is_decided: !pipeline.is_deciding(),
                }),
                _ => None,
            },
            pass_band_missed: smoothed.filter.as_ref().is_some_and(|filter| !filter.keeps_promise(pass_band)),
            smoothing_response: smoothed.response,
            volume_held: smoothed.volume_held,
            smoothing_adapted: smoothed.adapted,
            smoothing_weakened: smoothed.weakened.as_ref().map(|found| WeakenedReport::new(found, &smoothed.mesh)),
            stages_ms: pipeline.times(),
            deviation_mm: comparison(true),
            deviation_from_original_mm: comparison(false),
            volume_change_percent: from_kept.0,
            area_change_percent: from_kept.1,
            volume_change_from_smoothed_percent: from_smoothed.0,
            area_change_from_smoothed_percent: from_smoothed.1,
            arrays: pipeline.level_arrays().map(|arrays| infos(arrays)),
            smoothed_shape: pipeline.smoothed_measures().map(|found| found.shape.clone()),
            output_shape: pipeline.level_measures().map(|found| found.shape.clone()),
            narrowing: pipeline.level_measures().and_then(|found| found.narrowing),
            caps: pipeline.level_measures().map(|found| found.caps.clone()),
            pinch: pipeline.smoothed_measures().and_then(|found| found.pinch),
            safe: pipeline.safe().map(|safe| SafeReport::new(safe)),
            calibre: certified.map(|found| CalibreReport {
                tolerance_percent: pipeline.settings().tolerance_percent,
                verdict: found.as_ref().ok().map(|found| found.certificate.verdict),
                coverage: found.as_ref().ok().map(|found| found.certificate.coverage),
                measured_percent: found.as_ref().ok().map(|found| found.certificate.coverage.percent()),
                refused: found.as_ref().err().map(CalibreError::to_string),
                ms: pipeline.times().calibre,
            }),
            branches: certified.and_then(|found| Some(found.as_ref().ok()?.certificate.branches.clone())),
            verdict: None,
        })
    }
}

/// Change of volume and area in percent of `before`; `None` where there is nothing to compare with.
fn change(before: &Measures, after: &Measures) -> (Option<f64>, Option<f64>) {
    let percent = |before: f64, after: f64| (before != 0.0).then(|| (after / before - 1.0) * 100.0);
    let volume = before.volume_mm3.zip(after.volume_mm3).and_then(|(b, a)| percent(b, a));
    (volume, percent(before.area_mm2, after.area_mm2))
}
