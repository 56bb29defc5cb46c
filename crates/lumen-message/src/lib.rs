#![doc = include_str!("../README.md")]

mod told;
mod value;

use std::fmt;

pub use told::Told;
pub use value::{Signed, ToValue, Value, grouped, signed};

/// Something to say to a user. Its `Display` is plain English.
pub trait Message: fmt::Display {
    /// The key of its translations, such as `errors-file-empty`.
    fn id(&self) -> &str;

    /// The name and value of each placeable of the translation.
    fn values(&self) -> Vec<(&str, Value)>;

    /// The message without its type.
    fn told(&self) -> Told {
        let values = self.values().into_iter().map(|(name, value)| (name.to_owned().into(), value)).collect();
        Told::new(self.id().to_owned(), values, self.to_string())
    }
}

/// Identifier and placeables of a message: what a translation must have.
pub type Signature = (&'static str, &'static [&'static str]);

/// Declares an enum of messages.
///
/// A variant is `"identifier" Name { field: Type, ... } => English`, where English is one of
/// - a format string that names fields: `"{count} bytes are missing"`;
/// - a plural by a field: `(count, "One byte is missing.", "{count} bytes are missing.")`, which is written in groups of
///   three digits;
/// - a block that gives a `String` or `&str`, with the fields as references: `{ format!("{at:?}") }`.
///
/// A number is written into translations with as many decimals as the field says in brackets (`width_mm: f64 [2]`), else
/// with as few as give the same number. A field may be a message itself: its translation is put in place.
///
/// After the enum, `or { Variant(Type), ... }` adds variants that are other messages and say what those say; each has a
/// `From`.
///
/// The enum implements [`Message`], `Display`, `Error` and [`ToValue`], and lists what translations need as
/// `Name::MESSAGES`.
#[macro_export]
macro_rules! messages {
    ($(#[$meta:meta])* $vis:vis enum $enum:ident { $(
        $(#[$variant_meta:meta])*
        $id:literal $variant:ident $({ $(
            $(#[$field_meta:meta])*
            $field:ident : $type:ty $([$places:literal])?
        ),* $(,)? })? => $english:tt
    ),* $(,)? } $(or { $(
        $(#[$other_meta:meta])*
        $other:ident($other_type:ty)
    ),* $(,)? })?) => {
        $(#[$meta])*
        $vis enum $enum { $(
            $(#[$variant_meta])*
            $variant $({ $( $(#[$field_meta])* $field: $type ),* })?,
        )* $($(
            $(#[$other_meta])*
            $other($other_type),
        )*)? }

        impl $enum {
            /// Identifier and placeables of each message.
            #[allow(dead_code, unreachable_pub, reason = "an enum may be private")]
            pub const MESSAGES: &'static [$crate::Signature] =
                &[$( ($id, &[$($( stringify!($field) ),*)?]) ),*];
        }

        impl ::std::fmt::Display for $enum {
            #[allow(unused_variables, clippy::uninlined_format_args, reason = "not every sentence has every field")]
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                match self {
                    $( Self::$variant $({ $( $field ),* })? => $crate::messages!(@english f $english), )*
                    $($( Self::$other(other) => ::std::fmt::Display::fmt(other, f), )*)?
                }
            }
        }

        impl ::std::error::Error for $enum {}

        impl $crate::Message for $enum {
            fn id(&self) -> &str {
                match self {
                    $( Self::$variant $({ $( $field: _ ),* })? => $id, )*
                    $($( Self::$other(other) => $crate::Message::id(other), )*)?
                }
            }

            fn values(&self) -> Vec<(&str, $crate::Value)> {
                match self {
                    $( Self::$variant $({ $( $field ),* })? => vec![$($(
                        (stringify!($field), $crate::messages!(@value $field $($places)?))
                    ),*)?], )*
                    $($( Self::$other(other) => $crate::Message::values(other), )*)?
                }
            }
        }

        impl $crate::ToValue for $enum {
            fn to_value(&self) -> $crate::Value {
                $crate::Value::Message(Box::new($crate::Message::told(self)))
            }
        }

        $($(
            impl From<$other_type> for $enum {
                fn from(other: $other_type) -> Self {
                    Self::$other(other)
                }
            }
        )*)?
    };
    (@english $f:ident ($count:ident, $one:literal, $other:literal)) => {
        if u64::try_from(*$count).is_ok_and(|count| count == 1) {
            write!($f, $one)
        } else {
            let $count = $crate::grouped($count);
            write!($f, $other)
        }
    };
    (@english $f:ident { $($code:tt)* }) => { $f.write_str({ $($code)* }.as_ref()) };
    (@english $f:ident $text:literal) => { write!($f, $text) };
    (@value $field:ident) => { $crate::ToValue::to_value($field) };
    (@value $field:ident $places:literal) => { $crate::Value::decimal(f64::from(*$field), $places) };
}

#[cfg(test)]
mod tests {
    use super::*;

    messages! {
        /// Of this test.
        #[derive(Clone, Debug, PartialEq)]
        enum Inner {
            "inner-word" Word {
                /// As it stands.
                word: String,
            } => "{word} stands there",
        }
    }

    messages! {
        /// Of this test.
        #[derive(Clone, Debug, PartialEq)]
        enum Sample {
            "sample-empty" Empty => "Nothing.",
            "sample-line" Line { line: usize, problem: Inner } => "Line {line}: {problem}.",
            "sample-many" Many { count: u32 } => (count, "One hole.", "{count} holes."),
            "sample-wide" Wide { width_mm: f64 [2] } => "{width_mm:.2} mm wide.",
            "sample-place" Place { at: [f32; 3] } => { format!("at {}", at.map(|x| format!("{x:.1}")).join(", ")) },
        }
    }

    #[test]
    fn display_is_english_and_values_keep_the_numbers() {
        let inner = Inner::Word { word: "x".into() };
        let line = Sample::Line { line: 3, problem: inner.clone() };
        assert_eq!(line.to_string(), "Line 3: x stands there.");
        assert_eq!(line.values(), [("line", Value::Count(3)), ("problem", Value::Message(Box::new(inner.told())))]);
        assert_eq!(Sample::Many { count: 1 }.to_string(), "One hole.");
        assert_eq!(Sample::Many { count: 2 }.to_string(), "2 holes.");
        assert_eq!(Sample::Many { count: 74_307 }.to_string(), "74,307 holes.");
        let wide = Sample::Wide { width_mm: 1.0 / 3.0 };
        assert_eq!(wide.to_string(), "0.33 mm wide.");
        assert_eq!(wide.values(), [("width_mm", Value::decimal(1.0 / 3.0, 2))]);
        assert_eq!(Sample::Place { at: [0.0, 1.0, 2.0] }.to_string(), "at 0.0, 1.0, 2.0");
        assert_eq!(Sample::MESSAGES[1], ("sample-line", &["line", "problem"][..]));
        assert_eq!((Sample::Empty.id(), Sample::Empty.values()), ("sample-empty", vec![]));
    }

    messages! {
        /// Of this test.
        #[derive(Clone, Debug, PartialEq)]
        enum Outer {
            "outer-own" Own => "Own.",
        } or {
            /// Of the other.
            Inner(Inner),
        }
    }

    #[test]
    fn a_variant_that_is_another_message_says_what_that_says() {
        let inner = Inner::Word { word: "x".into() };
        let outer = Outer::from(inner.clone());
        assert_eq!((outer.id(), outer.values(), outer.to_string()), (inner.id(), inner.values(), inner.to_string()));
        assert_eq!((Outer::Own.to_string(), Outer::MESSAGES.len()), ("Own.".to_owned(), 1));
    }

    #[test]
    fn numbers_are_grouped() {
        assert_eq!([grouped(0.25), grouped(-1234.5)], ["0.25", "-1,234.5"]);
        assert_eq!(0.1_f32.to_value(), Value::Number { value: 0.1, places: None });
        assert_eq!([-0.04, 0.04, -0.05, 1.0].map(|number| signed(number, 1)), ["0.0", "0.0", "-0.1", "+1.0"]);
        assert_eq!([grouped(7), grouped(-1234), grouped(1_234_567)], ["7", "-1,234", "1,234,567"]);
    }

    #[test]
    fn a_told_message_crosses_and_says_the_same() {
        let told = Sample::Line { line: 3, problem: Inner::Word { word: "x".into() } }.told();
        let crossed: Told = serde_json::from_str(&serde_json::to_string(&told).unwrap()).unwrap();
        assert_eq!(crossed, told);
        assert_eq!((crossed.id(), crossed.to_string()), ("sample-line", "Line 3: x stands there.".to_owned()));
        assert_eq!(crossed.values(), told.values());
    }
}
