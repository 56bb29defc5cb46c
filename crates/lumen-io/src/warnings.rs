//! What a user should hear about a surface that was imported, in sentences.

use super::report::{ImportReport, Skipped};
use super::size::length;
use lumen_language::Key;
use lumen_language::say;

/// What is said of a surface whose windings cannot be made to agree.
pub const NO_INSIDE: Key = Key("errors-no-inside");

impl ImportReport {
    /// The warnings, with those on what was found and mended in the language that is spoken now: it may be another than when
    /// the file was read.
    pub fn warnings_now(&self) -> Vec<String> {
        let mut sentences = sentences(self);
        if sentences.iter().all(|sentence| self.warnings.contains(sentence)) {
            return self.warnings.clone();
        }
        // They are the last.
        let mut warnings = self.warnings[..self.warnings.len().saturating_sub(sentences.len())].to_vec();
        warnings.append(&mut sentences);
        warnings
    }
}

/// What a user should hear about.
pub(super) fn sentences(report: &ImportReport) -> Vec<String> {
    let mut sentences = Vec::new();
    sentences.extend(report.unusual_size().map(|found| found.sentence));
    if report.moved_mm != [0.0; 3] {
        let [x, y, z] = report.moved_mm.map(length);
        sentences.push(say!("errors-moved", x = x, y = y, z = z));
    }
    let Skipped { short_faces, lines, points } = report.skipped;
    let (degenerate, duplicate) = (report.degenerate_triangles, report.duplicate_triangles);
    let (reoriented, turned, edges) =
        (report.reoriented_triangles, report.components_turned, report.non_manifold_edges);
    if degenerate > 0 {
        sentences.push(say!("errors-degenerate", count = degenerate, number = degenerate.to_string()));
    }
    if duplicate > 0 {
        sentences.push(say!("errors-duplicate", count = duplicate, number = duplicate.to_string()));
    }
    if short_faces > 0 {
        sentences.push(say!("errors-short-faces", count = short_faces, number = short_faces.to_string()));
    }
    if lines > 0 {
        sentences.push(say!("errors-lines-left-out", count = lines, number = lines.to_string()));
    }
    if points > 0 {
        sentences.push(say!("errors-points-left-out", count = points, number = points.to_string()));
    }
    if reoriented > 0 {
        sentences.push(say!("errors-reoriented", count = reoriented, number = reoriented.to_string()));
    }
    if turned > 0 {
        sentences.push(say!("errors-turned", count = turned, number = turned.to_string()));
    }
    if edges > 0 {
        sentences.push(say!("errors-non-manifold", count = edges, number = edges.to_string()));
    }
    if !report.orientable {
        sentences.push(NO_INSIDE.say());
    }
    sentences
}
