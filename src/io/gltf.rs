//! glTF 2.0 (Khronos 2021), as one binary file (GLB) or as text with its data inside.
//!
//! The crate `gltf` gives the structure of the JSON (`gltf::json`). Its readers of the GLB container and of
//! accessors are not used: they subtract and multiply what a file claims without looking, and panic on some claims.
//!
//! A node's numbers are decimal in the file and f32 in that structure; they are taken back to the decimal they stood
//! for before being multiplied in f64. So 0.001 times 1000 is exactly 1, and a surface that Lumen wrote, in mm under
//! a node scale of 0.001, reads back to the same bits.
//!
//! By the specification (3.4) y is up, and the front of what is shown looks along z. Lumen has z up, as patients' axes do,
//! and the front towards -y: what is read is turned by a right angle about x, what is written is turned back.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use ::gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Node, Root, deserialize};
use base64::Engine as _;
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::columns::Columns;
use super::error::{ReadError, WriteError};
use super::gltf_arrays::{Attribute, Names, array_name};
use super::import::RawSurface;
use super::output::Output;
use super::room::Room;
use super::text::BASE64;
use super::{Format, Unit};
use crate::mesh::arrays::{On, Scalar, Values};

const FORMAT: &str = "glTF";
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BIN_CHUNK: u32 = 0x004e_4942;

/// Reads a GLB file; its positions come in mm, relative to `origin`.
pub(super) fn read_binary(bytes: &[u8], unit: Unit, origin: DVec3) -> Result<RawSurface, ReadError> {
    let word = |at: usize| bytes.get(at..).and_then(|rest| rest.first_chunk()).map(|b| u32::from_le_bytes(*b));
    let cut_short = |announced: usize| ReadError::CutShort {
        format: "GLB",
        what: "bytes".to_owned(),
        announced: announced as u64,
        found: bytes.len() as u64,
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(cut_short(12));
    };
    if version != 2 {
        return Err(ReadError::Unsupported { format: "GLB", feature: format!("version {version}") });
    }
    if length as usize > bytes.len() {
        return Err(cut_short(length as usize));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while let (Some(length), Some(kind)) = (word(at), word(at + 4)) {
        let chunk = &bytes[at + 8..];
        let chunk = chunk.get(..length as usize).ok_or_else(|| cut_short((at + 8).saturating_add(length as usize)))?;
        match kind {
            JSON_CHUNK => json = json.or(Some(chunk)),
            BIN_CHUNK => binary = binary.or(Some(chunk)),
            _ => {}
        }
        at += 8 + chunk.len();
    }
    let json = json.ok_or_else(|| malformed("it has no JSON part"))?;
    read_scene("GLB", json, binary, unit, bytes.len(), origin)
}

/// Reads a glTF text that carries its own data; its positions come in mm, relative to `origin`.
pub(super) fn read_text(bytes: &[u8], unit: Unit, origin: DVec3) -> Result<RawSurface, ReadError> {
    read_scene("glTF", super::text::without_mark(bytes), None, unit, bytes.len(), origin)
}

fn malformed(problem: impl Into<String>) -> ReadError {
    ReadError::Malformed { format: FORMAT, problem: problem.into() }
}

/// Collects every triangle of the scene that opens first, through its tree of nodes.
fn read_scene(
    label: &'static str,
    json: &[u8],
    binary: Option<&[u8]>,
    unit: Unit,
    file_length: usize,
    origin: DVec3,
) -> Result<RawSurface, ReadError> {
    let room = Room::of(file_length);
    room.check_parts(FORMAT, json.iter().filter(|&&byte| byte == b'{').count())?;
    let root: Root = deserialize::from_slice(json).map_err(|error| {
        malformed(format!("its JSON is wrong or incomplete at line {}, column {}", error.line(), error.column()))
    })?;
    let compressions = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"];
    if let Some(feature) = root.extensions_required.iter().find(|name| compressions.contains(&name.as_str())) {
        return Err(ReadError::Unsupported { format: FORMAT, feature: feature.clone() });
    }
    let buffers = Buffers::new(&root, binary)?;
    let names = Names::of(json);
    let raw = RawSurface::new(label, Vec::new(), Vec::new());
    let mut collected = Collected { raw, room, columns: Columns::default(), array_bytes: 0 };
    collected.raw.in_mm = true;
    (collected.raw.has_doubles, collected.raw.origin) = (root.nodes.iter().any(is_moved), origin);
    let to_mm = DMat4::from_translation(-origin) * upright() * DMat4::from_scale(DVec3::splat(unit.to_mm()));

    let scene = root.scene.or((!root.scenes.is_empty()).then(|| Index::new(0)));
    let mut stack: Vec<(Index<Node>, DMat4)> = Vec::new();
    match scene {
        Some(scene) => {
            let scene = root.get(scene).ok_or_else(|| malformed("its scene is missing"))?;
            stack.extend(scene.nodes.iter().rev().map(|&node| (node, to_mm)));
        }
        // A library of meshes that are placed nowhere.
        None => {
            for (m, mesh) in root.meshes.iter().enumerate() {
                for (p, primitive) in mesh.primitives.iter().enumerate() {
                    collected.add(&root, &buffers, primitive, names.of_primitive(m, p), to_mm)?;
                }
            }
        }
    }
    let mut visited = vec![false; root.nodes.len()];
    while let Some((index, parent)) = stack.pop() {
        let node = root.get(index).ok_or_else(|| malformed(format!("node {} is missing", index.value())))?;
        if std::mem::replace(&mut visited[index.value()], true) {
            return Err(malformed(format!("node {} hangs from two others, or from itself", index.value())));
        }
        let to_world = parent * transform(node);
        if let Some(mesh) = node.mesh {
            let m = mesh.value();
            let mesh = root.get(mesh).ok_or_else(|| malformed(format!("mesh {m} is missing")))?;
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                collected.add(&root, &buffers, primitive, names.of_primitive(m, p), to_world)?;
            }
        }
        stack.extend(node.children.iter().flatten().rev().map(|&child| (child, to_world)));
    }
    let Collected { mut raw, columns, .. } = collected;
    raw.carry(columns.finish(), room);
    Ok(raw)
}

/// From a scene with y up and its front towards z to one with z up and its front towards -y.
fn upright() -> DMat4 {
    DMat4::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y))
}

/// The same back, exactly.
fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}

/// Whether a node is somewhere else than its parent: its place then has digits beyond those of the positions.
fn is_moved(node: &Node) -> bool {
    let by = node.translation.or(node.matrix.map(|matrix| [matrix[12], matrix[13], matrix[14]]));
    by.is_some_and(|by| by != [0.0; 3])
}

/// A node's place in its parent.
fn transform(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(&matrix.map(decimal));
    }
    let vector = |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from(v.map(decimal)));
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |q| {
        let q = DQuat::from_array(q.0.map(decimal));
        if q.length_squared() > 0.0 { q.normalize() } else { DQuat::IDENTITY }
    });
    let (scale, translation) = (vector(node.scale, DVec3::ONE), vector(node.translation, DVec3::ZERO));
    DMat4::from_scale_rotation_translation(scale, rotation, translation)
}

/// The shortest decimal that rounds to `x`, which is how `x` stood in the file, as f64.
fn decimal(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}

/// What has been read so far.
struct Collected {
    raw: RawSurface,
    /// A mesh may be placed many times over by a few bytes each; this is as much as a file may grow by that.
    room: Room,
    /// The attributes that are arrays, and the bytes that they take.
    columns: Columns,
    array_bytes: u64,
}

impl Collected {
    /// Adds one primitive, placed by `to_world`; `names` has its attributes.
    fn add(
        &mut self,
        root: &Root,
        buffers: &Buffers,
        primitive: &Primitive,
        names: Option<&BTreeMap<String, u32>>,
        to_world: DMat4,
    ) -> Result<(), ReadError> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err(malformed("a mesh has a drawing mode that does not exist"));
        };
        let Some(&positions) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
            return Ok(());
        };
        let count_of = |accessor: Index<Accessor>| root.get(accessor).map_or(0, |a| a.count.0 as usize);
        let elements = count_of(primitive.indices.unwrap_or(positions));
        let skipped = &mut self.raw.skipped;
        match mode {
            Mode::Points => skipped.points = skipped.points.saturating_add(elements),
            Mode::Lines => skipped.lines = skipped.lines.saturating_add(elements / 2),
            Mode::LineLoop => skipped.lines = skipped.lines.saturating_add(elements),
            Mode::LineStrip => skipped.lines = skipped.lines.saturating_add(elements.saturating_sub(1)),
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => {
                let vertices = self.raw.positions.len();
                self.add_triangles(root, buffers, primitive, positions, mode, to_world)?;
                let count = self.raw.positions.len() - vertices;
                let arrays = names.into_iter().flatten().filter_map(|(name, &at)| Some((array_name(name)?, at)));
                for (name, accessor) in arrays {
                    match self.values(root, buffers, Index::new(accessor), count) {
                        Ok((components, values)) => self.columns.add(On::Point, name, components, values),
                        Err(why) => self.columns.leave_out(name, why),
                    }
                }
                self.columns.end_part(count, 0);
            }
        }
        Ok(())
    }

    /// The numbers of an attribute of `count` vertices and its components, or why they cannot be had.
    fn values(
        &mut self,
        root: &Root,
        buffers: &Buffers,
        accessor: Index<Accessor>,
        count: usize,
    ) -> Result<(usize, Values), &'static str> {
        const DAMAGED: &str = "its data are damaged or elsewhere";
        let Some(Checked::Valid(shape)) = root.get(accessor).map(|accessor| accessor.type_) else {
            return Err(DAMAGED);
        };
        if !matches!(shape, Type::Scalar | Type::Vec2 | Type::Vec3 | Type::Vec4) {
            return Err("it holds matrices");
        }
        let items = buffers.items(root, accessor, shape).map_err(|_| DAMAGED)?;
        if items.count != count {
            return Err("it has another length than the surface");
        }
        let bytes = self.array_bytes.saturating_add((items.count * items.size) as u64);
        if !self.room.holds_arrays(self.raw.positions.len(), self.raw.triangles.len(), bytes) {
            return Err("it would take more memory than a file of this size is given");
        }
        self.array_bytes = bytes;
        let scalar = match items.component {
            ComponentType::I8 => Scalar::I8,
            ComponentType::U8 => Scalar::U8,
            ComponentType::I16 => Scalar::I16,
            ComponentType::U16 => Scalar::U16,
            ComponentType::U32 => Scalar::U32,
            ComponentType::F32 => Scalar::F32,
        };
        let mut numbers = Vec::with_capacity(items.count * items.size);
        items.iter().for_each(|item| numbers.extend_from_slice(item));
        Ok((shape.multiplicity(), Values::from_bytes(scalar, numbers)))
    }

    fn add_triangles(
        &mut self,
        root: &Root,
        buffers: &Buffers,
        primitive: &Primitive,
        positions: Index<Accessor>,
        mode: Mode,
        to_world: DMat4,
    ) -> Result<(), ReadError> {
        let positions = buffers.items(root, positions, Type::Vec3)?;
        if positions.component == ComponentType::U32 {
            let feature = "positions of 32-bit whole numbers".to_owned();
            return Err(ReadError::Unsupported { format: FORMAT, feature });
        }
        let indices = primitive.indices.map(|index| buffers.items(root, index, Type::Scalar)).transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let more = if mode == Mode::Triangles { corners / 3 } else { corners };
        let (vertices, triangles) = (self.raw.positions.len(), self.raw.triangles.len());
        self.room.check(FORMAT, vertices.saturating_add(positions.count), triangles.saturating_add(more))?;
        let base = self.raw.positions.len() as u32;
        self.raw.positions.extend(positions.iter().map(|item| {
            let size = item.len() / 3;
            let [x, y, z] = [0, 1, 2].map(|i| positions.number(&item[i * size..(i + 1) * size]));
            to_world.transform_point3(DVec3::new(x, y, z)).as_vec3()
        }));
        let order: Vec<u32> = match indices {
            None => (0..positions.count as u32).collect(),
            Some(indices) => indices.indices()?,
        };
        if let Some(at) = order.iter().position(|&v| v as usize >= positions.count) {
            let (face, index) = (self.raw.triangles.len() + at / 3 + 1, i64::from(order[at]));
            return Err(ReadError::IndexOutOfRange { format: FORMAT, face, index, vertices: positions.count });
        }
        // A mirror turns triangles inside out; the specification has them turned back.
        let mirrored = to_world.determinant() < 0.0;
        let place = |t: [u32; 3]| {
            let [a, b, c] = t.map(|v| base + v);
            if mirrored { [a, c, b] } else { [a, b, c] }
        };
        let triangles = &mut self.raw.triangles;
        match mode {
            Mode::TriangleStrip => triangles.extend(order.windows(3).enumerate().map(|(i, three)| {
                let [a, b, c] = [three[0], three[1], three[2]];
                place(if i % 2 == 0 { [a, b, c] } else { [b, a, c] })
            })),
            Mode::TriangleFan => {
                let hub = order.first().copied().unwrap_or_default();
                let rim = order.get(1..).unwrap_or_default();
                triangles.extend(rim.windows(2).map(|two| place([hub, two[0], two[1]])));
            }
            _ => triangles.extend(order.as_chunks::<3>().0.iter().map(|&t| place(t))),
        }
        Ok(())
    }
}

/// The bytes of each buffer, or the address of the file that they are in.
struct Buffers<'a> {
    contents: Vec<Result<Cow<'a, [u8]>, String>>,
}

impl<'a> Buffers<'a> {
    fn new(root: &Root, binary: Option<&'a [u8]>) -> Result<Self, ReadError> {
        let mut contents = Vec::with_capacity(root.buffers.len());
        for (i, buffer) in root.buffers.iter().enumerate() {
            contents.push(match (&buffer.uri, binary) {
                (Some(uri), _) => match uri.strip_prefix("data:").and_then(|data| data.split_once(";base64,")) {
                    Some((_, data)) => {
                        Ok(Cow::Owned(BASE64.decode(data).map_err(|_| malformed("its base64 data are damaged"))?))
                    }
                    None => Err(uri.chars().take(80).collect()),
                },
                (None, Some(binary)) if i == 0 => Ok(Cow::Borrowed(binary)),
                (None, _) => Err("which it does not name".to_owned()),
            });
        }
        Ok(Self { contents })
    }

    /// The items of an accessor, checked to be of `shape` and to lie within their buffer in full.
    fn items(&self, root: &Root, index: Index<Accessor>, shape: Type) -> Result<Items<'_>, ReadError> {
        let broken = |problem: &str| malformed(format!("accessor {} {problem}", index.value()));
        let accessor = root.get(index).ok_or_else(|| broken("is missing"))?;
        if accessor.sparse.is_some() {
            return Err(ReadError::Unsupported { format: FORMAT, feature: "sparse accessors".to_owned() });
        }
        let (Checked::Valid(GenericComponentType(component)), Checked::Valid(type_)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(broken("has a type that does not exist"));
        };
        if type_ != shape {
            return Err(broken("is not of the shape that its use asks for"));
        }
        let view = accessor.buffer_view.and_then(|view| root.get(view)).ok_or_else(|| broken("has no data"))?;
        let contents = self.contents.get(view.buffer.value()).ok_or_else(|| broken("has no data"))?;
        let contents = contents.as_ref().map_err(|uri| ReadError::ExternalBuffer { uri: uri.clone() })?;
        let offset = |at: Option<u64>| usize::try_from(at.unwrap_or(0)).ok();
        let view_bytes = offset(view.byte_offset.map(|at| at.0))
            .and_then(|at| contents.get(at..))
            .and_then(|rest| rest.get(..offset(Some(view.byte_length.0))?))
            .ok_or_else(|| broken("lies beyond the end of the data"))?;
        let size = component.size() * type_.multiplicity();
        let stride = view.byte_stride.map_or(size, |stride| stride.0);
        if stride < size {
            return Err(broken("has items that overlap"));
        }
        let count = accessor.count.0;
        let bytes = offset(accessor.byte_offset.map(|at| at.0))
            .and_then(|at| view_bytes.get(at..))
            .filter(|rest| {
                let needed =
                    count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride as u64)?.checked_add(size as u64));
                needed.is_some_and(|needed| needed <= rest.len() as u64)
            })
            .ok_or_else(|| broken("lies beyond the end of the data"))?;
        Ok(Items { bytes, component, size, stride, count: count as usize, is_normalized: accessor.normalized })
    }
}

/// The items of an accessor.
struct Items<'a> {
    bytes: &'a [u8],
    component: ComponentType,
    /// Bytes of an item, and from one to the next.
    size: usize,
    stride: usize,
    count: usize,
    /// Whether whole numbers stand for parts of their largest.
    is_normalized: bool,
}

impl Items<'_> {
    fn iter(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.count).map(|i| &self.bytes[i * self.stride..i * self.stride + self.size])
    }

    /// A number of an item, which may be quantised (KHR_mesh_quantization).
    fn number(&self, bytes: &[u8]) -> f64 {
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
    fn indices(&self) -> Result<Vec<u32>, ReadError> {
        match self.component {
            ComponentType::U8 => Ok(self.iter().map(|b| u32::from(b[0])).collect()),
            ComponentType::U16 => Ok(self.iter().map(|b| u32::from(u16::from_le_bytes([b[0], b[1]]))).collect()),
            ComponentType::U32 => Ok(self.iter().map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()),
            _ => Err(malformed("its vertex numbers are not whole numbers without sign")),
        }
    }
}

/// A GLB file of one mesh, with y up, in mm under a node scale of 0.001.
pub(super) fn write(output: &Output) -> Result<Vec<u8>, WriteError> {
    let Output { mesh, normals, .. } = *output;
    let (vertices, corners) = (mesh.positions.len(), 3 * mesh.triangles.len());
    let (vector_bytes, index_bytes) = (12 * vertices as u64, 4 * corners as u64);
    let arrays: Vec<Attribute> = output.arrays_in(Format::Glb).filter_map(Attribute::of).collect();
    let bounds = mesh.bounds();
    let (one, other) = (y_up(bounds.min), y_up(bounds.max));
    let corner = |of: fn(f32, f32) -> f32| -> [f32; 3] { std::array::from_fn(|i| of(one[i], other[i])) };
    let list = |[x, y, z]: [f32; 3]| format!("[{x},{y},{z}]");
    // In the order of the data: positions, normals, indices, arrays.
    let (mut attributes, mut accessors) = ("\"POSITION\":0".to_owned(), String::new());
    let mut at = vector_bytes;
    let mut views = format!("{{\"buffer\":0,\"byteLength\":{vector_bytes},\"target\":34962}}");
    let index_start = vector_bytes * if normals.is_some() { 2 } else { 1 };
    let _ =
        write!(views, ",{{\"buffer\":0,\"byteOffset\":{index_start},\"byteLength\":{index_bytes},\"target\":34963}}");
    let mut next = 2;
    if normals.is_some() {
        attributes.push_str(",\"NORMAL\":2");
        let _ =
            write!(accessors, ",{{\"bufferView\":2,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\"}}");
        let _ = write!(views, ",{{\"buffer\":0,\"byteOffset\":{at},\"byteLength\":{vector_bytes},\"target\":34962}}");
        next = 3;
    }
    at = index_start + index_bytes;
    for array in &arrays {
        let _ = write!(attributes, ",{}:{next}", array.name());
        accessors.push_str(&array.accessor(next));
        let (bytes, stride) = (array.bytes(), array.stride());
        let _ = write!(
            views,
            ",{{\"buffer\":0,\"byteOffset\":{at},\"byteLength\":{bytes},\"byteStride\":{stride},\"target\":34962}}"
        );
        at += bytes;
        next += 1;
    }
    let binary_bytes = at;
    let mut json = format!(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Lumen\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\
         \"nodes\":[{{\"name\":\"surface\",\"mesh\":0,\"scale\":[0.001,0.001,0.001]}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{{attributes}}},\"indices\":1}}]}}],\
         \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\",\
         \"min\":{},\"max\":{}}},\
         {{\"bufferView\":1,\"componentType\":5125,\"count\":{corners},\"type\":\"SCALAR\"}}{accessors}],\
         \"bufferViews\":[{views}],\"buffers\":[{{\"byteLength\":{binary_bytes}}}]}}",
        list(corner(f32::min)),
        list(corner(f32::max)),
    );
    // Chunks are multiples of four bytes; the binary one is by nature.
    json.push_str(&"   "[..(4 - json.len() % 4) % 4]);
    let bytes = 12 + 8 + json.len() as u64 + 8 + binary_bytes;
    let too_large = |_| WriteError::TooLarge { format: "GLB", bytes };
    let length = u32::try_from(bytes).map_err(too_large)?;
    let mut out = Vec::with_capacity(length as usize);
    out.extend_from_slice(b"glTF");
    for word in [2, length, json.len() as u32, JSON_CHUNK] {
        out.extend_from_slice(&word.to_le_bytes());
    }
    out.extend_from_slice(json.as_bytes());
    for word in [binary_bytes as u32, BIN_CHUNK] {
        out.extend_from_slice(&word.to_le_bytes());
    }
    for p in mesh.positions.iter().chain(normals.unwrap_or_default()) {
        out.extend_from_slice(bytemuck::cast_slice(&y_up(p.to_array()).map(f32::to_le_bytes)));
    }
    for t in &mesh.triangles {
        out.extend_from_slice(bytemuck::cast_slice(&t.map(u32::to_le_bytes)));
    }
    arrays.iter().for_each(|array| array.write(&mut out));
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{TriMesh, Vec3};

    /// A glTF text of four vertices of a unit square, drawn by `primitive` under `nodes`.
    fn square(nodes: &str, primitive: &str) -> String {
        let corners = [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let mut data: Vec<u8> = corners.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        data.extend([0, 1, 2, 3]);
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{nodes}],\
             \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}{primitive}}}]}}],\"accessors\":[\
             {{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}},\
             {{\"bufferView\":1,\"componentType\":5121,\"count\":4,\"type\":\"SCALAR\"}}],\"bufferViews\":[\
             {{\"buffer\":0,\"byteLength\":48}},{{\"buffer\":0,\"byteOffset\":48,\"byteLength\":4}}],\
             \"buffers\":[{{\"byteLength\":52,\"uri\":\"data:application/octet-stream;base64,{}\"}}]}}",
            BASE64.encode(data)
        )
    }

    fn read(text: &str) -> Result<RawSurface, ReadError> {
        read_text(text.as_bytes(), Unit::Metre, DVec3::ZERO)
    }

    #[test]
    fn strips_fans_and_lists_are_drawn() {
        let triangles = |primitive: &str| read(&square("{\"mesh\":0}", primitive)).unwrap().triangles;
        assert_eq!(triangles(",\"indices\":1,\"mode\":5"), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(",\"mode\":6"), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(",\"indices\":1"), [[0, 1, 2]]);
        assert_eq!(read(&square("{\"mesh\":0}", ",\"mode\":1")).unwrap().skipped.lines, 2);
    }

    #[test]
    fn transforms_go_down_the_tree_and_mirrors_keep_the_outside_out() {
        let half_turn = "{\"children\":[1],\"rotation\":[0,0,1,0],\"translation\":[0.1,0,0]}";
        let raw = read(&square(&format!("{half_turn},{{\"mesh\":0,\"scale\":[2,2,2]}}"), "")).unwrap();
        assert_eq!(raw.positions[3], Vec3::new(-1900.0, 0.0, -2000.0));
        assert_eq!(raw.triangles, [[0, 1, 2]]);
        let mirror = "{\"mesh\":0,\"matrix\":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}";
        let raw = read(&square(mirror, "")).unwrap();
        assert_eq!((raw.positions[1], raw.triangles[0]), (Vec3::new(-1000.0, 0.0, 0.0), [0, 2, 1]));
    }

    #[test]
    fn lies_are_refused_in_a_sentence() {
        let good = square("{\"mesh\":0}", ",\"indices\":1");
        let problem = |from: &str, to: &str| read(&good.replace(from, to)).err().unwrap().to_string();
        assert_eq!(
            problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":4000000000,\"type\":\"VEC3\""),
            "The glTF file is broken: accessor 0 lies beyond the end of the data."
        );
        assert!(
            problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":18446744073709551615,\"type\":\"VEC3\"")
                .contains("beyond")
        );
        assert!(
            problem("\"count\":4,\"type\":\"VEC3\"", "\"count\":2,\"type\":\"VEC3\"").contains("refers to vertex 2")
        );
        assert!(problem("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}").contains("node 0 hangs from two others"));
        assert!(problem("\"mesh\":0", "\"mesh\":7").contains("mesh 7 is missing"));
        assert!(problem("\"asset\"", "asset").contains("its JSON is wrong"));
        let other = problem("data:application/octet-stream;base64,", "square.bin?");
        assert!(other.starts_with("The glTF file keeps its data in another file (square.bin?AAAA"), "{other}");
    }

    #[test]
    fn quantised_positions_are_those_that_they_stand_for() {
        let text = |component: u32, is_normalized: bool, bytes: &[u8]| {
            let data = BASE64.encode(bytes);
            format!(
                "{{\"asset\":{{\"version\":\"2.0\"}},\"extensionsRequired\":[\"KHR_mesh_quantization\"],\
                 \"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
                 \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\
                 \"accessors\":[{{\"bufferView\":0,\"componentType\":{component},\"count\":3,\"type\":\"VEC3\",\
                 \"normalized\":{is_normalized}}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{0}}}],\
                 \"buffers\":[{{\"byteLength\":{0},\"uri\":\"data:;base64,{data}\"}}]}}",
                bytes.len(),
            )
        };
        let shorts = |numbers: [i16; 9]| numbers.map(i16::to_le_bytes).concat();
        // The least and the largest number; y is up in the file, z here.
        let normalized = text(5122, true, &shorts([0, 0, 0, 32767, 0, 0, 0, -32768, 0]));
        assert_eq!(read(&normalized).unwrap().positions, [Vec3::ZERO, Vec3::X * 1000.0, Vec3::Z * -1000.0]);
        let whole = text(5122, false, &shorts([0, 0, 0, 3, 0, 0, 0, -2, 0]));
        assert_eq!(read(&whole).unwrap().positions, [Vec3::ZERO, Vec3::X * 3000.0, Vec3::Z * -2000.0]);
        let bytes = text(5121, true, &[0, 0, 0, 255, 0, 0, 0, 51, 0]);
        assert_eq!(read(&bytes).unwrap().positions[2], Vec3::Z * 200.0);
    }

    #[test]
    fn compressed_meshes_are_refused_by_the_name_of_the_compression() {
        for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
            let text = square("{\"mesh\":0}", "").replacen('{', &format!("{{\"extensionsRequired\":[\"{name}\"],"), 1);
            let error = read(&text).err().unwrap().to_string();
            assert_eq!(error, format!("The glTF file uses {name}, which Lumen does not read."));
        }
    }

    #[test]
    fn a_container_that_lies_is_refused() {
        let problem = |bytes: &[u8]| read_binary(bytes, Unit::Metre, DVec3::ZERO).err().unwrap().to_string();
        assert_eq!(problem(b"glTF\x02\0\0"), "The GLB file is cut short: it announces 12 bytes and holds 7.");
        assert!(problem(b"glTF\x01\0\0\0\x0c\0\0\0").contains("uses version 1"));
        assert!(problem(b"glTF\x02\0\0\0\x00\0\0\0").contains("no JSON part"));
        assert!(problem(b"glTF\x02\0\0\0\x14\0\0\0\xff\xff\xff\xffJSON").contains("announces 4294967315 bytes"));
    }

    #[test]
    fn what_is_up_in_the_file_is_up_and_written_so() {
        // The square's third corner is a metre up, by the specification.
        let raw = read(&square("{\"mesh\":0}", "")).unwrap();
        assert_eq!(raw.positions[2], Vec3::Z * 1000.0);
        // 100 mm to the front, -y, and 300 mm up: to another program along z, and along y.
        let [front, up] = [Vec3::new(0.0, -100.0, 0.0), Vec3::new(0.0, 0.0, 300.0)];
        let mesh = TriMesh { positions: vec![Vec3::ZERO, front, up], triangles: vec![[0, 1, 2]] };
        let bytes = write(&Output { normals: Some(&[Vec3::Z; 3]), ..Output::new(&mesh) }).unwrap();
        let json = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        let numbers: Vec<f32> =
            bytes[28 + json..][..72].as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        assert_eq!(numbers[..9], [0.0, 0.0, 0.0, 0.0, 0.0, 100.0, 0.0, 300.0, 0.0]);
        assert_eq!(numbers[9..12], [0.0, 1.0, 0.0]);
        let text = String::from_utf8_lossy(&bytes[20..20 + json]);
        assert!(text.contains("\"max\":[0,300,100]"), "{text}");
    }

    #[test]
    fn millimetres_survive_the_metre_bit_for_bit() {
        let positions: Vec<Vec3> =
            (1..4000).map(|i| Vec3::new(i as f32 / 7.0, -1e-5 * i as f32, 1e6 / i as f32)).collect();
        let mesh = TriMesh { triangles: vec![[0, 1, 2]], positions };
        let normals = vec![Vec3::Z; mesh.positions.len()];
        for normals in [None, Some(&normals[..])] {
            let raw = write(&Output { normals, ..Output::new(&mesh) }).unwrap();
            let raw = read_binary(&raw, Unit::Metre, DVec3::ZERO).unwrap();
            assert_eq!((&raw.positions, &raw.triangles), (&mesh.positions, &mesh.triangles));
        }
    }
}
