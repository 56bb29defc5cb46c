//! The messages of one language.

use std::sync::LazyLock;

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};

use super::digits;
use super::languages::Language;

#[cfg(all(feature = "built-in", not(target_arch = "wasm32")))]
macro_rules! locale {
    ($tag:literal) => {
        &[
            include_str!(concat!("../locales/", $tag, "/app.ftl")),
            include_str!(concat!("../locales/", $tag, "/compare.ftl")),
            include_str!(concat!("../locales/", $tag, "/devices.ftl")),
            include_str!(concat!("../locales/", $tag, "/errors.ftl")),
            include_str!(concat!("../locales/", $tag, "/lesson.ftl")),
            include_str!(concat!("../locales/", $tag, "/measure.ftl")),
            include_str!(concat!("../locales/", $tag, "/panel.ftl")),
            include_str!(concat!("../locales/", $tag, "/record.ftl")),
            include_str!(concat!("../locales/", $tag, "/reference.ftl")),
            include_str!(concat!("../locales/", $tag, "/report.ftl")),
            include_str!(concat!("../locales/", $tag, "/scan.ftl")),
            include_str!(concat!("../locales/", $tag, "/trial.ftl")),
            include_str!(concat!("../locales/", $tag, "/verdict.ftl")),
            include_str!(concat!("../locales/", $tag, "/solver.ftl")),
            include_str!(concat!("../locales/", $tag, "/vessels.ftl")),
            include_str!(concat!("../locales/", $tag, "/views.ftl")),
        ]
    };
}

/// The messages that every program has in it: all of `locales/en`, without what is written there for translators
/// (`build.rs`).
const ENGLISH: &[&str] = &[include_str!(concat!(env!("OUT_DIR"), "/english.ftl"))];

/// They, taken apart once for all threads: that takes two megabytes.
pub(super) static IN_ENGLISH: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::new(Language::English, ENGLISH));

#[cfg(all(feature = "built-in", not(target_arch = "wasm32")))]
pub(super) fn built_in(language: Language) -> Option<&'static [&'static str]> {
    Some(match language {
        Language::English => ENGLISH,
        Language::German => locale!("de"),
        Language::French => locale!("fr"),
    })
}

#[cfg(not(all(feature = "built-in", not(target_arch = "wasm32"))))]
pub(super) fn built_in(language: Language) -> Option<&'static [&'static str]> {
    (language == Language::English).then_some(ENGLISH)
}

/// The messages of one language.
pub(super) struct Catalogue(FluentBundle<FluentResource>);

impl Catalogue {
    /// Of what is not understood the rest is taken: a test sees to it that there is no such thing in `locales/`.
    pub(super) fn new(language: Language, texts: &[&str]) -> Self {
        let tag = language.tag().parse();
        let mut bundle = FluentBundle::new_concurrent(tag.into_iter().collect());
        // Nothing here is written from right to left, and the marks would be in labels and file names.
        bundle.set_use_isolating(false);
        bundle.set_formatter(Some(match language {
            Language::English => |value, _| written(value, Language::English),
            Language::German => |value, _| written(value, Language::German),
            Language::French => |value, _| written(value, Language::French),
        }));
        for text in texts {
            let resource = FluentResource::try_new((*text).to_owned()).unwrap_or_else(|(resource, _)| resource);
            bundle.add_resource_overriding(resource);
        }
        Self(bundle)
    }

    /// The words of message `name`, or `None` where there is no such message.
    pub(super) fn text(&self, name: &str, given: Option<&FluentArgs<'_>>) -> Option<String> {
        let pattern = self.0.get_message(name)?.value()?;
        let mut faults = Vec::new();
        let text = self.0.format_pattern(pattern, given, &mut faults).into_owned();
        debug_assert!(faults.is_empty(), "{name}: {faults:?}");
        Some(text)
    }
}

/// A number as the language writes it.
fn written(value: &FluentValue<'_>, language: Language) -> Option<String> {
    match value {
        FluentValue::Number(given) => Some(digits::written(given.value, language)),
        _ => None,
    }
}
