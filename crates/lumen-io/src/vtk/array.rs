//! An array of a VTK file once its bytes are there: numbers of one type, as text or in binary.

use std::borrow::Cow;

use super::super::numbers::{BinaryNumbers, Numbers, Scalar, TextNumbers};
use super::super::pace::{BYTES, NUMBERS, Pace};
use super::super::text::Words;
use super::super::warnings::ArrayProblem;
use lumen_mesh::arrays::Values;

/// The numbers of an array.
#[derive(Clone, Debug)]
pub(super) struct Array<'a> {
    pub(super) kind: Scalar,
    pub(super) content: Content<'a>,
    /// Bytes of the file that are done with each byte of the content: what was decoded is half done.
    pub(super) weight: f64,
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
    pub(super) fn numbers(&self, format: &'static str) -> Box<dyn Numbers + Send + '_> {
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
    pub(super) async fn values(&self, count: u64, pace: &Pace) -> Result<Values, ArrayProblem> {
        const CUT_SHORT: ArrayProblem = ArrayProblem::CutShort;
        let count = usize::try_from(count).ok().filter(|&count| count <= self.most()).ok_or(CUT_SHORT)?;
        let size = self.kind.size();
        let (bytes, is_big) = match &self.content {
            &Content::Text { text, line } => {
                let (mut words, mut values) = (Words::new(text, line), Values::new(self.kind));
                while values.len() < count {
                    let before = words.remaining();
                    for _ in 0..NUMBERS.min(count - values.len()) {
                        let word = words.next().ok_or(CUT_SHORT)?;
                        if !std::str::from_utf8(word).is_ok_and(|word| values.push_word(word)) {
                            return Err(ArrayProblem::NoNumber);
                        }
                    }
                    pace.rest(self.weight * (before - words.remaining()) as f64).await;
                }
                return Ok(values);
            }
            Content::Little(bytes) => (bytes, false),
            Content::Big(bytes) => (bytes, true),
        };
        let mut taken = Vec::with_capacity(count * size);
        for block in bytes[..count * size].chunks(BYTES) {
            let start = taken.len();
            taken.extend_from_slice(block);
            if is_big {
                taken[start..].chunks_exact_mut(size).for_each(<[u8]>::reverse);
            }
            pace.rest(self.weight * block.len() as f64).await;
        }
        Ok(Values::from_bytes(self.kind, taken))
    }

    /// Whether the numbers may have more digits than f32.
    pub(super) fn has_doubles(&self) -> bool {
        matches!(self.content, Content::Text { .. }) || self.kind == Scalar::F64
    }
}
