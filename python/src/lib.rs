//! What is compiled of the Python package `lumen`: surfaces, results, and a guidewire that another program steers.
//!
//! All of it is in the crates below; here it is given to Python. The files beside this one are named for what they give.
//! Docstrings stand at what they are of, types in `lumen/__init__.pyi`.
//!
//! pyo3 writes the lines between the two languages; nothing here is `unsafe`.

mod arrays;
mod centrelines;
mod error;
mod guidewire;
mod opening;
mod optimised;
mod settings;
mod surface;
mod working;

use pyo3::prelude::*;

#[pymodule]
mod _lumen {
    #[pymodule_export]
    use super::centrelines::Centrelines;
    #[pymodule_export]
    use super::error::Error;
    #[pymodule_export]
    use super::guidewire::Guidewire;
    #[pymodule_export]
    use super::opening::{read, write};
    #[pymodule_export]
    use super::optimised::{Levels, Optimised};
    #[pymodule_export]
    use super::settings::settings;
    #[pymodule_export]
    use super::surface::Surface;
    #[pymodule_export]
    use super::working::_forked;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python calls it so")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
