//! The data of a glTF file: its buffers, and the items of its accessors, checked to lie within them.
//!
//! What a view or an accessor does not hold as it stands is made once, before its items are asked for: views that meshopt
//! has packed, and accessors whose items are those of a view, or zeros, with some put in their place (sparse).
//!
//! The readers of the crate `gltf` are not used: see [`super`].

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use ::gltf::json::accessor::sparse::Sparse;
use ::gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use ::gltf::json::buffer::View;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Root};
use base64::Engine as _;

use super::super::error::{Named, ReadError, Unfolded, Unnamed};
use super::super::memory_budget::MemoryBudget;
use super::super::pace::{BYTES, NUMBERS, Pace};
use super::super::problem::GltfProblem;
use super::super::text::BASE64;
use super::beyond::Stated;
use super::{DRACO, FORMAT, draco, malformed};

/// How many times its file a mesh can honestly be that meshopt has packed: of triangles twelve bytes become one or two.
const HONEST: usize = 10;
/// The part of the work on letters in base64 that decoding them is.
const DECODED: f64 = 0.5;

/// The bytes of each buffer, or the address of the file that they are in.
pub(super) struct Buffers<'a> {
    contents: Vec<Result<Cow<'a, [u8]>, Named>>,
    /// Views that are packed, by their numbers, and those that are unpacked.
    packed: Vec<Option<Stated>>,
    unpacked: BTreeMap<usize, Vec<u8>>,
    unpacked_bytes: usize,
    /// The items of sparse accessors.
    filled: BTreeMap<usize, Vec<u8>>,
    /// Bytes of the file, and of what is unpacked or filled.
    file: usize,
    made: u64,
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
    /// The buffers of a file of `file` bytes.
    pub(super) async fn new(
        root: &Root,
        binary: Option<&'a [u8]>,
        packed: Vec<Option<Stated>>,
        file: usize,
        pace: &Pace,
    ) -> Result<Self, ReadError> {
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
        let (unpacked, filled) = Default::default();
        Ok(Self { contents, packed, unpacked, unpacked_bytes: 0, filled, file, made: 0 })
    }

    /// The room for the file: what is packed stands for more than its bytes.
    pub(super) fn budget(&self) -> MemoryBudget {
        MemoryBudget::of(self.file.saturating_add(self.unpacked_bytes()))
    }

    /// Bytes by which what was packed is longer than the file, as far as that can be honest.
    pub(super) fn unpacked_bytes(&self) -> usize {
        self.unpacked_bytes.min(self.file.saturating_mul(HONEST))
    }

    /// Makes what an accessor's items are taken from.
    pub(super) async fn prepare(&mut self, root: &Root, index: Index<Accessor>, pace: &Pace) -> Result<(), ReadError> {
        let Some(accessor) = root.get(index) else { return Ok(()) };
        let sparse = accessor.sparse.as_ref();
        let views = [accessor.buffer_view, sparse.map(|s| s.indices.buffer_view), sparse.map(|s| s.values.buffer_view)];
        for view in views.into_iter().flatten() {
            self.unpack(view.value(), pace).await?;
        }
        if let Some(sparse) = sparse.filter(|_| !self.filled.contains_key(&index.value())) {
            let items = self.fill(root, index, accessor, sparse, pace).await?;
            self.filled.insert(index.value(), items);
        }
        Ok(())
    }

    /// Unpacks a view that is packed.
    async fn unpack(&mut self, view: usize, pace: &Pace) -> Result<(), ReadError> {
        let stated = self.packed.get(view).cloned().flatten();
        let Some(stated) = stated.filter(|_| !self.unpacked.contains_key(&view)) else { return Ok(()) };
        let damaged = || malformed(GltfProblem::Packed { view });
        let Stated::Packed(packed) = stated else { return Err(damaged()) };
        self.make(packed.unpacked_length().ok_or_else(damaged)? as u64)?;
        let bytes = self.bytes(packed.buffer)?.ok_or_else(damaged)?;
        let bytes = bytes.get(packed.byte_offset..).and_then(|rest| rest.get(..packed.byte_length));
        let bytes = packed.unpack(bytes.ok_or_else(damaged)?).ok_or_else(damaged)?;
        self.unpacked_bytes += bytes.len();
        self.unpacked.insert(view, bytes);
        pace.rest(packed.byte_length as f64).await;
        Ok(())
    }

    /// The items of a sparse accessor.
    async fn fill(
        &mut self,
        root: &Root,
        index: Index<Accessor>,
        accessor: &Accessor,
        sparse: &Sparse,
        pace: &Pace,
    ) -> Result<Vec<u8>, ReadError> {
        let number = index.value();
        let layout = Layout::of(accessor, number)?;
        let bytes = layout.count.saturating_mul(layout.size as u64);
        self.make(bytes)?;
        let beyond = || malformed(GltfProblem::AccessorBeyond { accessor: number });
        let mut items = vec![0; usize::try_from(bytes).map_err(|_| beyond())?];
        if accessor.buffer_view.is_some() {
            let base = self.stored(root, accessor, layout, number)?;
            for (i, item) in items.chunks_exact_mut(layout.size).enumerate() {
                item.copy_from_slice(base.item(i));
            }
            pace.rest(0.0).await;
        }
        let Checked::Valid(kind) = sparse.indices.component_type else {
            return Err(malformed(GltfProblem::AccessorType { accessor: number }));
        };
        let part = |component: ComponentType, size: usize| Layout { component, size, count: sparse.count.0 };
        let places = part(kind.0, kind.0.size());
        let places =
            self.window(root, sparse.indices.buffer_view, sparse.indices.byte_offset.0, places, number, false)?;
        let values = part(layout.component, layout.size);
        let values =
            self.window(root, sparse.values.buffer_view, sparse.values.byte_offset.0, values, number, false)?;
        for (i, place) in places.indices(pace).await?.into_iter().enumerate() {
            let item = items.chunks_exact_mut(layout.size).nth(place as usize).ok_or_else(beyond)?;
            item.copy_from_slice(values.item(i));
        }
        Ok(items)
    }

    /// Counts bytes that will be made, and refuses more than there is room for.
    fn make(&mut self, bytes: u64) -> Result<(), ReadError> {
        self.made = self.made.saturating_add(bytes);
        if self.made > MemoryBudget::of(self.file).unfolded() {
            let what = Unfolded::Bytes { bytes: self.made };
            return Err(ReadError::Unfolds { format: FORMAT, what, file: self.file as u64 });
        }
        Ok(())
    }

    /// The items of an accessor that is prepared, checked to be of `shape` and to lie within their buffer in full.
    pub(super) fn items(&self, root: &Root, index: Index<Accessor>, shape: Type) -> Result<Items<'_>, ReadError> {
        let number = index.value();
        let accessor = root.get(index).ok_or_else(|| malformed(GltfProblem::NoAccessor { accessor: number }))?;
        let layout = Layout::of(accessor, number)?;
        if accessor.type_ != Checked::Valid(shape) {
            return Err(malformed(GltfProblem::AccessorShape { accessor: number }));
        }
        let Some(bytes) = self.filled.get(&number) else { return self.stored(root, accessor, layout, number) };
        let Layout { component, size, count } = layout;
        let is_normalized = accessor.normalized;
        Ok(Items { bytes, component, size, stride: size, count: count as usize, is_normalized, weight: 0.0 })
    }

    /// The items of an accessor as they stand in its view.
    fn stored(&self, root: &Root, accessor: &Accessor, layout: Layout, number: usize) -> Result<Items<'_>, ReadError> {
        // Some use it without saying that it is required.
        let may_be_draco = root.extensions_used.iter().any(|name| name == DRACO);
        let no_data =
            || if may_be_draco { draco() } else { malformed(GltfProblem::AccessorEmpty { accessor: number }) };
        let view = accessor.buffer_view.ok_or_else(no_data)?;
        let offset = accessor.byte_offset.map_or(0, |at| at.0);
        self.window(root, view, offset, layout, number, accessor.normalized)
    }

    /// Items that begin at an offset of a view.
    fn window(
        &self,
        root: &Root,
        view: Index<View>,
        offset: u64,
        Layout { component, size, count }: Layout,
        number: usize,
        is_normalized: bool,
    ) -> Result<Items<'_>, ReadError> {
        let beyond = || malformed(GltfProblem::AccessorBeyond { accessor: number });
        let (bytes, stride, weight) = self.view(root, view, number)?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(malformed(GltfProblem::AccessorOverlap { accessor: number }));
        }
        let bytes = usize::try_from(offset)
            .ok()
            .and_then(|at| bytes.get(at..))
            .filter(|rest| {
                let needed =
                    count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride as u64)?.checked_add(size as u64));
                needed.is_some_and(|needed| needed <= rest.len() as u64)
            })
            .ok_or_else(beyond)?;
        Ok(Items { bytes, component, size, stride, count: count as usize, is_normalized, weight })
    }

    /// The bytes of a view, from one of its items to the next where it says so, and the bytes of the file that are done
    /// with each.
    fn view(&self, root: &Root, index: Index<View>, accessor: usize) -> Result<(&[u8], Option<usize>, f64), ReadError> {
        let no_data = || malformed(GltfProblem::AccessorEmpty { accessor });
        let view = root.get(index).ok_or_else(no_data)?;
        let stride = view.byte_stride.map(|stride| stride.0);
        if let Some(bytes) = self.unpacked.get(&index.value()) {
            return Ok((bytes, stride, 0.0));
        }
        // Letters were half done when they became bytes.
        let is_decoded = matches!(self.contents.get(view.buffer.value()), Some(Ok(Cow::Owned(_))));
        let weight = if is_decoded { 4.0 / 3.0 * (1.0 - DECODED) } else { 1.0 };
        let contents = self.bytes(view.buffer.value())?.ok_or_else(no_data)?;
        let bytes = usize::try_from(view.byte_offset.map_or(0, |at| at.0))
            .ok()
            .and_then(|at| contents.get(at..))
            .and_then(|rest| rest.get(..usize::try_from(view.byte_length.0).ok()?))
            .ok_or_else(|| malformed(GltfProblem::AccessorBeyond { accessor }))?;
        Ok((bytes, stride, weight))
    }

    /// The bytes of a buffer; `None` where there is none of that number.
    fn bytes(&self, buffer: usize) -> Result<Option<&[u8]>, ReadError> {
        let contents = self.contents.get(buffer).map(Result::as_ref).transpose();
        Ok(contents.map_err(|uri| ReadError::ExternalBuffer { uri: uri.clone() })?.map(AsRef::as_ref))
    }
}

/// What the items of an accessor are, and how many.
#[derive(Clone, Copy)]
struct Layout {
    component: ComponentType,
    /// Bytes of an item.
    size: usize,
    count: u64,
}

impl Layout {
    fn of(accessor: &Accessor, number: usize) -> Result<Self, ReadError> {
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(malformed(GltfProblem::AccessorType { accessor: number }));
        };
        Ok(Self { component, size: component.size() * shape.multiplicity(), count: accessor.count.0 })
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

    /// The numbers of an item.
    pub(super) fn numbers(&self, i: usize) -> impl Iterator<Item = f64> {
        self.item(i).chunks_exact(self.component.size()).map(|number| self.number(number))
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
