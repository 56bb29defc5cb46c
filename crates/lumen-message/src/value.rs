//! What a message carries.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Told;

/// A value in a message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// Words that are not translated: a name, a word of a file.
    Text(String),
    /// A whole number; plurals follow it.
    Count(i64),
    /// A number.
    Number {
        /// The number.
        value: f64,
        /// Decimals that are written; `None` writes as few as give the same number.
        places: Option<u8>,
    },
    /// A change: a number with its sign, a plus too.
    Change {
        /// The number.
        value: f64,
        /// Decimals that are written.
        places: u8,
    },
    /// A message in a message.
    Message(Box<Told>),
}

impl Value {
    /// A number that is written with so many decimals.
    pub fn decimal(value: f64, places: u8) -> Self {
        Self::Number { value, places: Some(places) }
    }
}

/// A number that is written with its sign and so many decimals: `+0.5`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Signed<const PLACES: u8>(pub f64);

/// A number with its sign and so many decimals; what rounds to nothing has none: `+0.5`, `0.0`.
pub fn signed(number: f64, places: usize) -> String {
    let text = format!("{number:+.places$}");
    let is_zero = text.chars().all(|c| "+-0.".contains(c));
    if is_zero { text[1..].to_owned() } else { text }
}

impl<const PLACES: u8> fmt::Display for Signed<PLACES> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&signed(self.0, PLACES.into()))
    }
}

impl<const PLACES: u8> ToValue for Signed<PLACES> {
    fn to_value(&self) -> Value {
        Value::Change { value: self.0, places: PLACES }
    }
}

/// What can be a field of a message.
pub trait ToValue {
    /// The field as a value.
    fn to_value(&self) -> Value;
}

macro_rules! to_value {
    ($($type:ty => |$value:ident| $made:expr;)*) => { $(
        impl ToValue for $type {
            fn to_value(&self) -> Value {
                let $value = self;
                $made
            }
        }
    )* };
}

to_value! {
    u8 => |n| Value::Count((*n).into());
    u16 => |n| Value::Count((*n).into());
    u32 => |n| Value::Count((*n).into());
    u64 => |n| Value::Count(i64::try_from(*n).unwrap_or(i64::MAX));
    usize => |n| Value::Count(i64::try_from(*n).unwrap_or(i64::MAX));
    i32 => |n| Value::Count((*n).into());
    i64 => |n| Value::Count(*n);
    f32 => |x| Value::Number { value: x.to_string().parse().unwrap_or(f64::NAN), places: None };
    f64 => |x| Value::Number { value: *x, places: None };
    &'static str => |text| Value::Text((*text).to_owned());
    String => |text| Value::Text(text.clone());
    Told => |told| Value::Message(Box::new(told.clone()));
}

impl<T: ToValue + ?Sized> ToValue for Box<T> {
    fn to_value(&self) -> Value {
        (**self).to_value()
    }
}

/// Coordinates: `x, y, z` with one decimal.
impl ToValue for [f32; 3] {
    fn to_value(&self) -> Value {
        Value::Text(self.map(|x| format!("{x:.1}")).join(", "))
    }
}

/// Points along three axes: `512 x 512 x 800`.
impl ToValue for [usize; 3] {
    fn to_value(&self) -> Value {
        Value::Text(self.map(|n| n.to_string()).join(" x "))
    }
}

/// A number with its digits before the point in groups of three, as English writes it: `74,307`.
pub fn grouped(number: impl fmt::Display) -> String {
    let digits = number.to_string();
    let (sign, digits) = digits.strip_prefix('-').map_or(("", &*digits), |digits| ("-", digits));
    let (digits, decimals) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let mut text = sign.to_owned();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text + decimals
}
