//! The settings as a file: JSON with a version, read and written by the window and the command line alike.
//!
//! A field that Lumen does not know is refused, not left out: it was meant to change the result. A switch that is left
//! out is off; everything else has to be there, so that the file says the same whatever a later version's defaults are.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::SharedSettings;
use crate::io::Unit;
use crate::pipeline::settings::{Settings, SettingsError};

/// What stands first in the file.
const FORMAT: &str = "lumen-settings";
/// The version that is written; all up to it are read.
const VERSION: u32 = 1;
/// The most bytes that are read: Lumen writes less than one thousand.
const LONGEST: usize = 100_000;

/// Why settings were not read from a file.
#[derive(Debug, Error)]
pub enum SettingsFileError {
    /// Not what Lumen writes.
    #[error("This is no file of Lumen's settings.")]
    NoSettings,
    /// A later version.
    #[error(
        "These settings were written by a newer Lumen: their version is {found}, and this Lumen reads up to {known}."
    )]
    Newer {
        /// The version in the file.
        found: u32,
        /// The newest that is known.
        known: u32,
    },
    /// A field is unknown, missing or of another kind than it has to be; the parser's words name it and its place.
    #[error("The settings cannot be read: {0}.")]
    Field(serde_json::Error),
    /// A number is out of range.
    #[error("The settings cannot be used: {0}.")]
    Range(#[from] SettingsError),
}

/// What any version has.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    version: u32,
    unit: Option<Unit>,
    settings: Settings,
}

/// The settings as the text of a file.
pub fn write_settings(shared: &SharedSettings) -> String {
    let SharedSettings { unit, settings } = shared.clone();
    let file = File { format: FORMAT.to_owned(), version: VERSION, unit, settings };
    // Nothing in it can fail: there are no maps, and every number that `Settings::check` lets through is finite.
    serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
}

/// Reads what [`write_settings`] has written, in this version or an earlier one.
///
/// # Errors
/// When it is no file of settings, or of a newer version, or a field is unknown, missing or out of range.
pub fn read_settings(bytes: &[u8]) -> Result<SharedSettings, SettingsFileError> {
    if bytes.len() > LONGEST {
        return Err(SettingsFileError::NoSettings);
    }
    let head: Head = serde_json::from_slice(bytes).map_err(|_| SettingsFileError::NoSettings)?;
    if head.format != FORMAT {
        return Err(SettingsFileError::NoSettings);
    }
    if head.version > VERSION {
        return Err(SettingsFileError::Newer { found: head.version, known: VERSION });
    }
    let File { unit, settings, .. } = serde_json::from_slice(bytes).map_err(SettingsFileError::Field)?;
    settings.check()?;
    Ok(SharedSettings { unit, settings })
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::pipeline::settings::{Keep, Smoothing, Target};

    fn written() -> Value {
        serde_json::from_str(&write_settings(&SharedSettings::default())).unwrap()
    }

    fn refused(file: &Value) -> String {
        read_settings(file.to_string().as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn what_is_written_is_read_to_the_last_bit() {
        let pass_band = 0.1 + 0.2;
        let settings = Settings {
            keep: Keep::Component(3),
            smoothing: Smoothing { pass_band, ..Smoothing::PAPER },
            target: Target::Deviation(290),
            ..Settings::default()
        };
        let shared = SharedSettings { unit: Some(Unit::Centimetre), settings };
        assert_eq!(read_settings(write_settings(&shared).as_bytes()).unwrap(), shared);
        let file = written();
        assert_eq!((&file["format"], &file["version"]), (&json!("lumen-settings"), &json!(1)));
        assert!(file["unit"].is_null());
    }

    #[test]
    fn an_unknown_field_is_named_wherever_it_stands() {
        let mut outer = written();
        outer["colour"] = json!("red");
        assert!(refused(&outer).contains("`colour`"), "{}", refused(&outer));
        for part in ["smoothing", "decimation"] {
            let mut inner = written();
            inner["settings"][part]["passband"] = json!(0.1);
            assert!(refused(&inner).contains("unknown field `passband`"), "{}", refused(&inner));
        }
        let mut missing = written();
        missing["settings"]["smoothing"].as_object_mut().unwrap().remove("pass_band");
        assert!(refused(&missing).contains("missing field `pass_band`"), "{}", refused(&missing));
    }

    #[test]
    fn a_newer_version_is_told_whatever_else_it_holds() {
        let newer = json!({ "format": "lumen-settings", "version": 2, "all": "new" });
        assert_eq!(
            refused(&newer),
            "These settings were written by a newer Lumen: their version is 2, and this Lumen reads up to 1."
        );
    }

    #[test]
    fn what_is_no_file_of_settings_is_refused() {
        for bytes in [&b""[..], b"{}", b"[1]", b"\xff\xfe", br#"{"format":"other","version":1}"#, &[b'['; 200_000]] {
            assert!(matches!(read_settings(bytes), Err(SettingsFileError::NoSettings)));
        }
        let mut file = written();
        file["settings"]["smoothing"]["pass_band"] = json!(3.0);
        assert_eq!(refused(&file), "The settings cannot be used: the pass band must lie between 0.001 and 2, not 3.");
    }
}
