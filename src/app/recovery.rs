//! What comes back after a reload: the settings with their steps, the camera, the name of what was open, the axes that
//! were chosen for files which do not state them, and those of haptic devices; and the surface itself where the user has
//! asked for that; and the language that was chosen. It stays on this device ([`Store`]).

use egui::Context;
use serde::{Deserialize, Serialize};

use super::document::Document;
use super::history::History;
use super::platform::{Platform, Storage, Store};
use super::sides::{eye_of, look_from};
use super::state::{State, Step};
use super::trial::Trial;
use crate::engine::{Link, Source};
use crate::haptics::known::KnownMappings;
use crate::io::{Axes, Unit};
use crate::language::Language;
use crate::phantom::Sample;
use crate::pipeline::settings::Settings;
use crate::render::Camera;
use crate::say;
use crate::sharing::Eye;

/// The version of what is kept; another is not read.
const VERSION: u32 = 1;
/// Steps to undo that are kept.
const STEPS: usize = 50;
/// How often a surface that is kept is opened by itself before it has once been shown.
const TRIES: u8 = 2;
/// Files whose axes are known.
const FILES: usize = 100;
/// Seconds between two times that it is written.
const PAUSE_S: f64 = 1.0;

/// What is kept as text.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Session {
    version: u32,
    surface: Option<Surface>,
    history: History<Settings>,
    eye: Eye,
    keeps_surface: bool,
    /// How often the surface that is kept has been opened since it was shown last.
    #[serde(default)]
    tries: u8,
    /// Axes that were chosen for files which do not state theirs, the newest last.
    #[serde(default)]
    axes: Vec<KnownAxes>,
    /// Which axes of haptic devices feed and roll.
    #[serde(default)]
    mappings: KnownMappings,
    /// The tag of the language that was chosen, which another version may not know; `None` for that of the system.
    #[serde(default)]
    language: Option<String>,
}

/// The first digits of a file's hash, by which a link knows it too, and its axes.
type KnownAxes = (String, Axes);

/// What was open, by its name alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Surface {
    Sample(Sample),
    File { name: String, unit: Option<Unit> },
}

impl Session {
    /// What was kept, if this version can use it.
    fn read(text: &str) -> Option<Self> {
        let session: Self = serde_json::from_str(text).ok()?;
        let is_sound = session.version == VERSION && session.history.all().all(|settings| settings.check().is_ok());
        is_sound.then_some(session)
    }

    /// The text to keep. Nothing in it can fail: it has no maps, and every number is one.
    fn text(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// What was open before.
struct Returning {
    surface: Surface,
    eye: Eye,
    history: History<Settings>,
    /// Whether it was given up: the program has ended too often while it was opened by itself.
    is_given_up: bool,
}

impl Returning {
    /// Whether the settings are those that it was left with, but for the piece that is kept of it.
    fn is_as_left(&self, settings: &Settings) -> bool {
        let left = self.history.present();
        *left == Settings { keep: left.keep, ..settings.clone() }
    }

    /// The settings that it was left with, now that it is open again: pieces have their numbers in it alone.
    fn settle(self, state: &mut State) {
        let Some(pieces) = state.document.as_ref().map(|document| &document.pieces) else { return };
        if !self.history.all().all(|settings| pieces.has(settings.keep)) {
            return;
        }
        let settings = self.history.present().clone();
        if self.is_as_left(&state.settings) {
            let unit = state.asked_unit();
            state.history = self.history.map(|settings| Step::of(settings, unit));
        }
        state.settings.keep = settings.keep;
    }
}

/// By what it is known whether something has changed.
type Key = (Settings, Eye, Option<Surface>, bool, Vec<KnownAxes>, KnownMappings, Option<Language>);

/// What stands now, to be kept.
#[derive(Clone, Copy)]
pub(super) struct Now<'a> {
    pub(super) state: &'a State,
    pub(super) trial: &'a Trial,
    pub(super) camera: &'a Camera,
    /// The language that was chosen.
    pub(super) language: Option<Language>,
}

/// What is kept, and what of it has not come back yet.
#[derive(Default)]
pub(super) struct Recovery {
    /// What was open before, until it is open again or another is.
    returning: Option<Returning>,
    /// From where the surface that has just been opened is to be looked at.
    eye: Option<Eye>,
    /// Whether surfaces are kept.
    keeps_surface: bool,
    axes: Vec<KnownAxes>,
    /// What was written last, and when.
    written: Option<Key>,
    written_at_s: f64,
    /// Whether everything was forgotten, and nothing was opened since.
    is_forgotten: bool,
}

impl Recovery {
    /// Brings back what was kept; where that is nothing, a sample is opened. A surface that nothing is known of, or that is
    /// no longer wanted, is forgotten.
    pub(super) fn begin(state: &mut State, trial: &mut Trial, platform: &mut dyn Platform) -> Self {
        let session = platform.store().and_then(|store| store.text()).and_then(|text| Session::read(&text));
        let Some(session) = session else {
            if let Some(store) = platform.store() {
                store.forget_surface();
            }
            state.open_sample(Sample::Aorta, platform.link());
            return Self::default();
        };
        let Session { surface, history, eye, keeps_surface, tries, axes, mappings, .. } = session.clone();
        trial.set_known_mappings(mappings);
        state.settings = history.present().clone();
        state.history = history.map(|settings| Step::of(settings, None));
        let is_kept = keeps_surface && matches!(surface, Some(Surface::File { .. }));
        let is_given_up = is_kept && tries >= TRIES;
        let returning = surface.map(|surface| Returning { surface, eye, history, is_given_up });
        let recovery = Self { returning, keeps_surface, axes, ..Self::default() };
        match platform.store() {
            Some(store) if is_kept && !is_given_up => {
                store.set_text(&Session { tries: tries + 1, ..session }.text());
                // Nothing else is opened until it has answered.
                store.restore_surface();
            }
            store => {
                if let Some(store) = store {
                    store.forget_surface();
                }
                recovery.stand_in(state, platform.link());
            }
        }
        recovery
    }

    /// Opens what stands there as long as the file is not: the sample that was open, or the first.
    fn stand_in(&self, state: &mut State, link: &mut dyn Link) {
        let sample = match self.returning.as_ref().map(|returning| &returning.surface) {
            Some(Surface::Sample(sample)) => *sample,
            Some(Surface::File { .. }) | None => Sample::Aorta,
        };
        state.open_sample(sample, link);
    }

    /// Hears what the store had kept. Whatever was opened meanwhile was asked for later.
    pub(super) fn restored(&mut self, file: Option<(String, Vec<u8>)>, state: &mut State, platform: &mut dyn Platform) {
        if state.document.is_some() || state.opening().is_some() {
            return;
        }
        match (file, self.returning.as_ref().map(|returning| &returning.surface)) {
            (Some((name, bytes)), Some(Surface::File { name: returning, .. })) if name == *returning => {
                self.before_file(&name, state);
                state.open_file(name, bytes, platform.link());
            }
            // Another page has kept another.
            _ => self.stand_in(state, platform.link()),
        }
    }

    /// Before a file is read: its numbers are in the unit that they were in before, unless the user has chosen one.
    pub(super) fn before_file(&self, file: &str, state: &mut State) {
        if let Some(Surface::File { name, unit }) = self.returning.as_ref().map(|returning| &returning.surface)
            && name == file
        {
            state.next_unit = state.next_unit.or(*unit);
        }
    }

    /// Hears that a surface was opened and has its levels; the views `look` at it anew, or do not.
    pub(super) fn opened(&mut self, state: &mut State, look: bool, platform: &mut dyn Storage) {
        self.is_forgotten = false;
        self.keep_surface(state, platform);
        if let Some(document) = state.document.as_mut().filter(|document| !document.states_axes)
            && let Some(digits) = digits(document)
            && let Some((_, axes)) = self.axes.iter().find(|(known, _)| *known == digits)
        {
            document.import.axes = *axes;
        }
        let (Some(open), Some(returning)) = (surface(state), self.returning.take()) else { return };
        match (&returning.surface, &open) {
            (Surface::File { name, .. }, Surface::File { name: opened, .. }) if name == opened => {
                state.tell(&say!("app-file-back", name = name));
                self.eye = look.then_some(returning.eye);
                returning.settle(state);
            }
            (kept, open) if kept == open => {
                state.tell(&say!("app-settings-back"));
                self.eye = look.then_some(returning.eye);
                returning.settle(state);
            }
            // A sample stands in for the file.
            (Surface::File { name, .. }, Surface::Sample(_)) => {
                let text = if returning.is_given_up {
                    say!("app-file-before-given-up", name = name)
                } else {
                    say!("app-file-before", name = name)
                };
                state.ask(&text);
                self.returning = Some(returning);
            }
            _ => {}
        }
    }

    /// Hears which axes the surface has whose file does not state them: with the same file they come back.
    pub(super) fn choose_axes(&mut self, state: &mut State, axes: Axes) {
        let Some(document) = &mut state.document else { return };
        document.import.axes = axes;
        let Some(digits) = digits(document) else { return };
        self.axes.retain(|(known, _)| *known != digits);
        if axes != Axes::Unknown {
            self.axes.push((digits, axes));
        }
        self.axes.drain(..self.axes.len().saturating_sub(FILES));
    }

    /// Moves the camera, which has found the new surface, to where it stood with it before.
    pub(super) fn look(&mut self, camera: &mut Camera) {
        if let Some(eye) = self.eye.take() {
            look_from(eye, camera);
        }
    }

    /// Whether surfaces are kept; `None` where the platform keeps nothing.
    pub(super) fn keeps(&self, platform: &mut dyn Storage) -> Option<bool> {
        platform.store().map(|_| self.keeps_surface)
    }

    /// Keeps the surfaces that are opened from now on, or does so no longer.
    pub(super) fn keep_surfaces(&mut self, keeps: bool, state: &mut State, platform: &mut dyn Storage) {
        self.keeps_surface = keeps;
        self.is_forgotten &= !keeps;
        if keeps {
            self.keep_surface(state, platform);
            let text = match surface(state) {
                Some(Surface::File { name, .. }) => say!("app-surfaces-kept-and-this", name = name),
                Some(Surface::Sample(_)) | None => say!("app-surfaces-kept"),
            };
            state.tell(&text);
        } else if let Some(store) = platform.store() {
            store.forget_surface();
            state.tell(&say!("app-surfaces-not-kept"));
        }
    }

    /// Forgets everything that is kept.
    pub(super) fn forget(&mut self, state: &mut State, trial: &mut Trial, platform: &mut dyn Storage) {
        self.keeps_surface = false;
        self.returning = None;
        self.axes.clear();
        trial.set_known_mappings(KnownMappings::default());
        if let Some(store) = platform.store() {
            store.forget();
        }
        self.is_forgotten = true;
        self.written = None;
        state.tell(&say!("app-forgotten"));
    }

    fn keep_surface(&self, state: &State, platform: &mut dyn Storage) {
        let Some(store) = platform.store().filter(|_| self.keeps_surface) else { return };
        match state.document.as_ref().map(|document| &document.source) {
            Some(Source::File { name, bytes, .. }) => store.keep_surface(name, bytes),
            // A sample can be made again; of a scan nothing is kept.
            Some(Source::Sample { .. } | Source::Made { .. }) | None => store.forget_surface(),
        }
    }

    /// To be called each frame: writes what has changed, not more than once a second.
    pub(super) fn follow(&mut self, now: Now<'_>, platform: &mut dyn Storage, ctx: &Context) {
        let Some(store) = platform.store() else { return };
        let (key, state) = (self.key(now), now.state);
        // A surface that has no level yet may be the end of the program.
        if self.is_forgotten || state.document.is_none() || state.awaits_levels() || self.written.as_ref() == Some(&key)
        {
            return;
        }
        let now_s = ctx.input(|input| input.time);
        let rest_s = self.written_at_s + PAUSE_S - now_s;
        if self.written.is_some() && rest_s > 0.0 {
            ctx.request_repaint_after_secs(rest_s as f32);
            return;
        }
        self.write(state, &key, store);
        self.written_at_s = now_s;
        self.written = Some(key);
    }

    fn key(&self, Now { state, trial, camera, language }: Now<'_>) -> Key {
        let returning = self.returning.as_ref();
        let surface = returning.map(|returning| returning.surface.clone()).or_else(|| surface(state));
        // The view of a sample that stands in for a file is not the file's.
        let eye = returning.map(|returning| returning.eye).or(self.eye).unwrap_or(eye_of(camera));
        let (settings, mappings) = (state.history.present().settings.clone(), trial.known_mappings().clone());
        (settings, eye, surface, self.keeps_surface, self.axes.clone(), mappings, language)
    }

    fn write(&self, state: &State, key: &Key, store: &mut dyn Store) {
        let (_, eye, surface, keeps_surface, axes, mappings, language) = key.clone();
        let language = language.map(|language| language.tag().to_owned());
        let present = &state.history.present().settings;
        let returning = self.returning.as_ref().filter(|returning| returning.is_as_left(present));
        let mut history = match returning {
            Some(returning) => returning.history.recent(STEPS),
            None => state.history.map(|step| step.settings.clone()).recent(STEPS),
        };
        // Steps that measured something change no setting.
        history.change_all(|_| {});
        let (version, tries) = (VERSION, 0);
        let session = Session { version, surface, history, eye, keeps_surface, tries, axes, mappings, language };
        store.set_text(&session.text());
    }
}

/// The language that was chosen before, if one was: it is spoken before anything is brought back.
pub(super) fn language(platform: &mut dyn Storage) -> Option<Language> {
    Language::of_tag(&Session::read(&platform.store()?.text()?)?.language?)
}

/// By what the file that is open is known, if it is one.
fn digits(document: &Document) -> Option<String> {
    document.digest.map(|digest| digest.short().to_string())
}

/// What is open, by its name.
fn surface(state: &State) -> Option<Surface> {
    Some(match &state.document.as_ref()?.source {
        Source::Sample { sample, .. } => Surface::Sample(*sample),
        Source::File { name, options, .. } => Surface::File { name: name.clone(), unit: options.unit },
        // Names of scans are often those of patients.
        Source::Made { .. } => return None,
    })
}
