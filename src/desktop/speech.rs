//! What the threads speak: each as the window does.

use std::sync::Mutex;

use super::lock;
use crate::language::{self, Language};

/// What the window speaks.
static SPOKEN: Mutex<Language> = Mutex::new(Language::English);

/// Lets every thread speak a language from the next time on that it calls [`follow`].
pub(super) fn set(language: Language) {
    *lock(&SPOKEN) = language;
}

/// Lets this thread speak as the window does.
pub(super) fn follow() {
    let wanted = *lock(&SPOKEN);
    if wanted != language::spoken()
        && let Some(texts) = language::built_in(wanted)
    {
        language::speak(wanted, texts);
    }
}
