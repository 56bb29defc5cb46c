//! What is refused, as an exception with its data.

use std::path::Path;

use lumen_message::{Message, Value};
use pyo3::exceptions::{PyException, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

pyo3::create_exception!(
    lumen,
    Error,
    PyException,
    "What Lumen refuses. `id` names the message, `values` has the numbers and words in it, `str()` is the sentence."
);

/// The exception for a message.
pub(crate) fn refused(py: Python<'_>, message: &dyn Message) -> PyErr {
    let error = Error::new_err(message.to_string());
    let dressed = values(py, message).and_then(|values| {
        error.value(py).setattr("id", message.id())?;
        error.value(py).setattr("values", values)
    });
    dressed.map_or_else(|other| other, |()| error)
}

fn values<'py>(py: Python<'py>, message: &dyn Message) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    for (name, value) in message.values() {
        match value {
            Value::Text(text) => told.set_item(name, text)?,
            Value::Count(count) => told.set_item(name, count)?,
            Value::Number { value, .. } | Value::Change { value, .. } => told.set_item(name, value)?,
            Value::Message(inner) => told.set_item(name, inner.to_string())?,
        }
    }
    Ok(told)
}

/// The exception for a file that cannot be read or written: Python makes it `FileNotFoundError` and the like.
pub(crate) fn unusable(error: &std::io::Error, path: &Path) -> PyErr {
    let text = error.to_string();
    // Python writes the number itself.
    let text = text.split(" (os error").next().unwrap_or_default().to_owned();
    PyOSError::new_err((error.raw_os_error(), text, path.to_owned()))
}

/// A report as Python has JSON: dictionaries and lists.
pub(crate) fn told<'py>(py: Python<'py>, report: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(report).map_err(|error| PyException::new_err(error.to_string()))?;
    parsed(py, &text)
}

/// What a text in JSON says.
pub(crate) fn parsed<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}
