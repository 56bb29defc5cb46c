//! A surface, what the pipeline makes of it, and what is taken out of that: levels, numbers, centrelines, files.

use std::sync::Arc;

use js_sys::{Float32Array, Uint32Array};
use lumen_io::{Format, ImportReport, Imported, Output, write_output};
use lumen_mesh::{TriMesh, Vec3};
use lumen_pipeline::deviation::REPORT_SAMPLES;
use lumen_pipeline::normals::{Weighting, vertex_normals};
use lumen_pipeline::report::{Report, UnitReport};
use lumen_pipeline::run::{Advance, Pipeline};
use lumen_pipeline::settings::Settings;
use lumen_pipeline::verdict::{Verdict, VerdictReport, rate};
use lumen_vessel::Centrelines;
use lumen_vessel::certificate::Certificate;
use lumen_vessel::width::circle;
use serde::Serialize;
use serde_json::json;
use wasm_bindgen::prelude::*;

use crate::reading::slice;
use crate::refusal::{refusal, refused};
use crate::settings;

/// A surface that was opened.
#[wasm_bindgen]
pub struct Surface {
    name: String,
    import: ImportReport,
    has_units: bool,
    /// What is done. It stays as it is while something else is worked out, and where that is cancelled.
    pipeline: Pipeline,
    /// What is worked out.
    next: Option<Pipeline>,
}

/// How much is made of a surface.
#[wasm_bindgen]
#[derive(Clone, Copy)]
pub enum Wanted {
    /// The levels alone.
    Levels,
    /// Deviation, shape and lumen, too.
    Measures,
    /// The calibre of each vessel, too.
    Certificate,
}

/// A level as arrays, each of which is copied out once.
#[wasm_bindgen(getter_with_clone)]
pub struct Level {
    /// Three numbers a vertex, in mm.
    pub positions: Float32Array,
    /// Three corners a triangle, counter-clockwise from outside.
    pub indices: Uint32Array,
    /// Three numbers a vertex: the mean of the triangles' normals by their areas.
    pub normals: Float32Array,
}

/// The middle of each vessel, station by station.
#[wasm_bindgen(getter_with_clone)]
pub struct Lines {
    /// Three numbers a station, in mm.
    pub positions: Float32Array,
    /// Of the largest ball inside, in mm.
    pub radii: Float32Array,
    /// Of the circle as large as the cross-section, in mm; NaN where that does not close.
    #[wasm_bindgen(js_name = sectionRadii)]
    pub section_radii: Float32Array,
    /// The first station of each branch, and behind them the number of all.
    pub starts: Uint32Array,
    /// The number of the branch that each comes out of, from 0; -1 for the first of a tree.
    pub parents: js_sys::Int32Array,
}

impl Surface {
    pub(crate) fn new(name: &str, imported: Imported, has_units: bool) -> Self {
        let Imported { mesh, arrays, report } = imported;
        let pipeline =
            Pipeline::new(Arc::new(mesh), Settings::default()).with_samples(REPORT_SAMPLES).with_arrays(arrays);
        Self { name: name.to_owned(), import: report, has_units, pipeline, next: None }
    }

    /// The triangles after a reduction by so many percent; what the settings ask for where that is not said.
    fn taken(&self, reduction: Option<f64>) -> Result<(TriMesh, Vec<Vec3>), JsValue> {
        let pipeline = &self.pipeline;
        let Some(percent) = reduction else {
            let reduced = pipeline.reduced().ok_or_else(not_yet)?;
            return Ok(((*reduced.mesh).clone(), reduced.normals.clone()));
        };
        let target = rate(percent);
        Settings { target, ..Settings::default() }.check().map_err(|why| refusal(&why))?;
        let progressive = pipeline.progressive().ok_or_else(not_yet)?;
        let mesh = progressive.extract(&progressive.level(target).triangles);
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        Ok((mesh, normals))
    }
}

#[wasm_bindgen]
impl Surface {
    /// What the file is, as `lumen inspect --json` says it.
    ///
    /// # Errors
    /// Never, but for memory.
    pub fn import(&self) -> Result<String, JsValue> {
        json_of(&self.import)
    }

    /// Takes settings, as JSON, for [`Self::advance`] to work on; what was worked on before is dropped.
    ///
    /// # Errors
    /// Where they cannot be used; nothing changes then.
    pub fn set(&mut self, settings: &str, wanted: Wanted) -> Result<(), JsValue> {
        let mut next = self.pipeline.fork();
        next.set(settings::read(settings)?).map_err(|why| refusal(&why))?;
        self.next = Some(match wanted {
            Wanted::Levels => next.without_measures(),
            Wanted::Measures => next.with_measures(),
            Wanted::Certificate => next.with_certificate(),
        });
        Ok(())
    }

    /// Works for so many milliseconds: JSON with the stage and the part of it that is done; undefined where all is.
    ///
    /// # Errors
    /// Where the settings name a piece that there is not.
    pub fn advance(&mut self, ms: f64) -> Result<Option<String>, JsValue> {
        let Some(next) = &mut self.next else { return Ok(None) };
        let (stage, fraction) = match next.advance(slice(ms)).map_err(|why| refusal(&why))? {
            Advance::Working(stage, fraction) => (stage, fraction),
            Advance::Finished(stage) => (stage, 1.0),
            Advance::Idle => {
                std::mem::swap(&mut self.pipeline, next);
                self.next = None;
                return Ok(None);
            }
        };
        Ok(Some(json!({ "stage": stage.to_string(), "fraction": fraction }).to_string()))
    }

    /// Drops what is worked on.
    pub fn cancel(&mut self) {
        self.next = None;
    }

    /// What it came to: the report of `lumen optimise --report`, less times of files, and the certificate, as JSON.
    ///
    /// # Errors
    /// Before there is a level.
    pub fn result(&self) -> Result<String, JsValue> {
        let pipeline = &self.pipeline;
        let mut report = Report::new(&self.name, pipeline).ok_or_else(not_yet)?;
        report.axes = self.import.axes;
        report.unit = Some(UnitReport { unit: self.import.unit, by_size: self.import.unit_by_size });
        report.threshold = self.import.threshold;
        let verdict = Verdict::of_run(pipeline, &report, &self.import, self.has_units);
        report.verdict = Some(Box::new(VerdictReport::from(&verdict)));
        let certificate = pipeline.certified().and_then(|found| Some(&found.as_ref().ok()?.certificate));
        json_of(&Outcome { report, certificate })
    }

    /// A level of all rates, or the one that the settings ask for.
    ///
    /// # Errors
    /// Before there are levels, and where the rate is none.
    pub fn level(&self, reduction: Option<f64>) -> Result<Level, JsValue> {
        let (mesh, normals) = self.taken(reduction)?;
        Ok(Level {
            positions: floats(mesh.positions.iter().map(Vec3::to_array)),
            indices: Uint32Array::from(mesh.triangles.as_flattened()),
            normals: floats(normals.iter().map(Vec3::to_array)),
        })
    }

    /// A level as a file, with normals where the format has a place for them, and the file's own arrays where it is that of the
    /// settings: the bytes that `lumen optimise` writes.
    ///
    /// # Errors
    /// As [`Self::level`], and where the format is unknown or has no room.
    pub fn save(&self, format: &str, reduction: Option<f64>) -> Result<Vec<u8>, JsValue> {
        let unknown = || refused("errors-format-unknown", &[], &format!("\"{format}\" is no format of surfaces."));
        let format = Format::from_extension(format).ok_or_else(unknown)?;
        let (mesh, normals) = self.taken(reduction)?;
        let carried = self.pipeline.level_arrays().filter(|_| reduction.is_none());
        let arrays = carried.map_or(&[][..], |arrays| arrays);
        let output = Output { mesh: &mesh, normals: Some(&normals), arrays, axes: self.import.axes };
        write_output(&output, format).map_err(|why| refusal(&why))
    }

    /// The centrelines of the surface as it was opened.
    ///
    /// # Errors
    /// Where there are none, or the vessels were not asked for.
    pub fn centrelines(&self) -> Result<Lines, JsValue> {
        let vessels = self.pipeline.vessels().ok_or_else(|| {
            refused(
                "npm-no-vessels",
                &[],
                "The vessels were not looked for: call optimise() with its certificate first.",
            )
        })?;
        let Centrelines { branches, stations, calibres, .. } = vessels.as_ref().map_err(refusal)?.centrelines();
        let mut starts: Vec<u32> = stations.of.iter().map(|range| range.start as u32).collect();
        starts.push(stations.all.len() as u32);
        let parents: Vec<i32> =
            branches.iter().map(|branch| branch.parent.map_or(-1, |parent| parent as i32)).collect();
        let radii: Vec<f32> = stations.all.iter().map(|station| station.radius_mm as f32).collect();
        let section_radii: Vec<f32> =
            calibres.iter().map(|calibre| calibre.area_mm2.map_or(f32::NAN, |area| circle(area) as f32)).collect();
        Ok(Lines {
            positions: floats(stations.all.iter().map(|station| station.at.as_vec3().to_array())),
            radii: Float32Array::from(&radii[..]),
            section_radii: Float32Array::from(&section_radii[..]),
            starts: Uint32Array::from(&starts[..]),
            parents: js_sys::Int32Array::from(&parents[..]),
        })
    }
}

/// What a run came to.
#[derive(Serialize)]
struct Outcome<'a> {
    report: Report,
    certificate: Option<&'a Certificate>,
}

fn json_of(told: &impl Serialize) -> Result<String, JsValue> {
    serde_json::to_string(told).map_err(|why| JsValue::from_str(&why.to_string()))
}

fn not_yet() -> JsValue {
    refused("npm-not-optimised", &[], "There are no levels yet: call optimise() first.")
}

fn floats(triples: impl Iterator<Item = [f32; 3]>) -> Float32Array {
    let all: Vec<f32> = triples.flatten().collect();
    Float32Array::from(&all[..])
}
