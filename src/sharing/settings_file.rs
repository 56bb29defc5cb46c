//! The settings as a file: JSON with a version, read and written by the window and the command line alike.
//!
//! Measures stand beside them, with what the surface is known by that they were made on, and what is done for a solver.
//!
//! A field that Lumen does not know is refused, not left out: it was meant to change the result. A switch that is left
//! out is off; everything else has to be there, so that the file says the same whatever a later version's defaults are.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::SharedSettings;
use super::measures::{Measure, are_sound};
use crate::io::Unit;
use crate::language::tell;
use crate::pipeline::settings::{Settings, SettingsError};
use crate::prepare::notes::PrepareError;
use crate::prepare::prepare::Plan;
use crate::say;

/// What stands first in the file.
const FORMAT: &str = "lumen-settings";
/// The version that is written; all up to it are read.
const VERSION: u32 = 1;
/// The most bytes that are read: settings take less than one thousand, a cross-section some thousands.
const LONGEST: usize = 4_000_000;

/// Why settings were not read from a file.
#[derive(Debug, Error)]
pub enum SettingsFileError {
    /// Not what Lumen writes.
    #[error("{}", say!("app-settings-none"))]
    NoSettings,
    /// A later version.
    #[error("{}", say!("app-settings-newer", found = .found.to_string(), known = .known.to_string()))]
    Newer {
        /// The version in the file.
        found: u32,
        /// The newest that is known.
        known: u32,
    },
    /// A field is unknown, missing or of another kind than it has to be; the parser's words name it and its place.
    #[error("{}", say!("app-settings-field", why = .0.to_string()))]
    Field(serde_json::Error),
    /// A number is out of range.
    #[error("{}", say!("app-settings-range", why = tell(.0)))]
    Range(#[from] SettingsError),
    /// A length for a solver is none.
    #[error("{}", say!("app-settings-range", why = tell(.0)))]
    Solver(#[from] PrepareError),
    /// A measure is not one.
    #[error("{}", say!("app-measures-unsound"))]
    Measures,
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    measured: Option<Measured>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    solver: Option<Plan>,
}

/// What stands beside the settings where there is some.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beside {
    /// What was measured.
    pub measured: Option<Measured>,
    /// What is done to the level for a solver.
    pub solver: Option<Plan>,
}

/// Measures, and the surface that they were made on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The first digits of its file's hash, or the name of a sample; never the name of a file.
    pub of: String,
    /// The measures, in the order in which they were made.
    pub measures: Vec<Measure>,
}

/// The settings as the text of a file.
pub fn write_settings(shared: &SharedSettings) -> String {
    write_settings_and(shared, Beside::default())
}

/// The settings and what stands beside them as the text of a file.
pub fn write_settings_and(shared: &SharedSettings, beside: Beside) -> String {
    let SharedSettings { unit, settings } = shared.clone();
    let Beside { measured, solver } = beside;
    let file = File { format: FORMAT.to_owned(), version: VERSION, unit, settings, measured, solver };
    // Nothing in it can fail: there are no maps, and every number that `Settings::check` lets through is finite.
    serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
}

/// Reads the settings that [`write_settings`] has written, in this version or an earlier one.
///
/// # Errors
/// When it is no file of settings, or of a newer version, or a field is unknown, missing or out of range.
pub fn read_settings(bytes: &[u8]) -> Result<SharedSettings, SettingsFileError> {
    Ok(read_settings_and(bytes)?.0)
}

/// Reads the settings and what stands beside them.
///
/// # Errors
/// As [`read_settings`].
pub fn read_settings_and(bytes: &[u8]) -> Result<(SharedSettings, Beside), SettingsFileError> {
    if bytes.len() > LONGEST {
        return Err(SettingsFileError::NoSettings);
    }
    let head: Head = serde_json::from_slice(bytes).map_err(|_| SettingsFileError::NoSettings)?;
    if head.format != FORMAT || head.version == 0 {
        return Err(SettingsFileError::NoSettings);
    }
    if head.version > VERSION {
        return Err(SettingsFileError::Newer { found: head.version, known: VERSION });
    }
    let File { unit, settings, measured, solver, .. } =
        serde_json::from_slice(bytes).map_err(SettingsFileError::Field)?;
    settings.check()?;
    if let Some(plan) = &solver {
        plan.check()?;
    }
    if measured.as_ref().is_some_and(|measured| !are_sound(&measured.measures)) {
        return Err(SettingsFileError::Measures);
    }
    Ok((SharedSettings { unit, settings }, Beside { measured, solver }))
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::super::measures::{Found, MadeOn};
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
    fn measures_stand_beside_the_settings_and_are_read_as_they_were() {
        let outline_mm = vec![[0.1, 0.2, 1e-7], [3.0, 4.5, 6.25]];
        let section = Found::Section {
            centre_mm: [1.0, 2.0, 3.0],
            direction: [0.0, 0.6, 0.8],
            area_mm2: 12.5,
            widths_mm: [3.25, 4.75],
            outline_mm,
            vessel: "branch 1".to_owned(),
            at_fork: true,
        };
        let of = |name: &str, found| Measure { name: name.to_owned(), made_on: MadeOn::Level(1000), found };
        let ruler = Found::Ruler { ends_mm: [[0.0; 3], [1.0, 2.0, 2.0]] };
        let measures = vec![of("Section 1", section), of("Neck", ruler)];
        let measured = Measured { of: "ba7816bf8f01cfea".to_owned(), measures };
        let beside = Beside { measured: Some(measured), solver: Some(Plan::flow()) };
        let text = write_settings_and(&SharedSettings::default(), beside.clone());
        let (shared, read) = read_settings_and(text.as_bytes()).unwrap();
        assert_eq!((shared, read), (SharedSettings::default(), beside));
        assert_eq!(read_settings(text.as_bytes()).unwrap(), SharedSettings::default(), "for whoever asks for no more");
        let negative = text.replace("\"radii\": 5.0", "\"radii\": -5.0");
        assert!(matches!(read_settings(negative.as_bytes()), Err(SettingsFileError::Solver(_))), "{negative}");
        let unknown = text.replace("\"around\"", "\"about\"");
        assert!(matches!(read_settings(unknown.as_bytes()), Err(SettingsFileError::Field(_))));
        let long = text.replace("Neck", &"x".repeat(100));
        assert!(matches!(read_settings(long.as_bytes()), Err(SettingsFileError::Measures)));
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
        for bytes in [
            &b""[..],
            b"{}",
            b"[1]",
            b"\xff\xfe",
            br#"{"format":"other","version":1}"#,
            br#"{"format":"lumen-settings","version":0}"#,
            &[b'['; 4_100_000],
        ] {
            assert!(matches!(read_settings(bytes), Err(SettingsFileError::NoSettings)));
        }
        let mut file = written();
        file["settings"]["smoothing"]["pass_band"] = json!(3.0);
        assert_eq!(refused(&file), "The settings cannot be used: the pass band must lie between 0.001 and 2, not 3.");
    }
}
