#![doc = include_str!("../README.md")]

mod catalogue;
mod digits;
mod languages;
mod number;

use std::borrow::Cow;
use std::cell::RefCell;

use fluent_bundle::FluentArgs;

use self::catalogue::{Catalogue, IN_ENGLISH};
pub use self::languages::Language;
pub use self::number::{decimal, exact, grouped, parse, scientific, signed};

/// The name of a message: what a table has in place of its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(pub &'static str);

impl Key {
    /// Its words.
    pub fn say(self) -> String {
        text(self.0)
    }
}

/// A name as it stands within a sentence or behind another word: small in English and in French, as it is in German, whose
/// nouns begin with a capital wherever they stand.
pub fn inner(name: &str) -> String {
    match spoken() {
        Language::English | Language::French => name.to_lowercase(),
        Language::German => name.to_owned(),
    }
}

/// What is put into a message.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// Words, or a number that is written out.
    Text(Cow<'a, str>),
    /// A number: grouped as the language has it, and what the plural follows.
    Number(f64),
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text.into())
    }
}

impl<'a> From<&'a String> for Value<'a> {
    fn from(text: &'a String) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Value<'_> {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}

impl<'a> From<Cow<'a, str>> for Value<'a> {
    fn from(text: Cow<'a, str>) -> Self {
        Self::Text(text)
    }
}

macro_rules! numbers {
    ($($number:ty),*) => { $(
        impl From<$number> for Value<'_> {
            #[allow(clippy::cast_lossless, reason = "for some of these kinds there is no lossless way")]
            fn from(number: $number) -> Self {
                Self::Number(number as f64)
            }
        }
        impl From<&$number> for Value<'_> {
            fn from(number: &$number) -> Self {
                Self::from(*number)
            }
        }
    )* };
}

numbers!(u8, u16, u32, u64, usize, i32, i64, f32, f64);

/// What this thread speaks.
struct Spoken {
    language: Language,
    /// Of that language, where it is another than English.
    own: Option<Catalogue>,
}

thread_local! {
    static SPOKEN: RefCell<Spoken> = const { RefCell::new(Spoken { language: Language::English, own: None }) };
}

/// Lets this thread speak `language`, whose messages are `texts`: see [`built_in`]. English needs none.
pub fn speak(language: Language, texts: &[&str]) {
    SPOKEN.with_borrow_mut(|spoken| {
        spoken.language = language;
        spoken.own = (language != Language::English).then(|| Catalogue::new(language, texts));
    });
}

/// What this thread speaks.
pub fn spoken() -> Language {
    SPOKEN.with_borrow(|spoken| spoken.language)
}

/// The messages of a language, where the program has them in it: the browser fetches all but the English ones.
pub fn built_in(language: Language) -> Option<&'static [&'static str]> {
    catalogue::built_in(language)
}

/// The words of a message that nothing is put into: what [`say!`] calls. A message that no language has is its name.
#[inline(never)]
pub fn text(name: &str) -> String {
    words(name, None)
}

fn words(name: &str, given: Option<&FluentArgs<'_>>) -> String {
    SPOKEN.with_borrow(|spoken| {
        let own = spoken.own.as_ref().and_then(|own| own.text(name, given));
        let text = own.or_else(|| IN_ENGLISH.text(name, given));
        debug_assert!(text.is_some(), "there is no message {name}");
        text.unwrap_or_else(|| name.to_owned())
    })
}

/// The sentence of a message of the libraries, in the language that is spoken; in English where that has none.
pub fn tell(message: &dyn lumen_message::Message) -> String {
    let told = SPOKEN.with_borrow(|spoken| {
        let own = spoken.own.as_ref()?;
        let mut given = FluentArgs::new();
        for (name, value) in message.values() {
            match value {
                lumen_message::Value::Text(text) => given.set(name.to_owned(), text),
                lumen_message::Value::Count(count) => given.set(name.to_owned(), count),
                lumen_message::Value::Number { value, places: None } => given.set(name.to_owned(), exact(value)),
                lumen_message::Value::Number { value, places: Some(places) } => {
                    given.set(name.to_owned(), decimal(value, places.into()));
                }
                lumen_message::Value::Change { value, places } => {
                    given.set(name.to_owned(), signed(value, places.into()));
                }
                lumen_message::Value::Message(inner) => given.set(name.to_owned(), tell(&*inner)),
            }
        }
        own.text(message.id(), Some(&given))
    });
    told.unwrap_or_else(|| message.to_string())
}

/// A message that something is put into, one value after another: what [`say!`] writes. Its functions are no part of those
/// that say something, of which there are a thousand: that was a hundredth of the browser's program.
pub struct Message {
    name: &'static str,
    given: FluentArgs<'static>,
}

impl Message {
    /// The message of this name.
    #[inline(never)]
    pub fn new(name: &'static str) -> Self {
        Self { name, given: FluentArgs::new() }
    }

    /// Puts a value into its place.
    #[inline(never)]
    pub fn put(&mut self, place: &'static str, value: Value<'_>) {
        match value {
            Value::Text(text) => self.given.set(place, text.into_owned()),
            Value::Number(number) => self.given.set(place, number),
        }
    }

    /// Its words.
    #[inline(never)]
    pub fn say(self) -> String {
        words(self.name, Some(&self.given))
    }
}

/// The words of a message in the language that is spoken, as a `String`: `say!("status-triangles", count = triangles.len())`.
/// A value is a number, or anything that is text.
#[macro_export]
macro_rules! say {
    ($name:literal) => { $crate::text($name) };
    ($name:literal, $($place:ident = $value:expr),+ $(,)?) => {{
        let mut message = $crate::Message::new($name);
        $(message.put(stringify!($place), $crate::Value::from($value));)+
        message.say()
    }};
}

#[cfg(test)]
mod tests;
