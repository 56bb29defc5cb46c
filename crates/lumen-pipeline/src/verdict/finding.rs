//! A verdict, and what it is made of.

use serde::{Deserialize, Serialize};

use super::super::settings::Settings;
use lumen_io::Unit;

/// A place to look at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// In mm.
    pub at_mm: [f32; 3],
    /// How wide the vessel is there, in mm.
    pub width_mm: f64,
    /// What there is to say of it, in a few words.
    pub label: String,
}

/// Something that would help.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remedy {
    /// What it is called.
    pub words: String,
    /// What is to be changed.
    pub change: Remedied,
}

/// What a remedy changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Remedied {
    /// These settings in place of those that were used.
    Settings(Box<Settings>),
    /// The file is read with its numbers in this unit.
    Unit(Unit),
}

/// Something to say of a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// One or two sentences.
    pub text: String,
    /// Whether a trial had better not rest on the result; else it is a note.
    pub is_grave: bool,
    /// Where it is; null where it is everywhere or nowhere.
    pub place: Option<Place>,
    /// What would help.
    pub remedies: Vec<Remedy>,
}

impl Finding {
    pub(super) fn grave(text: String) -> Self {
        Self { text, is_grave: true, place: None, remedies: Vec::new() }
    }

    pub(super) fn note(text: String) -> Self {
        Self { is_grave: false, ..Self::grave(text) }
    }

    pub(super) fn at(self, at_mm: [f32; 3], width_mm: f64, label: String) -> Self {
        Self { place: Some(Place { at_mm, width_mm, label }), ..self }
    }

    pub(super) fn helped_by(mut self, remedy: Option<Remedy>) -> Self {
        self.remedies.extend(remedy);
        self
    }
}

/// The verdict on a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// In a few words.
    pub head: String,
    /// Whether a trial may rest on it; null while that is not known.
    pub is_safe: Option<bool>,
    /// What is said of the vessels; null where they are not measured.
    pub calibre: Option<String>,
    /// Grave ones first, in the order of their weight.
    pub findings: Vec<Finding>,
}

impl Verdict {
    /// The head, and what is weightiest: a sentence each.
    pub fn in_short(&self) -> String {
        let grave = self.findings.first().filter(|finding| finding.is_grave).map(|finding| &finding.text);
        match grave.or(self.calibre.as_ref()) {
            Some(text) => format!("{}. {text}", self.head.trim_end_matches('.')),
            None => format!("{}.", self.head.trim_end_matches('.')),
        }
    }
}
