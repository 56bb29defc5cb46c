//! Where a subcommand's surface is made of a scan or a mask: a file, a header with its data beside it, a folder of DICOM.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context, Error, Result, bail};
use serde::Serialize;

use super::misuse::misuse;
use super::rows::row;
use super::scan_options::{ScanOptions, SurfaceMethod};
use crate::io::volume::{self, Part};
use crate::io::{Axes, Imported, LabelName, Offer, ReadError, ThresholdReport, Warning, import_mesh, in_english};
use crate::task::{Yielder, at_once};
use crate::volume::{
    Cut, Grid, HalfWay, Label, LabelledSurface, Method, PRESETS, Relaxation, Selection, Survey, VolumeError, half_way,
    surface_in_slices, surface_nets, survey,
};

/// What is said of a folder without surfaces: it may be a scan.
pub(super) const FOLDER_HINT: &str = "; for a folder of DICOM say --threshold or --label, and a file for the surface";

/// This build can.
pub(super) fn check() -> Result<()> {
    Ok(())
}

/// Why a file is no surface, as its reader says it.
pub(super) fn refused(error: ReadError) -> Error {
    error.into()
}

/// A volume that was opened.
pub(super) struct Opened {
    grid: Arc<Grid>,
    survey: Survey,
    format: &'static str,
    axes: Axes,
    is_ct: bool,
    warnings: Vec<Warning>,
    offers: Vec<Offer>,
    taken: usize,
    names: Vec<LabelName>,
}

/// What is in a volume. The field names are the keys of the JSON that `lumen inspect` prints.
#[derive(Serialize)]
struct Report<'a> {
    format: &'a str,
    /// Voxels along the axes.
    dimensions: [usize; 3],
    spacing_mm: [f64; 3],
    origin_mm: [f64; 3],
    /// The directions of the three axes, each a unit vector.
    directions: [[f64; 3]; 3],
    /// What the coordinates grow towards: LPS, or unknown where the file does not say it.
    axes: Axes,
    sample_type: &'a str,
    /// The smallest and the largest value.
    range: [f64; 2],
    is_ct: bool,
    /// Of a mask, the labels but 0.
    labels: Vec<NamedLabel<'a>>,
    /// All volumes of the files where they may hold several, and which of them this is, from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    volumes: Vec<Choice<'a>>,
    volume: usize,
    warnings: Vec<String>,
}

/// One of several volumes: how many slices it has, and what tells it from the others.
#[derive(Serialize)]
struct Choice<'a> {
    series: usize,
    slices: usize,
    by: Option<String>,
    value: &'a str,
}

/// A label with its name and its colour, as far as the file has them.
#[derive(Serialize)]
struct NamedLabel<'a> {
    #[serde(flatten)]
    label: Label,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    /// Red, green and blue of sRGB.
    #[serde(skip_serializing_if = "Option::is_none")]
    colour: Option<[u8; 3]>,
}

/// Opens the volume in the files or the folder of those names; `None` where the only one is a file that is none.
pub(super) fn open(names: &[String], options: &ScanOptions) -> Result<Option<Opened>> {
    let paths: Vec<PathBuf> = names.iter().map(PathBuf::from).collect();
    let Some(files) = volume::gather(&paths)? else { return Ok(None) };
    if files.is_empty() {
        bail!("{} holds no files", names.join(", "));
    }
    let parts: Vec<Part> = files.iter().map(|(name, bytes)| Part { name, bytes }).collect();
    let scan = volume::read_volume(&parts, options.volume.map(|number| number as usize - 1))
        .with_context(|| names[0].clone())?;
    drop(files);
    let volume::Scan { grid, format, axes, is_ct, warnings, offers, taken, names } = scan;
    let grid = Arc::new(grid);
    let survey = survey(&grid);
    Ok(Some(Opened { grid, survey, format, axes, is_ct, warnings, offers, taken, names }))
}

impl Opened {
    /// What the surface is made of that the options ask for, and the values that a threshold is half way between which was
    /// found.
    fn cut(&self, options: &ScanOptions) -> Result<(Cut, Option<HalfWay>)> {
        let seed = options.seed.map(|place| self.grid.geometry().voxel_at(place).ok_or(VolumeError::SeedNowhere));
        let seed = seed.transpose()?;
        let is_open = options.threshold.or(options.label.map(|label| label as f64)).is_none();
        let found = match seed.filter(|_| is_open && !self.survey.is_mask()) {
            Some(seed) => Some(half_way(&self.grid, seed).ok_or(VolumeError::NoEdge)?),
            None => None,
        };
        let threshold = options.threshold.or(found.map(|found| found.threshold));
        let selection = Selection::choose(&self.survey, threshold, options.label)?;
        let method = match options.surface_by {
            Some(SurfaceMethod::Nets) if matches!(selection, Selection::Threshold(_)) => {
                return Err(misuse("--surface-by nets is for masks: a threshold lies between voxels"));
            }
            Some(SurfaceMethod::Nets) => Method::SurfaceNets,
            Some(SurfaceMethod::Cubes) => Method::MarchingCubes,
            None => Method::of(selection),
        };
        Ok((Cut { selection, region: options.region, seed, method }, found))
    }

    /// The borders of all labels where the options ask for these.
    pub(super) fn borders(&self, options: &ScanOptions) -> Result<Option<LabelledSurface>> {
        let (cut, _) = self.cut(options)?;
        let asked = (options.surface_by, cut.selection, options.seed);
        if asked != (Some(SurfaceMethod::Nets), Selection::AnyLabel, None) || self.survey.labels.len() < 2 {
            return Ok(None);
        }
        Ok(Some(surface_nets(&self.grid, Selection::EachLabel, cut.region, Relaxation::default())?))
    }

    /// What coordinates grow towards.
    pub(super) fn axes(&self) -> Axes {
        self.axes
    }

    /// Prints the values that the threshold lies half way between, if it was found so.
    pub(super) fn print_half_way(&self, options: &ScanOptions) -> Result<()> {
        if let (_, Some(HalfWay { vessel, background, .. })) = self.cut(options)? {
            row("half way", format!("from {vessel:.1} to {background:.1}"));
        }
        Ok(())
    }

    /// The surface that the options ask for, in the axes of the scan.
    pub(super) fn surface(&self, options: &ScanOptions) -> Result<Imported> {
        let (cut, _) = self.cut(options)?;
        let mesh = at_once(surface_in_slices(&self.grid, cut, &Yielder::never()))?;
        let threshold = ThresholdReport::new(&self.grid, &mesh, cut.selection);
        let mut imported = import_mesh(mesh, self.format);
        imported.report.threshold = threshold;
        imported.report.axes = self.axes;
        imported.report.warnings.splice(..0, self.warnings.iter().cloned());
        Ok(imported)
    }

    /// What is strange about it.
    pub(super) fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    fn choices(&self) -> impl Iterator<Item = Choice<'_>> {
        self.offers.iter().map(|Offer { series, slices, by, value }| Choice {
            series: series + 1,
            slices: *slices,
            by: by.map(|by| by.to_string()),
            value,
        })
    }

    fn labels(&self) -> impl Iterator<Item = NamedLabel<'_>> {
        self.survey.labels.iter().map(|&label| {
            let named = self.names.iter().find(|named| named.value == label.value);
            NamedLabel { label, name: named.map(|named| &*named.name), colour: named.and_then(|named| named.colour) }
        })
    }

    /// What is in it, as JSON.
    pub(super) fn json(&self) -> Result<String> {
        let geometry = self.grid.geometry();
        Ok(serde_json::to_string_pretty(&Report {
            format: self.format,
            dimensions: geometry.size,
            spacing_mm: geometry.spacing.to_array(),
            origin_mm: geometry.origin.to_array(),
            directions: geometry.direction.to_cols_array_2d(),
            axes: self.axes,
            sample_type: self.grid.samples().sample_type().name(),
            range: self.survey.range,
            is_ct: self.is_ct,
            labels: self.labels().collect(),
            volumes: self.choices().collect(),
            volume: self.taken + 1,
            warnings: in_english(&self.warnings),
        })?)
    }

    /// Prints what is in it.
    pub(super) fn print(&self) {
        let geometry = self.grid.geometry();
        let list = |values: [f64; 3]| values.map(|value| format!("{value:.4}")).join(", ");
        let [i, j, k] = geometry.size;
        let has_series = self.offers.iter().any(|offer| offer.series != self.offers[0].series);
        for (at, Offer { slices, by, value, series }) in
            self.offers.iter().enumerate().filter(|_| self.offers.len() > 1)
        {
            let what = match by {
                Some(by) if has_series => format!("series {}, {by} {value}", series + 1),
                Some(by) => format!("{by} {value}"),
                None => format!("series {}", series + 1),
            };
            let taken = if at == self.taken { ", opened" } else { "" };
            row(&format!("volume {}", at + 1), format!("{slices} slices, {what}{taken}"));
        }
        row("format", self.format);
        row("dimensions", format!("{i} x {j} x {k} voxels"));
        row("spacing", format!("{} mm", geometry.spacing.to_array().map(|mm| format!("{mm:.4}")).join(" x ")));
        row("origin", format!("({}) mm, {}", list(geometry.origin.to_array()), self.axes));
        let columns = geometry.direction.to_cols_array_2d();
        row("directions", columns.map(|column| format!("({})", list(column))).join(" "));
        if geometry.is_left_handed() {
            row("", "of a left hand");
        }
        let [low, high] = self.survey.range;
        row("type", self.grid.samples().sample_type().name());
        row("range", format!("{low} to {high}{}", if self.is_ct { " HU" } else { "" }));
        if self.survey.is_mask() {
            let labels = self.labels().map(|NamedLabel { label: Label { value, points }, name, colour }| {
                let name = name.map_or_else(String::new, |name| format!(" {name}"));
                let colour = colour.map_or_else(String::new, |[r, g, b]| format!(", #{r:02x}{g:02x}{b:02x}"));
                format!("{value}{name} ({points} voxels{colour})")
            });
            row("labels", labels.collect::<Vec<_>>().join(", "));
        } else if self.is_ct || self.survey.has_air() {
            for preset in PRESETS {
                row("threshold", format!("{} HU {}", preset.value, preset.name));
            }
        }
    }
}
