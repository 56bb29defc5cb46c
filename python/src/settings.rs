//! Settings by the names that the settings file and the command line have for them: those of the one table.

use lumen::io::Unit;
use lumen::pipeline::settings::table::{self, Setting};
use lumen::pipeline::settings::{Preset, Settings, Target};
use lumen::pipeline::verdict::rate;
use lumen::sharing::{SharedSettings, read_settings, write_settings};
use pyo3::exceptions::{PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use crate::error::refused;

/// What is asked for.
pub(crate) struct Asked {
    pub(crate) settings: Settings,
    /// Whether the rate is to be the highest that is safe.
    pub(crate) wants_safe: bool,
    /// What the settings file says of the unit that surfaces are read in.
    pub(crate) unit: Option<Unit>,
}

/// The settings that these names come to, as the content of a settings file: `json.dump` writes one for `--settings`.
///
/// `reduction="safe"` is no rate before a surface is there; `optimise` takes it.
#[pyfunction]
#[pyo3(signature = (settings=None, **named))]
pub(crate) fn settings<'py>(
    py: Python<'py>,
    settings: Option<&Bound<'py, PyDict>>,
    named: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let Asked { settings, wants_safe, unit } = asked(py, settings, named)?;
    if wants_safe {
        return Err(PyValueError::new_err("reduction='safe' is found by optimise: settings have no rate for it"));
    }
    py.import("json")?.call_method1("loads", (write_settings(&SharedSettings { unit, settings }),))
}

/// The settings of a file or by name, and over them those that are named beside.
pub(crate) fn asked(
    py: Python<'_>,
    given: Option<&Bound<'_, PyDict>>,
    named: Option<&Bound<'_, PyDict>>,
) -> PyResult<Asked> {
    let mut asked = Asked { settings: Settings::default(), wants_safe: false, unit: None };
    match given {
        Some(file) if file.contains("format")? => {
            let text: String = py.import("json")?.call_method1("dumps", (file,))?.extract()?;
            let read = read_settings(text.as_bytes()).map_err(|error| PyValueError::new_err(error.to_string()))?;
            (asked.settings, asked.unit) = (read.settings, read.unit);
        }
        Some(given) => put(&mut asked, given)?,
        None => {}
    }
    named.map_or(Ok(()), |named| put(&mut asked, named))?;
    asked.settings.check().map_err(|error| refused(py, &error))?;
    Ok(asked)
}

fn put(asked: &mut Asked, named: &Bound<'_, PyDict>) -> PyResult<()> {
    let mut target = None;
    let mut rows = Vec::new();
    for (name, value) in named.iter().filter(|(_, value)| !value.is_none()) {
        let name: String = name.extract()?;
        if name == "smoothing" {
            let wanted = text(&value)?;
            let preset = Preset::ALL.into_iter().find(|preset| preset.name() == wanted);
            asked.settings.smoothing = preset.ok_or_else(|| no_value(&name, &wanted))?.smoothing();
            continue;
        }
        let setting = table::find(&name.replace('_', "-")).ok_or_else(|| unknown(&name))?;
        if setting.field == "target"
            && let Some(other) = target.replace(name.clone())
        {
            return Err(PyTypeError::new_err(format!("{other} and {name} are two ways to say one thing")));
        }
        rows.push((name, setting, value));
    }
    // A preset is what single settings go over, wherever it stands.
    rows.into_iter().try_for_each(|(name, setting, value)| set(asked, &name, setting, &value))
}

fn set(asked: &mut Asked, name: &str, setting: &Setting, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let text = text(value)?;
    if setting.field == "target" {
        asked.wants_safe = false;
    }
    if setting.key == "reduction" {
        asked.wants_safe = text == "safe";
        if asked.wants_safe {
            asked.settings.target = Target::Auto;
            return Ok(());
        }
        if let Ok(percent) = text.parse::<f64>()
            && (0.0..=f64::from(Target::MAX_PER_MILLE) / 10.0).contains(&percent)
        {
            if 0.0 < percent && percent < 1.0 {
                let py = value.py();
                let few = c"reduction is in percent, and this is less than one: nine tenths are reduction=90";
                PyErr::warn(py, &py.get_type::<PyUserWarning>(), few, 1)?;
            }
            asked.settings.target = rate(percent);
            return Ok(());
        }
    }
    setting.read(&mut asked.settings, &text).map_err(|_| no_value(name, &text))
}

/// A value as a link has it.
fn text(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(switch) = value.cast::<PyBool>() {
        return Ok(if switch.is_true() { "yes" } else { "no" }.to_owned());
    }
    if let Ok(pieces) = value.extract::<Vec<u32>>() {
        return Ok(pieces.iter().map(u32::to_string).collect::<Vec<_>>().join(","));
    }
    Ok(value.str()?.to_string().to_lowercase())
}

fn no_value(name: &str, text: &str) -> PyErr {
    PyValueError::new_err(format!("{text} is no value of {name}"))
}

fn unknown(name: &str) -> PyErr {
    let names: Vec<_> = table::all().map(|setting| setting.key.replace('-', "_")).collect();
    PyTypeError::new_err(format!("there is no setting {name:?}; there are smoothing, {}", names.join(", ")))
}
