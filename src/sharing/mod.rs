//! What another person needs to see the same result: the settings, as a file or in a link, and by what a file is known.
//!
//! A result is a function of the file and the settings ([`crate::pipeline`]), so that is all that is shared: never the
//! surface, never its name, and nothing that was read from it but the first digits of its hash; in a file also what a user
//! has measured on it ([`measures`]).

mod digest;
mod eye;
mod link;
pub mod measures;
mod settings_file;

use serde::{Deserialize, Serialize};

use crate::io::Unit;
use crate::pipeline::settings::Settings;

pub use digest::{Digest, Digesting, NoDigest, ShortDigest};
pub use eye::Eye;
pub use link::{Link, LinkError, SharedSurface, changed_settings};
pub use settings_file::{
    Beside, Measured, SettingsFileError, read_settings, read_settings_and, write_settings, write_settings_and,
};

/// All that a user can set and that changes the result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SharedSettings {
    /// The unit of the numbers in the file; `None` where what the format says is taken.
    pub unit: Option<Unit>,
    /// The settings of all stages.
    pub settings: Settings,
}
