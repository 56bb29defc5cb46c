//! What comes back after a reload: the settings with their steps, the camera, the name of what was open; and the surface
//! itself where the user has asked for that. It stays on this device ([`Store`]).

use egui::Context;
use serde::{Deserialize, Serialize};

use super::history::History;
use super::platform::{Platform, Store};
use super::state::State;
use crate::engine::{Link, Source};
use crate::io::Unit;
use crate::phantom::Sample;
use crate::pipeline::settings::Settings;
use crate::render::Camera;

/// Something of what is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Keep the surfaces that are opened for the next start, or do so no longer.
    KeepSurface(bool),
    /// Forget everything that is kept.
    Forget,
}

/// The version of what is kept; another is not read.
const VERSION: u32 = 1;
/// Steps to undo that are kept.
const STEPS: usize = 50;
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
}

/// What was open, by its name alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Surface {
    Sample(Sample),
    File { name: String, unit: Option<Unit> },
}

/// From where it was looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Eye {
    target_mm: [f32; 3],
    rotation: [f32; 4],
    distance_mm: f32,
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

impl Eye {
    fn of(camera: &Camera) -> Self {
        let Camera { target, rotation, distance, .. } = camera;
        Self { target_mm: target.to_array(), rotation: rotation.to_array(), distance_mm: *distance }
    }

    /// Moves the camera there, unless that is nowhere.
    fn look(self, camera: &mut Camera) {
        let rotation = glam::Quat::from_array(self.rotation);
        if rotation.is_normalized() && self.distance_mm > 0.0 && self.target_mm.iter().all(|x| x.is_finite()) {
            *camera = Camera { target: self.target_mm.into(), rotation, distance: self.distance_mm, ..*camera };
        }
    }
}

/// What is kept, and what of it has not come back yet.
#[derive(Default)]
pub(super) struct Recovery {
    /// What was open before, until it is open again or another is.
    returning: Option<(Surface, Eye)>,
    /// From where the surface that has just been opened is to be looked at.
    eye: Option<Eye>,
    /// Whether surfaces are kept.
    keeps_surface: bool,
    /// What was written last, and when.
    written: Option<(Settings, Eye, Option<Surface>, bool)>,
    written_at_s: f64,
    /// Whether everything was forgotten, and nothing has changed since.
    is_forgotten: bool,
}

impl Recovery {
    /// Brings back what was kept; where that is nothing, a sample is opened.
    pub(super) fn begin(state: &mut State, platform: &mut dyn Platform) -> Self {
        let session = platform.store().and_then(|store| store.text()).and_then(|text| Session::read(&text));
        let Some(session) = session else {
            state.open_sample(Sample::Aorta, platform.link());
            return Self::default();
        };
        let Session { surface, history, eye, keeps_surface, .. } = session.clone();
        state.settings = history.present().clone();
        state.history = history;
        let is_file = matches!(surface, Some(Surface::File { .. }));
        let recovery = Self { returning: surface.map(|it| (it, eye)), keeps_surface, ..Self::default() };
        if let Some(store) = platform.store().filter(|_| is_file && keeps_surface) {
            // A surface that should end the program is not brought back again and again: it counts as kept once it is open.
            let until_then = Session { keeps_surface: false, ..session };
            store.set_text(&until_then.text());
            // Nothing else is opened until it has answered.
            store.restore_surface();
        } else {
            recovery.stand_in(state, platform.link());
        }
        recovery
    }

    /// Opens what stands there as long as the file is not: the sample that was open, or the first.
    fn stand_in(&self, state: &mut State, link: &mut dyn Link) {
        let sample = match &self.returning {
            Some((Surface::Sample(sample), _)) => *sample,
            Some((Surface::File { .. }, _)) | None => Sample::Aorta,
        };
        state.open_sample(sample, link);
    }

    /// Hears what the store had kept.
    pub(super) fn restored(&mut self, file: Option<(String, Vec<u8>)>, state: &mut State, link: &mut dyn Link) {
        match file {
            Some((name, bytes)) => {
                self.before_file(&name, state);
                state.open_file(name, bytes, link);
            }
            None => self.stand_in(state, link),
        }
    }

    /// Before a file is read: its numbers are in the unit that they were in before, unless the user has chosen one.
    pub(super) fn before_file(&self, file: &str, state: &mut State) {
        if let Some((Surface::File { name, unit }, _)) = &self.returning
            && name == file
        {
            state.next_unit = state.next_unit.or(*unit);
        }
    }

    /// Hears that a surface was opened.
    pub(super) fn opened(&mut self, state: &mut State, platform: &mut dyn Platform) {
        let Some(open) = surface(state) else { return };
        self.keep_surface(state, platform);
        match (self.returning.take(), &open) {
            (Some((Surface::File { name, .. }, eye)), Surface::File { name: opened, .. }) if name == *opened => {
                self.eye = Some(eye);
                state.tell(&format!("{name} is back, with the settings and the view that it was left with."));
            }
            (Some((kept, eye)), open) if kept == *open => {
                self.eye = Some(eye);
                state.tell("The settings and the view are as they were left.");
            }
            // A sample stands in for the file.
            (Some((Surface::File { name, unit }, eye)), Surface::Sample(_)) => {
                state.tell(&format!(
                    "{name} was open before. Open it again: the settings are as they were, and the view will be."
                ));
                self.returning = Some((Surface::File { name, unit }, eye));
            }
            _ => {}
        }
    }

    /// Moves the camera, which has found the new surface, to where it stood with it before.
    pub(super) fn look(&mut self, camera: &mut Camera) {
        if let Some(eye) = self.eye.take() {
            eye.look(camera);
        }
    }

    /// Whether surfaces are kept; `None` where the platform keeps nothing.
    pub(super) fn keeps(&self, platform: &mut dyn Platform) -> Option<bool> {
        platform.store().map(|_| self.keeps_surface)
    }

    /// Does what is asked for.
    pub(super) fn act(&mut self, action: Action, state: &mut State, platform: &mut dyn Platform) {
        match action {
            Action::KeepSurface(keeps) => {
                self.keeps_surface = keeps;
                if keeps {
                    self.keep_surface(state, platform);
                    state.tell("The surface that is open is kept on this device for the next start.");
                } else if let Some(store) = platform.store() {
                    store.forget_surface();
                    state.tell("No surface is kept on this device any more.");
                }
            }
            Action::Forget => {
                self.keeps_surface = false;
                self.returning = None;
                if let Some(store) = platform.store() {
                    store.forget();
                }
                self.is_forgotten = true;
                state.tell("Everything that was kept on this device is forgotten: settings, names, and surfaces.");
            }
        }
    }

    fn keep_surface(&self, state: &State, platform: &mut dyn Platform) {
        let Some(store) = platform.store().filter(|_| self.keeps_surface) else { return };
        match state.document.as_ref().map(|document| &document.source) {
            Some(Source::File { name, bytes, .. }) => store.keep_surface(name, bytes),
            // A sample can be made again; of a scan nothing is kept.
            Some(Source::Sample { .. } | Source::Made { .. }) | None => store.forget_surface(),
        }
    }

    /// To be called each frame: writes what has changed, not more than once a second.
    pub(super) fn follow(&mut self, state: &State, camera: &Camera, platform: &mut dyn Platform, ctx: &Context) {
        let Some(store) = platform.store() else { return };
        let eye = Eye::of(camera);
        let key = self.key(state, eye);
        if std::mem::take(&mut self.is_forgotten) {
            self.written = Some(key);
            return;
        }
        if state.document.is_none() || self.written.as_ref() == Some(&key) {
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

    /// By what it is known whether something has changed.
    fn key(&self, state: &State, eye: Eye) -> (Settings, Eye, Option<Surface>, bool) {
        let surface = self.returning.as_ref().map(|(surface, _)| surface.clone()).or_else(|| surface(state));
        // The view of a sample that stands in for a file is not the file's.
        let eye = self.returning.as_ref().map(|(_, eye)| *eye).or(self.eye).unwrap_or(eye);
        (state.history.present().clone(), eye, surface, self.keeps_surface)
    }

    fn write(&self, state: &State, key: &(Settings, Eye, Option<Surface>, bool), store: &mut dyn Store) {
        let (_, eye, surface, keeps_surface) = key.clone();
        let history = state.history.recent(STEPS);
        store.set_text(&Session { version: VERSION, surface, history, eye, keeps_surface }.text());
    }
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
