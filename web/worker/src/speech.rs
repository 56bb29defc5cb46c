//! Which language a Worker speaks: its errors and reports reach the user as they are. It is no command of an engine's, so that
//! one line holds for all Workers.

use js_sys::{Object, Reflect};
use lumen::language::{self, Language};
use wasm_bindgen::prelude::*;

const TAG: &str = "speak";
const TEXTS: &str = "texts";

/// The value that lets a Worker speak `language`, whose messages are `texts`.
pub fn value(language: Language, texts: &str) -> Object {
    let value = Object::new();
    for (name, text) in [(TAG, language.tag()), (TEXTS, texts)] {
        // A new object takes every property.
        let _ = Reflect::set(&value, &name.into(), &text.into());
    }
    value
}

/// Speaks as it is told; says whether `value` was about that.
pub(crate) fn hear(value: &JsValue) -> bool {
    let part = |name: &str| Reflect::get(value, &name.into()).ok()?.as_string();
    let Some(language) = part(TAG).and_then(|tag| Language::of_tag(&tag)) else { return false };
    language::speak(language, &[&part(TEXTS).unwrap_or_default()]);
    true
}
