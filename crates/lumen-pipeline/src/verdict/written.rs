//! A verdict as it is written for programs. The names of the fields are public and stay; its sentences are English.

use serde::{Deserialize, Serialize};

use super::finding::{Finding, Place, Remedied, Remedy, Verdict};
use lumen_vessel::summary::CalibreSummary;

/// The verdict on a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerdictReport {
    /// In a few words, with how much is measured.
    pub head: String,
    /// Whether a trial may rest on it; null while that is not known, and where too little is measured to say.
    pub is_safe: Option<bool>,
    /// What is said of the vessels; null where they are not measured.
    pub calibre: Option<String>,
    /// Grave ones first, in the order of their weight.
    pub findings: Vec<FindingReport>,
}

/// Something to say of a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FindingReport {
    /// One or two sentences.
    pub text: String,
    /// Whether a trial had better not rest on the result; else it is a note.
    pub is_grave: bool,
    /// Where it is; null where it is everywhere or nowhere.
    pub place: Option<PlaceReport>,
    /// What would help.
    pub remedies: Vec<RemedyReport>,
}

/// A place to look at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceReport {
    /// In mm.
    pub at_mm: [f32; 3],
    /// How wide the vessel is there, in mm.
    pub width_mm: f64,
    /// What there is to say of it, in a few words.
    pub label: String,
}

/// Something that would help.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RemedyReport {
    /// What it is called.
    pub words: String,
    /// What is to be changed.
    pub change: Remedied,
}

impl From<&Verdict> for VerdictReport {
    fn from(verdict: &Verdict) -> Self {
        Self {
            head: verdict.head_text().to_string(),
            is_safe: verdict.is_safe,
            calibre: verdict.calibre.as_ref().map(CalibreSummary::to_string),
            findings: verdict.findings.iter().map(FindingReport::from).collect(),
        }
    }
}

impl From<&Finding> for FindingReport {
    fn from(finding: &Finding) -> Self {
        Self {
            text: finding.what.to_string(),
            is_grave: finding.is_grave,
            place: finding.place.as_ref().map(PlaceReport::from),
            remedies: finding.remedies.iter().map(RemedyReport::from).collect(),
        }
    }
}

impl From<&Place> for PlaceReport {
    fn from(place: &Place) -> Self {
        Self { at_mm: place.at_mm, width_mm: place.width_mm, label: place.label.to_string() }
    }
}

impl From<&Remedy> for RemedyReport {
    fn from(remedy: &Remedy) -> Self {
        Self { words: remedy.label.to_string(), change: remedy.change.clone() }
    }
}
