//! A message without its type.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Message, Value};

/// Any message, as data that can be stored and sent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Told {
    id: Cow<'static, str>,
    values: Vec<(Cow<'static, str>, Value)>,
    english: String,
}

impl Told {
    /// A message of these parts.
    pub fn new(id: impl Into<Cow<'static, str>>, values: Vec<(Cow<'static, str>, Value)>, english: String) -> Self {
        Self { id: id.into(), values, english }
    }
}

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.english)
    }
}

impl std::error::Error for Told {}

impl Message for Told {
    fn id(&self) -> &str {
        &self.id
    }

    fn values(&self) -> Vec<(&str, Value)> {
        self.values.iter().map(|(name, value)| (&**name, value.clone())).collect()
    }

    fn told(&self) -> Told {
        self.clone()
    }
}
