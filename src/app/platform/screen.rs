//! The window and its user: the day, attention, pointer, motion, the address of the page, languages.

use crate::language::Language;

/// The window, and how it is used.
pub trait Screen {
    /// The day by its clock and time zone, as ISO 8601 writes it: 2026-11-26.
    fn today(&self) -> String;

    /// Whether keys that are let go will be heard of: a page that is seen beside the window in use hears none. The
    /// desktop is told by its window.
    fn has_attention(&self) -> bool {
        true
    }

    /// Whether the window was left, if only for a moment, since this was asked last: what moves by itself ends. Where the
    /// window's own events tell that, it is never so.
    fn was_left(&self) -> bool {
        false
    }

    /// Whether the user asks for less motion on the screen.
    fn prefers_less_motion(&self) -> bool {
        false
    }

    /// Whether the window is a part of somebody else's page, which shows one thing: views and sliders, nothing that opens,
    /// saves or keeps.
    fn is_embedded(&self) -> bool {
        false
    }

    /// Whether what points is a finger, as on a phone or a tablet.
    fn has_finger(&self) -> bool {
        false
    }
}

/// The address of the page, for links to it and what it asks for. Text for the clipboard goes through egui.
pub trait Sharing {
    /// The address that a link begins with; `None` where there is no page.
    fn address(&self) -> Option<String> {
        None
    }

    /// How many triangles the user wants samples to have, where that is another number than
    /// [theirs](crate::phantom::Sample::default_triangles).
    fn sample_triangles(&self) -> Option<u32> {
        None
    }
}

/// The languages of the system, of the engines and of what stands outside the window.
pub trait Languages {
    /// The language of the system, as a tag such as `de-AT` or a locale such as `fr_FR.UTF-8`; `None` where it states none.
    fn locale(&self) -> Option<String> {
        None
    }

    /// Fetches the messages of a language that the program has not in it:
    /// [`PlatformEvent::Texts`](super::PlatformEvent::Texts) has them, or
    /// [`PlatformEvent::Failed`](super::PlatformEvent::Failed) says why there are none.
    fn fetch_texts(&mut self, _language: Language) {}

    /// Lets the engines speak a language, those too that are started later: `texts` are its messages, none for English,
    /// which they have in them.
    fn speak(&mut self, _language: Language, _texts: &str) {}

    /// Says outside the window which language is spoken in it, by its tag: a page tells those who read it aloud.
    fn show_language(&mut self, _tag: &'static str) {}
}
