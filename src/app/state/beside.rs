//! The open surface beside another file: which file, what is asked of the engine, and the numbers as files.

use std::sync::Arc;

use super::State;
use crate::app::reference::against::Question;
use crate::engine::{Command, Judged, Link, Source};
use crate::io::ImportOptions;
use crate::pipeline::beside::FileFrame;
use crate::say;

impl State {
    /// Whether a file that was chosen, or dropped, is what the open surface is compared with.
    pub(in crate::app) fn takes_reference(&mut self) -> bool {
        self.against.takes_file() && self.document.is_some()
    }

    /// Compares the open surface with the file `name`.
    pub fn compare_with(&mut self, name: String, bytes: Vec<u8>) {
        self.leave_modes();
        self.notices.clear();
        let options = ImportOptions { unit: self.next_unit.take() };
        self.against.take(Source::File { name, bytes: Arc::new(bytes), options });
    }

    /// What is to be asked about the surface and the other file, and was not yet. Where the level is to be compared, there
    /// has to be one.
    pub(super) fn next_question(&self) -> Option<Question> {
        let document = self.document.as_ref()?;
        let is_there = document.shown.is_some() || !self.against.of_level;
        let (revision, axes) = (document.revision, document.import.axes);
        self.against.next(revision, axes, self.settings.tolerance_percent).filter(|_| is_there)
    }

    /// Asks the engine for what is to be known of the two.
    pub(super) fn compare_with_file(&mut self, link: &mut dyn Link) {
        let (Some(question), Some(document)) = (self.next_question(), &self.document) else { return };
        let Some(reference) = self.against.source.clone() else { return };
        let of_level = self.against.of_level;
        let Some(mesh) = (if of_level { document.shown_mesh().map(Arc::new) } else { Some(document.opened.clone()) })
        else {
            return;
        };
        let name = document.title();
        let is_mended = !self.settings.mending.is_off();
        let of = Judged {
            name: match (of_level, is_mended) {
                (true, _) => say!("reference-level-of", name = name),
                (false, true) => say!("reference-mended", name = name),
                (false, false) => name.into_owned(),
            },
            digest: document.digest.filter(|_| !of_level && !is_mended),
            frame: FileFrame::from(&document.import),
        };
        self.number += 1;
        let (align, tolerance_percent) = (self.against.align, self.settings.tolerance_percent);
        self.against.ask(self.number, question);
        link.send(Command::Beside { id: self.number, reference, mesh, of, align, tolerance_percent });
    }

    /// The numbers of the comparison as a file, as `lumen compare --report` writes them: its name and its bytes.
    pub fn compared_numbers(&self) -> Option<(String, Vec<u8>)> {
        let (document, found) = (self.document.as_ref()?, self.against.answer()?.ok()?);
        let bytes = serde_json::to_vec_pretty(&found.two.report).ok()?;
        Some((format!("{}-compared.json", document.stem()), bytes))
    }

    /// The table of stations of the comparison as a file.
    pub fn compared_stations(&self) -> Option<(String, Vec<u8>)> {
        let (document, found) = (self.document.as_ref()?, self.against.answer()?.ok()?);
        Some((format!("{}-compared.csv", document.stem()), found.two.csv.clone()?.into_bytes()))
    }
}
