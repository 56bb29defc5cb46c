//! Settings for others: as a file and in a link. A link says which file it is for; whoever opens it is told whether what is
//! open is that file.

use super::document::Document;
use super::platform::Platform;
use super::state::State;
use crate::engine::{Link as EngineLink, Source};
use crate::io::Unit;
use crate::sharing::{Link, SharedSettings, SharedSurface, ShortDigest, read_settings, write_settings};

/// Something of what is shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Save the settings as a file.
    SaveSettings,
    /// Copy a link with the settings and the file's digits.
    CopyLink,
}

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
}

impl Sharing {
    /// Does what is asked for.
    pub(super) fn act(action: Action, state: &mut State, platform: &mut dyn Platform, ctx: &egui::Context) {
        match action {
            Action::SaveSettings => {
                let stem = state.document.as_ref().map_or("lumen".to_owned(), Document::stem);
                let name = format!("{stem}-settings{ENDING}");
                platform.offer_file(&name, write_settings(&shared(state)).into_bytes(), ctx);
            }
            Action::CopyLink => match (platform.address(), surface(state)) {
                (Some(address), Some(surface)) => {
                    let link = Link { surface, shared: shared(state) };
                    ctx.copy_text(format!("{address}#{}", link.fragment()));
                    state.tell(
                        "The link was copied. It has the settings and the first digits of the file's hash, and nothing of \
                         the surface: whoever opens it needs the same file.",
                    );
                }
                _ => state.tell("There is nothing yet that a link could be to."),
            },
        }
    }

    /// Takes the settings of a file.
    pub(super) fn take_file(name: &str, bytes: &[u8], state: &mut State, link: &mut dyn EngineLink) {
        match read_settings(bytes) {
            Ok(shared) => {
                let other_unit = shared.unit.filter(|&unit| unit_of(state).is_some_and(|present| present != unit));
                apply(shared, state);
                if let Some(unit) = other_unit {
                    state.set_unit(unit, link);
                }
                state.tell(&format!("The settings of {name} are in force."));
            }
            Err(error) => state.warn(&format!("{name}: {error}")),
        }
    }

    /// Follows a link: its settings are in force at once, its surface where that is a sample.
    pub(super) fn follow(&mut self, fragment: &str, state: &mut State, link: &mut dyn EngineLink) {
        let followed = match Link::parse(fragment) {
            Ok(followed) => followed,
            Err(error) => return state.warn(&error.to_string()),
        };
        apply(followed.shared.clone(), state);
        if surface(state) == Some(followed.surface) {
            state.tell("The settings of the link are in force.");
            return;
        }
        if let SharedSurface::Sample(sample) = followed.surface {
            state.open_sample(sample, link);
        }
        if let SharedSurface::File(digits) = followed.surface {
            ask_for(digits, state);
        }
        self.followed = Some(followed);
    }

    /// Before a file is read: its numbers are in the link's unit, unless the user has chosen one.
    pub(super) fn before_file(&self, state: &mut State) {
        let unit = self.followed.as_ref().and_then(|link| link.shared.unit);
        state.next_unit = state.next_unit.or(unit);
    }

    /// Hears that a surface was opened: is it the link's?
    pub(super) fn opened(&mut self, state: &mut State) {
        let (Some(followed), Some(opened)) = (&self.followed, surface(state)) else { return };
        match (opened, followed.surface) {
            (opened, wanted) if opened == wanted => {
                // Another unit or piece than the link's may have been chosen meanwhile.
                apply(followed.shared.clone(), state);
                state.tell("This is what the link belongs to: you see the same.");
                self.followed = None;
            }
            (SharedSurface::File(opened), SharedSurface::File(wanted)) => state.warn(&format!(
                "This is another file than the one that the link belongs to: its SHA-256 begins with {opened}, not with \
                 {wanted}. The settings are those of the link."
            )),
            (SharedSurface::Sample(_), SharedSurface::File(wanted)) => ask_for(wanted, state),
            (_, SharedSurface::Sample(_)) => self.followed = None,
        }
    }
}

fn ask_for(digits: ShortDigest, state: &mut State) {
    state.tell(&format!(
        "This link belongs to a file whose SHA-256 begins with {digits}; open it and you will see the same."
    ));
}

/// The settings in force.
fn shared(state: &State) -> SharedSettings {
    SharedSettings { unit: asked_unit(state), settings: state.settings.clone() }
}

fn apply(shared: SharedSettings, state: &mut State) {
    // One step to undo, whatever was changed before it.
    state.history.record(&state.settings);
    state.settings = shared.settings;
}

/// By what the surface that is open is known.
fn surface(state: &State) -> Option<SharedSurface> {
    let document = state.document.as_ref()?;
    match &document.source {
        Source::Sample { sample, .. } => Some(SharedSurface::Sample(*sample)),
        Source::File { .. } => document.digest.map(|digest| SharedSurface::File(digest.short())),
        Source::Made { .. } => None,
    }
}

/// The unit that was asked for when the file was opened.
fn asked_unit(state: &State) -> Option<Unit> {
    match &state.document.as_ref()?.source {
        Source::File { options, .. } => options.unit,
        Source::Sample { .. } | Source::Made { .. } => None,
    }
}

/// The unit that the numbers of the file were taken in; none for a sample, which has its own.
fn unit_of(state: &State) -> Option<Unit> {
    let document = state.document.as_ref()?;
    matches!(document.source, Source::File { .. }).then_some(document.import.unit)
}
