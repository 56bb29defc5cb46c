//! The data of a glTF file: its buffers, and the items of its accessors, checked to lie within them.
//!
//! The readers of the crate `gltf` are not used: see [`super`].

use std::borrow::Cow;
use std::ops::Range;

use ::gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Root};
use base64::Engine as _;

use super::super::error::{Feature, Named, ReadError, Unnamed};
use super::super::pace::{BYTES, NUMBERS, Pace};
use super::super::problem::GltfProblem;
use super::super::text::BASE64;
use super::{FORMAT, malformed};

/// The part of the work on letters in base64 that decoding them is.
const DECODED: f64 = 0.5;

/// The bytes of each buffer, or the address of the file that they are in.
pub(super) struct Buffers<'a> {
    contents: Vec<Result<Cow<'a, [u8]>, Named>>,
}

/// The bytes of a text in base64.
async fn from_base64(text: &str, pace: &Pace) -> Result<Vec<u8>, ReadError> {
    let damaged = || malformed(GltfProblem::Base64);
    let mut bytes = Vec::with_capacity(text.len().div_ceil(4) * 3);
    // Whole groups of four letters; padding stands behind the last.
    let mut blocks = text.as_bytes().chunks(BYTES).peekable();
    while let Some(block) = blocks.next() {
        if block.ends_with(b"=") && blocks.peek().is_some() {
            return Err(damaged());
        }
        BASE64.decode_vec(block, &mut bytes).map_err(|_| damaged())?;
        pace.rest(DECODED * block.len() as f64).await;
    }
    Ok(bytes)
}

impl<'a> Buffers<'a> {
    pub(super) async fn new(root: &Root, binary: Option<&'a [u8]>, pace: &Pace) -> Result<Self, ReadError> {
        let mut contents = Vec::with_capacity(root.buffers.len());
        for (i, buffer) in root.buffers.iter().enumerate() {
            contents.push(match (&buffer.uri, binary) {
                (Some(uri), _) => match uri.strip_prefix("data:").and_then(|data| data.split_once(";base64,")) {
                    Some((_, data)) => Ok(Cow::Owned(from_base64(data, pace).await?)),
                    None => Err(Named::Word(uri.chars().take(80).collect())),
                },
                (None, Some(binary)) if i == 0 => Ok(Cow::Borrowed(binary)),
                (None, _) => Err(Named::Unnamed(Unnamed::NoFile)),
            });
        }
        Ok(Self { contents })
    }

    /// The items of an accessor, checked to be of `shape` and to lie within their buffer in full.
    pub(super) fn items(&self, root: &Root, index: Index<Accessor>, shape: Type) -> Result<Items<'_>, ReadError> {
        let number = index.value();
        let no_data = || malformed(GltfProblem::AccessorEmpty { accessor: number });
        let beyond = || malformed(GltfProblem::AccessorBeyond { accessor: number });
        let accessor = root.get(index).ok_or_else(|| malformed(GltfProblem::NoAccessor { accessor: number }))?;
        if accessor.sparse.is_some() {
            return Err(ReadError::Unsupported { format: FORMAT, feature: Feature::SparseAccessors });
        }
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(type_)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(malformed(GltfProblem::AccessorType { accessor: number }));
        };
        if type_ != shape {
            return Err(malformed(GltfProblem::AccessorShape { accessor: number }));
        }
        let view = accessor.buffer_view.and_then(|view| root.get(view)).ok_or_else(no_data)?;
        let contents = self.contents.get(view.buffer.value()).ok_or_else(no_data)?;
        // Letters were half done when they became bytes.
        let weight = if matches!(contents, Ok(Cow::Owned(_))) { 4.0 / 3.0 * (1.0 - DECODED) } else { 1.0 };
        let contents = contents.as_ref().map_err(|uri| ReadError::ExternalBuffer { uri: uri.clone() })?;
        let offset = |at: Option<u64>| usize::try_from(at.unwrap_or(0)).ok();
        let view_bytes = offset(view.byte_offset.map(|at| at.0))
            .and_then(|at| contents.get(at..))
            .and_then(|rest| rest.get(..offset(Some(view.byte_length.0))?))
            .ok_or_else(beyond)?;
        let size = component.size() * type_.multiplicity();
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            return Err(malformed(GltfProblem::AccessorOverlap { accessor: number }));
        }
        let count = accessor.count.0;
        let bytes = offset(accessor.byte_offset.map(|at| at.0))
            .and_then(|at| view_bytes.get(at..))
            .filter(|rest| {
                let needed =
                    count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride as u64)?.checked_add(size as u64));
                needed.is_some_and(|needed| needed <= rest.len() as u64)
            })
            .ok_or_else(beyond)?;
        let is_normalized = accessor.normalized;
        Ok(Items { bytes, component, size, stride, count: count as usize, is_normalized, weight })
    }
}

/// The items of an accessor.
pub(super) struct Items<'a> {
    bytes: &'a [u8],
    pub(super) component: ComponentType,
    /// Bytes of an item, and from one to the next.
    pub(super) size: usize,
    stride: usize,
    pub(super) count: usize,
    /// Whether whole numbers stand for parts of their largest.
    is_normalized: bool,
    /// Bytes of the file that are done with each of theirs.
    weight: f64,
}

impl Items<'_> {
    pub(super) fn item(&self, i: usize) -> &[u8] {
        &self.bytes[i * self.stride..i * self.stride + self.size]
    }

    /// The items between two rests.
    pub(super) fn blocks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = self.count;
        (0..count).step_by(NUMBERS).map(move |start| start..count.min(start + NUMBERS))
    }

    /// Bytes of the file that are done with a block of items.
    pub(super) fn done(&self, block: &Range<usize>) -> f64 {
        self.weight * (block.len() * self.size) as f64
    }

    /// A number of an item, which may be quantised (KHR_mesh_quantization).
    pub(super) fn number(&self, bytes: &[u8]) -> f64 {
        let (number, largest) = match (self.component, bytes) {
            (ComponentType::I8, &[a]) => (f64::from(a as i8), f64::from(i8::MAX)),
            (ComponentType::U8, &[a]) => (f64::from(a), f64::from(u8::MAX)),
            (ComponentType::I16, &[a, b]) => (f64::from(i16::from_le_bytes([a, b])), f64::from(i16::MAX)),
            (ComponentType::U16, &[a, b]) => (f64::from(u16::from_le_bytes([a, b])), f64::from(u16::MAX)),
            (_, &[a, b, c, d]) => return f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => (f64::NAN, 1.0),
        };
        // The least of signed numbers stands for -1 too.
        if self.is_normalized { (number / largest).max(-1.0) } else { number }
    }

    /// The items as vertex numbers.
    pub(super) async fn indices(&self, pace: &Pace) -> Result<Vec<u32>, ReadError> {
        let number: fn(&[u8]) -> u32 = match self.component {
            ComponentType::U8 => |b| u32::from(b[0]),
            ComponentType::U16 => |b| u32::from(u16::from_le_bytes([b[0], b[1]])),
            ComponentType::U32 => |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            _ => return Err(malformed(GltfProblem::Indices)),
        };
        let mut indices = Vec::with_capacity(self.count);
        for block in self.blocks() {
            indices.extend(block.clone().map(|i| number(self.item(i))));
            pace.rest(self.done(&block)).await;
        }
        Ok(indices)
    }
}
