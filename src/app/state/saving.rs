//! The files that the engine makes of what is open, from asking for one to telling that it was saved.

use super::State;
use crate::engine::{Command, Link};
use crate::io::{Axes, Format};
use crate::prepare::write::SolverFormat;
use crate::say;
use crate::vessel::CentrelineFormat;

impl State {
    /// Asks for the shown level as a file.
    pub fn save(&mut self, format: Format, link: &mut dyn Link) {
        let Some((document, mesh)) = self.document.as_ref().and_then(|d| Some((d, d.shown_mesh()?))) else {
            self.tell(&say!("app-nothing-to-save"));
            return;
        };
        let name = format!("{}-{}.{}", document.stem(), mesh.triangles.len(), format.extension());
        let axes = document.import.axes;
        let to = self.axes_of_file(axes);
        self.ask_for_file(&name.clone(), Command::Write { name, format, mesh, axes, to }, link);
    }

    /// What a file's coordinates grow towards, of a surface with these axes: what is not known cannot be turned.
    fn axes_of_file(&self, axes: Axes) -> Axes {
        self.written_axes.filter(|_| axes != Axes::Unknown).unwrap_or(axes)
    }

    /// Asks for the newest level and coarser ones in one file.
    pub fn save_levels(&mut self, link: &mut dyn Link) {
        let Some(document) = &self.document else { return };
        let name = format!("{}-levels.glb", document.stem());
        let axes = document.import.axes;
        let to = self.axes_of_file(axes);
        self.ask_for_file(&name.clone(), Command::WriteLevels { name, axes, to }, link);
    }

    /// Asks for the centrelines of the surface that is open as a file.
    pub fn save_centrelines(&mut self, format: CentrelineFormat, link: &mut dyn Link) {
        let Some(document) = &self.document else { return };
        let name = format!("{}-centrelines.{}", document.stem(), format.extension());
        self.ask_for_file(&name.clone(), Command::WriteCentrelines { name, format }, link);
    }

    /// Asks for the surface that was made ready for a solver as a file.
    pub fn save_for_solver(&mut self, format: SolverFormat, link: &mut dyn Link) {
        let (Some(document), Some(made)) = (&self.document, &self.preparation.made) else { return };
        let extension = if format.is_folder() { "zip" } else { format.extension() };
        let name = format!("{}-solver.{extension}", document.stem());
        let (id, names) = (made.id, self.preparation.names());
        self.ask_for_file(&name.clone(), Command::WriteSolver { id, name, format, names }, link);
    }

    /// The calibre of each vessel as a file, a row a place: its name and its bytes.
    pub fn calibre_table(&self) -> Option<(String, Vec<u8>)> {
        let (document, calibre) = (self.document.as_ref()?, self.calibre()?);
        let found = calibre.found.as_ref().ok()?;
        Some((format!("{}-calibre.csv", document.stem()), found.csv().into_bytes()))
    }

    /// Sends a command that ends in a file called `name`.
    pub(in crate::app) fn ask_for_file(&mut self, name: &str, command: Command, link: &mut dyn Link) {
        // An engine that has stopped too often with the surface open can still make a file.
        self.wake(link);
        self.notices.clear();
        self.writing.push(name.to_owned());
        link.send(command);
    }

    /// Hears that a file which was asked for is there, or is not to come.
    pub(in crate::app) fn forget_file(&mut self, name: &str) {
        if let Some(at) = self.writing.iter().position(|writing| writing == name) {
            self.writing.remove(at);
        }
    }

    /// Forgets the files that an engine which is no more was to make; a sentence on each, after a space.
    pub(super) fn lost_files(&mut self) -> String {
        self.writing.drain(..).map(|name| format!(" {}", say!("app-save-again", name = name))).collect()
    }

    /// Notes, for when a file is saved, what is not in it.
    pub(in crate::app) fn leave_out(&mut self, sentence: &str) {
        self.left_out = Some(sentence.to_owned());
    }

    /// Tells that a file was saved, and what is not in it.
    pub fn saved(&mut self, message: &str) {
        match self.left_out.take() {
            Some(sentence) => self.tell(&format!("{message} {sentence}")),
            None => self.tell(message),
        }
    }
}
