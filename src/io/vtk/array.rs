//! An array of a VTK file once its bytes are there: numbers of one type, as text or in binary.

use std::borrow::Cow;

use super::super::numbers::{BinaryNumbers, Numbers, Scalar, TextNumbers};
use super::super::text::Words;

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

    /// Whether the numbers may have more digits than f32.
    pub(super) fn has_doubles(&self) -> bool {
        matches!(self.content, Content::Text { .. }) || self.kind == Scalar::F64
    }
}
