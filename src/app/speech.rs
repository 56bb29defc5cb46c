//! Which language the app speaks: the one that was chosen, or else the system's, or else English. Its messages stand in the
//! program or, in a browser, are fetched ([`Languages::fetch_texts`]): what was spoken goes on until they are there.

use super::platform::Languages;
use crate::language::{self, Language};
use crate::say;

/// The language that was chosen, and the one that is to be spoken.
#[derive(Default)]
pub(super) struct Speech {
    /// `None` for that of the system.
    chosen: Option<Language>,
    /// Whose messages are on their way.
    awaited: Option<Language>,
}

impl Speech {
    /// Speaks the language that was chosen before, or the system's. Where neither is known, what is spoken goes on.
    pub(super) fn begin(chosen: Option<Language>, platform: &mut dyn Languages) -> Self {
        let mut speech = Self { chosen, awaited: None };
        if let Some(language) = chosen.or_else(|| of_system(platform)) {
            speech.turn_to(language, platform);
        }
        speech
    }

    /// The language that was chosen; `None` for that of the system.
    pub(super) fn chosen(&self) -> Option<Language> {
        self.chosen
    }

    /// Speaks a language, or for `None` that of the system.
    pub(super) fn choose(&mut self, chosen: Option<Language>, platform: &mut dyn Languages) {
        self.chosen = chosen;
        let language = chosen.or_else(|| of_system(platform)).unwrap_or_default();
        self.turn_to(language, platform);
    }

    /// Hears the messages of a language that were asked for, or why they are not to be had, which becomes a sentence.
    /// Another may have been chosen meanwhile.
    pub(super) fn take_texts(
        &mut self,
        language: Language,
        texts: Result<String, String>,
        platform: &mut dyn Languages,
    ) -> Result<(), String> {
        if self.awaited != Some(language) {
            return Ok(());
        }
        self.awaited = None;
        let failed = |reason| say!("scan-language-failed", name = language.name(), reason = reason);
        speak(language, &[&texts.map_err(failed)?], platform);
        Ok(())
    }

    fn turn_to(&mut self, language: Language, platform: &mut dyn Languages) {
        self.awaited = None;
        if language == language::spoken() {
            return;
        }
        match language::built_in(language) {
            Some(texts) => speak(language, texts, platform),
            None => {
                self.awaited = Some(language);
                platform.fetch_texts(language);
            }
        }
    }
}

/// The language of the system, where Lumen has it.
fn of_system(platform: &dyn Languages) -> Option<Language> {
    Language::of_tag(&platform.locale()?)
}

/// Speaks a language, here and in the engines.
fn speak(language: Language, texts: &[&str], platform: &mut dyn Languages) {
    language::speak(language, texts);
    // English is in every engine.
    let texts = if language == Language::English { String::new() } else { texts.join("\n") };
    platform.speak(language, &texts);
    platform.show_language(language.tag());
}
