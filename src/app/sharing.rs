//! Settings for others: as a file and in a link. A link says which file it is for; whoever opens it is told whether what is
//! open is that file.

use super::document::Document;
use super::platform::{Files, Sharing as PageSharing};
use super::sides::{eye_of, look_from};
use super::state::State;
use crate::engine::{Link as EngineLink, Source};
use crate::io::Unit;
use crate::pipeline::settings::Settings;
use crate::prepare::prepare::Plan;
use crate::render::Camera;
use crate::say;
use crate::sharing::{
    Beside, Eye, Link, Measured, SharedSettings, SharedSurface, ShortDigest, read_settings_and, write_settings_and,
};

/// What a settings file ends in.
const ENDING: &str = ".json";

/// Whether a file is one of settings, by its name.
pub(super) fn is_settings(name: &str) -> bool {
    name.to_lowercase().ends_with(ENDING)
}

/// The link that was followed, until its file is there.
#[derive(Default)]
pub(super) struct Sharing {
    followed: Option<Link>,
    /// From where to look at what a link has opened.
    eye: Option<Eye>,
}

impl Sharing {
    /// Saves the settings as a file.
    pub(super) fn save(state: &mut State, files: &mut dyn Files, ctx: &egui::Context) {
        let stem = state.document.as_ref().map_or("lumen".to_owned(), Document::stem);
        let name = format!("{stem}-settings{ENDING}");
        let of = surface(state).filter(|_| !state.measures.is_empty()).map(known_by);
        if of.is_none() && !state.measures.is_empty() {
            state.leave_out(&say!("app-measures-not-saved"));
        }
        let measured = of.map(|of| Measured { of, measures: state.measures.to_vec() });
        // Of who never looked at the step, a file says nothing of it.
        let is_used = state.preparation.made.is_some() || state.preparation.plan != Plan::flow();
        let beside = Beside { measured, solver: is_used.then(|| state.preparation.plan.clone()) };
        files.offer_file(&name, write_settings_and(&shared(state), beside).into_bytes(), ctx);
    }

    /// Where what is open can be seen by others as it is seen now: the page, the surface, the settings and the camera.
    fn link(state: &State, camera: &Camera, page: &dyn PageSharing) -> Option<(String, SharedSurface)> {
        let (address, surface) = (page.address()?, surface(state)?);
        let link = Link { surface, shared: shared(state), eye: Some(eye_of(camera).rounded()) };
        Some((format!("{address}#{}", link.fragment()), surface))
    }

    /// The same, or the link that was followed and whose surface is not there.
    pub(super) fn whole(&self, state: &State, camera: &Camera, page: &dyn PageSharing) -> Option<String> {
        match &self.followed {
            Some(followed) => Some(format!("{}#{}", page.address()?, followed.fragment())),
            None => Self::link(state, camera, page).map(|(link, _)| link),
        }
    }

    /// Moves the camera to where a link looks from.
    pub(super) fn look(&mut self, camera: &mut Camera) {
        if let Some(eye) = self.eye.take() {
            look_from(eye, camera);
        }
    }

    /// Copies a link with the settings and the file's digits.
    pub(super) fn copy_link(state: &mut State, camera: &Camera, page: &dyn PageSharing, ctx: &egui::Context) {
        match Self::link(state, camera, page) {
            Some((link, surface)) => {
                ctx.copy_text(link);
                let text = match surface {
                    SharedSurface::File(_) => say!("app-link-copied-file"),
                    SharedSurface::Sample(_) => say!("app-link-copied-sample"),
                };
                state.tell(&text);
            }
            _ if has_fewer(state) => state.tell(&say!("app-link-fewer")),
            _ => state.tell(&say!("app-link-nothing")),
        }
    }

    /// Takes the settings of a file.
    pub(super) fn take_file(name: &str, bytes: &[u8], state: &mut State, link: &mut dyn EngineLink) {
        match read_settings_and(bytes) {
            Ok((shared, Beside { measured, solver })) => {
                let unit = shared.unit;
                apply(shared, state);
                if let Some(plan) = solver {
                    state.preparation.plan = plan;
                }
                let is_read_again = take_unit(unit, state, link);
                let mut text = say!("app-settings-taken", name = name);
                if let Some(measured) = measured {
                    text = format!("{text} {}", take_measures(measured, is_read_again, state));
                }
                state.tell(&text);
            }
            Err(error) => state.warn(&say!("app-open-failed", name = name, why = error.to_string())),
        }
    }

    /// Follows a link: its settings are in force at once, its surface where that is a sample.
    pub(super) fn follow(&mut self, fragment: &str, state: &mut State, link: &mut dyn EngineLink) {
        let followed = match Link::parse(fragment) {
            Ok(followed) => followed,
            Err(error) => return state.warn(&error.to_string()),
        };
        if surface(state) == Some(followed.surface) && state.awaits_levels() {
            // Its pieces are not known yet.
            self.followed = Some(followed);
            return;
        }
        if surface(state) == Some(followed.surface) {
            apply(followed.shared.clone(), state);
            let is_read_again = take_unit(followed.shared.unit, state, link);
            self.eye = followed.eye;
            state.tell(&say!("app-link-taken"));
            self.followed = is_read_again.then_some(followed);
            return;
        }
        // Its piece is one of its own surface.
        let keep = state.settings.keep;
        let settings = Settings { keep, ..followed.shared.settings.clone() };
        apply(SharedSettings { settings, ..followed.shared }, state);
        match followed.surface {
            SharedSurface::Sample(sample) => state.open_sample(sample, link),
            SharedSurface::File(digits) => ask_for(digits, state),
        }
        self.followed = Some(followed);
    }

    /// Before a file is read: its numbers are in the link's unit, unless the user has chosen one.
    pub(super) fn before_file(&self, state: &mut State) {
        let unit = self.followed.as_ref().and_then(|link| link.shared.unit);
        state.next_unit = state.next_unit.or(unit);
    }

    /// Hears that a surface was opened: is it the link's?
    pub(super) fn opened(&mut self, state: &mut State, link: &mut dyn EngineLink) {
        if has_fewer(state) {
            match self.followed.as_ref().map(|link| link.surface) {
                Some(SharedSurface::File(wanted)) => ask_for(wanted, state),
                Some(SharedSurface::Sample(_)) => {
                    self.followed = None;
                    state.tell(&say!("app-link-fewer"));
                }
                None => {}
            }
            return;
        }
        let (Some(followed), Some(opened)) = (&self.followed, surface(state)) else { return };
        match (opened, followed.surface) {
            (opened, wanted) if opened == wanted => {
                // Another unit or piece than the link's may have been chosen meanwhile.
                apply(followed.shared.clone(), state);
                // Read in another unit, it is opened once more.
                if !take_unit(followed.shared.unit, state, link) {
                    state.tell(&say!("app-link-same"));
                    self.eye = followed.eye;
                    self.followed = None;
                }
            }
            (SharedSurface::File(opened), SharedSurface::File(wanted)) => {
                let (opened, wanted) = (opened.to_string(), wanted.to_string());
                state.warn(&say!("app-link-other-file", opened = opened, wanted = wanted));
            }
            (SharedSurface::Sample(_), SharedSurface::File(wanted)) => ask_for(wanted, state),
            (_, SharedSurface::Sample(_)) => self.followed = None,
        }
    }
}

fn ask_for(digits: ShortDigest, state: &mut State) {
    state.ask(&say!("app-link-needs-file", digits = digits.to_string()));
}

/// The settings in force.
fn shared(state: &State) -> SharedSettings {
    SharedSettings { unit: state.asked_unit(), settings: state.settings.clone() }
}

/// Brings settings into force; where the piece that they keep is not there, the one that is kept stays.
fn apply(shared: SharedSettings, state: &mut State) {
    // One step to undo, whatever was changed before it.
    state.record();
    let settings = shared.settings;
    let has_piece = state.document.as_ref().is_none_or(|document| document.pieces.has(settings.keep));
    let keep = if has_piece { settings.keep } else { state.settings.keep };
    state.settings = Settings { keep, ..settings };
}

/// Takes the measures of a file in place of those that are shown, if they were made on the surface that is open; says in a
/// sentence what came of them.
fn take_measures(measured: Measured, is_read_again: bool, state: &mut State) -> String {
    if surface(state).map(known_by) != Some(measured.of) {
        return say!("app-measures-of-other");
    }
    if is_read_again {
        return say!("app-measures-too-early");
    }
    state.measures = std::sync::Arc::new(measured.measures);
    say!("app-measures-shown")
}

/// By what a settings file knows a surface.
fn known_by(surface: SharedSurface) -> String {
    match surface {
        SharedSurface::File(digits) => digits.to_string(),
        SharedSurface::Sample(sample) => sample.to_string(),
    }
}

/// Reads the file that is open again where its numbers were taken in another unit than this, `None` being that of its
/// format; says whether it does.
fn take_unit(unit: Option<Unit>, state: &mut State, link: &mut dyn EngineLink) -> bool {
    let Some(document) = &state.document else { return false };
    let Source::File { options, .. } = &document.source else { return false };
    let is_other = options.unit != unit && unit != Some(document.import.unit);
    if is_other {
        state.set_unit(unit, link);
    }
    is_other
}

/// Whether a sample is open that has fewer triangles than by itself: no link is to such.
fn has_fewer(state: &State) -> bool {
    let source = state.document.as_ref().map(|document| &document.source);
    source.is_some_and(|source| matches!(source, Source::Sample { .. }) && source.usual_sample().is_none())
}

/// By what the surface that is open is known.
fn surface(state: &State) -> Option<SharedSurface> {
    let document = state.document.as_ref()?;
    match &document.source {
        source @ Source::Sample { .. } => source.usual_sample().map(SharedSurface::Sample),
        Source::File { .. } => document.digest.map(|digest| SharedSurface::File(digest.short())),
        Source::Made { .. } => None,
    }
}
