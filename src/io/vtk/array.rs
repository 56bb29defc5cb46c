//! An array of a VTK file once its bytes are there: numbers of one type, as text or in binary.

use std::borrow::Cow;

use super::super::numbers::{BinaryNumbers, Numbers, Scalar, TextNumbers};
use super::super::text::Words;
use crate::mesh::arrays::Values;

/// The numbers of an array.
#[derive(Clone, Debug)]
pub(super) struct Array<'a> {
    pub(super) kind: Scalar,
    pub(super) content: Content<'a>,
}

/// How the numbers stand in the file.
#[derive(Clone, Debug)]
pub(super) enum Content<'a> {
    /// Between white space, from a line on.
    Text {
        text: &'a [u8],
        line: usize,
    },
    Little(Cow<'a, [u8]>),
    Big(Cow<'a, [u8]>),
}

impl Array<'_> {
    /// The numbers, one after another; `format` is for faults.
    pub(super) fn numbers(&self, format: &'static str) -> Box<dyn Numbers + '_> {
        match &self.content {
            &Content::Text { text, line } => Box::new(TextNumbers::new(format, Words::new(text, line), false)),
            Content::Little(bytes) => Box::new(BinaryNumbers::<false>::new(bytes)),
            Content::Big(bytes) => Box::new(BinaryNumbers::<true>::new(bytes)),
        }
    }

    /// The most numbers that there can be.
    pub(super) fn most(&self) -> usize {
        match &self.content {
            // A digit and a space each, but for the last.
            Content::Text { text, .. } => text.len().div_ceil(2),
            Content::Little(bytes) | Content::Big(bytes) => bytes.len() / self.kind.size(),
        }
    }

    /// The first `count` numbers in their own type, or why they cannot be had.
    pub(super) fn values(&self, count: u64) -> Result<Values, &'static str> {
        const CUT_SHORT: &str = "it is cut short";
        let count = usize::try_from(count).ok().filter(|&count| count <= self.most()).ok_or(CUT_SHORT)?;
        let size = self.kind.size();
        match &self.content {
            &Content::Text { text, line } => {
                let mut words = Words::new(text, line);
                let mut values = Values::new(self.kind);
                for _ in 0..count {
                    let word = words.next().ok_or(CUT_SHORT)?;
                    if !std::str::from_utf8(word).is_ok_and(|word| values.push_word(word)) {
                        return Err("it holds what is no number");
                    }
                }
                Ok(values)
            }
            Content::Little(bytes) => Ok(Values::from_bytes(self.kind, bytes[..count * size].to_vec())),
            Content::Big(bytes) => {
                let mut turned = bytes[..count * size].to_vec();
                turned.chunks_exact_mut(size).for_each(<[u8]>::reverse);
                Ok(Values::from_bytes(self.kind, turned))
            }
        }
    }

    /// Whether the numbers may have more digits than f32.
    pub(super) fn has_doubles(&self) -> bool {
        matches!(self.content, Content::Text { .. }) || self.kind == Scalar::F64
    }
}
