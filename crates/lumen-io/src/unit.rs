//! The units of length that a file's numbers can have.

use std::{fmt, str::FromStr};

use lumen_message::{ToValue, Value, messages};
use serde::{Deserialize, Serialize};

/// A unit of length that the numbers in a file may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Unit {
    /// mm, what Lumen works in.
    #[serde(rename = "mm")]
    Millimetre,
    /// cm, ten mm.
    #[serde(rename = "cm")]
    Centimetre,
    /// m, a thousand mm.
    #[serde(rename = "m")]
    Metre,
}

impl Unit {
    /// All units, smallest first.
    pub const ALL: [Self; 3] = [Self::Millimetre, Self::Centimetre, Self::Metre];

    /// Millimetres in one of this unit.
    pub fn to_mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Metre => 1000.0,
        }
    }

    /// The unit's symbol: `mm`, `cm` or `m`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

impl ToValue for Unit {
    fn to_value(&self) -> Value {
        self.symbol().to_value()
    }
}

messages! {
    /// What is no unit.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum UnknownUnit {
        /// A word that names none.
        "errors-unknown-unit" Word {
            /// The word.
            word: String,
        } => "\"{word}\" is not a unit of length that Lumen knows: mm, cm or m.",
    }
}

impl FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(word: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|unit| unit.symbol() == word)
            .ok_or_else(|| UnknownUnit::Word { word: word.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_find_their_unit() {
        assert_eq!("cm".parse(), Ok(Unit::Centimetre));
        assert_eq!("inch".parse::<Unit>(), Err(UnknownUnit::Word { word: "inch".to_owned() }));
        assert_eq!(serde_json::to_string(&Unit::Metre).unwrap(), "\"m\"");
    }
}
