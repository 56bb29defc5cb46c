//! The bytes of a file on their way to a surface, in slices, so that the Worker hears a cancel between them.

use std::sync::Arc;
use std::time::Duration;

use lumen_io::{Format, ImportOptions, Imported, ReadError, Unit, Warning, read_in_slices};
use lumen_mesh::task::{Budget, Progress, Running};
use wasm_bindgen::prelude::*;

use crate::refusal::refusal;
use crate::surface::Surface;

/// A file that is being read.
#[wasm_bindgen]
pub struct Reading {
    name: String,
    /// To be read again in another unit, where the size asks for it.
    bytes: Option<Arc<Vec<u8>>>,
    running: Running<'static, Result<Imported, ReadError>>,
    is_by_size: bool,
}

#[wasm_bindgen]
impl Reading {
    /// Begins to read. `unit` is mm, cm or m; "auto" takes the one in which the size would be that of vessels, as the command
    /// line's `--unit auto` does; none takes what the format says.
    ///
    /// # Errors
    /// Where `unit` is none of these.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: Vec<u8>, name: &str, unit: Option<String>) -> Result<Self, JsValue> {
        let is_auto = unit.as_deref() == Some("auto");
        let unit: Option<Unit> =
            unit.filter(|_| !is_auto).map(|word| word.parse()).transpose().map_err(|why| refusal(&why))?;
        let bytes = Arc::new(bytes);
        let running = begin(bytes.clone(), name.to_owned(), unit);
        Ok(Self { name: name.to_owned(), bytes: is_auto.then_some(bytes), running, is_by_size: false })
    }

    /// Works for so many milliseconds: the surface where the file is read.
    ///
    /// # Errors
    /// Where it cannot be opened.
    pub fn advance(&mut self, ms: f64) -> Result<Option<Surface>, JsValue> {
        let Progress::Done(read) = self.running.advance(slice(ms)) else { return Ok(None) };
        let mut imported = read.map_err(|why| refusal(&why))?;
        let by_size = imported.report.unit_by_size();
        if let Some((bytes, unit)) = self.bytes.take().zip(by_size) {
            self.running = begin(bytes, self.name.clone(), Some(unit));
            self.is_by_size = true;
            return Ok(None);
        }
        if self.is_by_size {
            imported.report.unit_by_size = true;
            imported.report.warnings.push(Warning::UnitBySize { unit: imported.report.unit });
        }
        Ok(Some(Surface::new(&self.name, imported, Format::from_name(&self.name).is_some())))
    }
}

fn begin(bytes: Arc<Vec<u8>>, name: String, unit: Option<Unit>) -> Running<'static, Result<Imported, ReadError>> {
    Running::new(|yielder| async move { read_in_slices(bytes, &name, &ImportOptions { unit }, &yielder).await })
}

/// A slice of so many milliseconds.
pub(crate) fn slice(ms: f64) -> Budget {
    Budget::new(Duration::from_secs_f64(ms.clamp(0.0, 1e6) / 1e3))
}
