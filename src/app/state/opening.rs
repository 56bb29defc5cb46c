//! What is opened, and how it takes the place of what was open: as soon as it is read. What was open before is kept until the
//! new surface has a level, so that a cancel can go back to it.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Before, Effect, Engine, Opening, State};
use crate::app::document::Document;
use crate::engine::{Command, Link, Opened, Source, Work};
use crate::io::{ImportOptions, Unit};
use crate::language::tell;
use crate::phantom::{MIN_TRIANGLES, Sample};
use crate::pipeline::settings::{Keep, Settings};
use crate::sharing::measures::Measure;

impl State {
    /// Opens the file `name`. What is open stays until that is read.
    pub fn open_file(&mut self, name: String, bytes: Vec<u8>, link: &mut dyn Link) {
        let options = ImportOptions { unit: self.next_unit.take() };
        self.open(Source::File { name, bytes: Arc::new(bytes), options }, link);
    }

    /// Opens a sample.
    pub fn open_sample(&mut self, sample: Sample, link: &mut dyn Link) {
        let usual = sample.default_triangles() as u32;
        // Fewer, not more: what asks may be a link from anybody, and a sample is made in one go.
        let asked = self.sample_triangles.map(|asked| asked.clamp(MIN_TRIANGLES as u32, usual));
        self.open(Source::Sample { sample, triangles: asked.unwrap_or(usual) }, link);
    }

    /// Opens a surface, of all of which the largest piece is kept.
    pub fn open(&mut self, source: Source, link: &mut dyn Link) {
        self.open_again(source, Arc::default(), link);
    }

    /// As [`Self::open`], with what was measured on it before.
    pub fn open_again(&mut self, source: Source, measures: Arc<Vec<Measure>>, link: &mut dyn Link) {
        self.wake(link);
        self.number += 1;
        let id = self.number;
        let settings = Settings { keep: Keep::Largest, ..self.settings.clone() };
        link.send(Command::Open { id, source: source.clone(), settings: settings.clone() });
        self.opening.push(Opening { id, source, settings, measures });
        self.work = Some((Work::Reading, 0.0));
        self.notices.clear();
    }

    /// Opens the file that is shown again, with its numbers in `unit`, or for `None` in that of its format. Samples have
    /// theirs.
    pub fn set_unit(&mut self, unit: Option<Unit>, link: &mut dyn Link) {
        if let Some(Source::File { name, bytes, .. }) = self.document.as_ref().map(|document| &document.source) {
            let options = ImportOptions { unit };
            let source = Source::File { name: name.clone(), bytes: bytes.clone(), options };
            self.open(source, link);
        }
    }

    /// The unit that was chosen for the open file, also where it is still being read in it.
    pub fn asked_unit(&self) -> Option<Unit> {
        let open = &self.document.as_ref()?.source;
        let again = self.opening.last().map(|opening| &opening.source).filter(|source| source.is_same_file(open));
        match again.unwrap_or(open) {
            Source::File { options, .. } => options.unit,
            Source::Sample { .. } | Source::Made { .. } => None,
        }
    }

    /// The name of the surface that is being read.
    pub fn opening(&self) -> Option<Cow<'_, str>> {
        self.opening.last().map(|opening| opening.source.label())
    }

    pub(super) fn receive_opened(&mut self, opened: Opened) -> Option<Effect> {
        self.engine = Engine::Loaded;
        if let Some(at) = self.opening.iter().position(|opening| opening.id == opened.id) {
            // The engine gives up what it was asked for before.
            let Opening { source, settings, measures, .. } = self.opening.drain(..=at).next_back()?;
            self.arrive(Document::new(source, opened), settings, &measures);
            return Some(Effect::Opened);
        }
        // Others were read again by a new engine, and are shown already.
        if let Some(document) = &mut self.document
            && document.digest == opened.digest
            && document.opened != opened.mesh
        {
            // What was mended before the engine stopped is mended again.
            document.set_mended(opened.mesh);
        }
        None
    }

    /// A surface that is read takes the place of the one that is open.
    fn arrive(&mut self, document: Document, settings: Settings, measures: &Arc<Vec<Measure>>) {
        let keep = self.settings.keep;
        let is_same = self.document.as_ref().is_some_and(|before| before.source.is_same_file(&document.source));
        let before = self.document.replace(document);
        let unit = self.asked_unit();
        // Of two that follow each other the one that had a level can be gone back to.
        if self.before.is_none() {
            let (measures, history) = (self.measures.clone(), self.history.clone());
            let cuts = self.preparation.plan.cuts.clone();
            self.before = Some(Box::new(Before { document: before, keep, measures, cuts, history }));
        }
        if !is_same {
            self.preparation.plan.cuts.clear();
        }
        // Pieces are numbered in one surface only.
        self.settings.keep = Keep::Largest;
        // What was measured belongs to the surface that is closed.
        self.measures.clone_from(measures);
        self.history.change_all(|step| {
            step.settings.keep = Keep::Largest;
            step.measures.clone_from(measures);
            // Read in another unit it is another step; another file has its own.
            if !is_same {
                step.unit = unit;
                step.plan.cuts.clear();
            }
        });
        self.is_stopped = false;
        // What was moved meanwhile follows.
        self.sent = settings;
        self.is_cancelling = false;
        self.shows_averaged = false;
        let Some(document) = &self.document else { return };
        self.generation = document.revision.document;
        if let Some(warning) = document.import.warnings.first().map(|warning| tell(warning)) {
            self.tell(&warning);
        }
    }

    /// Gives up the surface that has no level yet: what was open before it is again. Says what to tell the others.
    pub(super) fn go_back(&mut self) -> Option<Effect> {
        let Before { document, keep, measures, cuts, history } = *self.before.take()?;
        self.preparation.plan.cuts = cuts;
        (self.document, self.settings.keep, self.measures, self.history) = (document, keep, measures, history);
        Some(Effect::Opened)
    }
}
