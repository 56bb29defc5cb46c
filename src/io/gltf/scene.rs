//! glTF 2.0 (Khronos 2021), as one binary file (GLB) or as text with its data inside.
//!
//! The crate `gltf` gives the structure of the JSON (`gltf::json`); buffers and accessors are in `gltf_buffers`. Its readers of
//! the GLB container and of accessors are not used: they subtract and multiply what a file claims without looking, and panic on some claims.
//!
//! A node's numbers are decimal in the file and f32 in that structure; they are taken back to the decimal they stood
//! for before being multiplied in f64. So 0.001 times 1000 is exactly 1, and a surface that Lumen wrote, in mm under
//! a node scale of 0.001, reads back to the same bits.
//!
//! Draco and meshopt compression are refused by name: of Draco there is no decoder in Rust alone (`draco_decoder` binds the
//! C++ one, `draco-oxide` has only the encoder yet), and of meshopt's `meshopt` binds C++ and `meshoptimizer-rs` is a young port
//! (0.2); surfaces are read in the browser's first visit, which has no room to spare for them.
//!
//! By the specification (3.4) y is up, and the front of what is shown looks along z. Lumen has z up, as patients' axes do,
//! and the front towards -y: what is read is turned by a right angle about x, what is written is turned back.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Node, Root, deserialize};
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::columns::Columns;
use super::error::{ReadError, WriteError};
use super::gltf_arrays::{Attribute, Names, array_name};
use super::gltf_buffers::Buffers;
use super::import::RawSurface;
use super::output::Output;
use super::pace::{NUMBERS, Pace};
use super::room::Room;
use super::{Format, Unit};
use crate::language::Key;
use crate::mesh::arrays::{On, Scalar, Values};
use crate::say;

pub(super) const FORMAT: &str = "glTF";
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BIN_CHUNK: u32 = 0x004e_4942;

/// Reads a GLB file; its positions come in mm, relative to `origin`.
pub(super) async fn read_binary(bytes: &[u8], unit: Unit, origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let word = |at: usize| bytes.get(at..).and_then(|rest| rest.first_chunk()).map(|b| u32::from_le_bytes(*b));
    let cut_short = |announced: usize| ReadError::CutShort {
        format: "GLB",
        what: say!("errors-bytes"),
        announced: announced as u64,
        found: bytes.len() as u64,
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(cut_short(12));
    };
    if version != 2 {
        return Err(ReadError::Unsupported {
            format: "GLB",
            feature: say!("errors-version", version = version.to_string()),
        });
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
    let json = json.ok_or_else(|| malformed(say!("errors-gltf-no-json")))?;
    pace.rest(json.len() as f64).await;
    read_scene("GLB", json, binary, unit, bytes.len(), origin, pace).await
}

/// Reads a glTF text that carries its own data; its positions come in mm, relative to `origin`.
pub(super) async fn read_text(bytes: &[u8], unit: Unit, origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    read_scene("glTF", super::text::without_mark(bytes), None, unit, bytes.len(), origin, pace).await
}

pub(super) fn malformed(problem: String) -> ReadError {
    ReadError::Malformed { format: FORMAT, problem }
}

/// Collects every triangle of the scene that opens first, through its tree of nodes.
async fn read_scene(
    label: &'static str,
    json: &[u8],
    binary: Option<&[u8]>,
    unit: Unit,
    file_length: usize,
    origin: DVec3,
    pace: &Pace,
) -> Result<RawSurface, ReadError> {
    let room = Room::of(file_length);
    room.check_parts(FORMAT, json.iter().filter(|&&byte| byte == b'{').count())?;
    pace.rest(0.0).await;
    // The crate parses the JSON at once. Of a GLB that is some kilobytes, of a text mostly one long string: a few tens of
    // milliseconds for a million triangles, and twice, for the names.
    let root: Root = deserialize::from_slice(json).map_err(|error| {
        let (line, column) = (error.line().to_string(), error.column().to_string());
        malformed(say!("errors-gltf-json", line = line, column = column))
    })?;
    let compressions = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"];
    if let Some(feature) = root.extensions_required.iter().find(|name| compressions.contains(&name.as_str())) {
        return Err(ReadError::Unsupported { format: FORMAT, feature: feature.clone() });
    }
    pace.rest(0.0).await;
    let names = Names::of(json);
    pace.rest(0.0).await;
    let buffers = Buffers::new(&root, binary, pace).await?;
    let raw = RawSurface::new(label, Vec::new(), Vec::new());
    let mut collected = Collected { raw, room, columns: Columns::default(), array_bytes: 0, pace };
    collected.raw.in_mm = true;
    (collected.raw.has_doubles, collected.raw.origin) = (root.nodes.iter().any(is_moved), origin);
    let to_mm = DMat4::from_translation(-origin) * upright() * DMat4::from_scale(DVec3::splat(unit.to_mm()));

    let scene = root.scene.or((!root.scenes.is_empty()).then(|| Index::new(0)));
    let mut stack: Vec<(Index<Node>, DMat4)> = Vec::new();
    match scene {
        Some(scene) => {
            let scene = root.get(scene).ok_or_else(|| malformed(say!("errors-gltf-no-scene")))?;
            stack.extend(scene.nodes.iter().rev().map(|&node| (node, to_mm)));
        }
        // A library of meshes that are placed nowhere.
        None => {
            for (m, mesh) in root.meshes.iter().enumerate() {
                for (p, primitive) in mesh.primitives.iter().enumerate() {
                    collected.add(&root, &buffers, primitive, names.of_primitive(m, p), to_mm).await?;
                }
            }
        }
    }
    let mut visited = vec![false; root.nodes.len()];
    while let Some((index, parent)) = stack.pop() {
        let number = || index.value().to_string();
        let node = root.get(index).ok_or_else(|| malformed(say!("errors-gltf-no-node", node = number())))?;
        if std::mem::replace(&mut visited[index.value()], true) {
            return Err(malformed(say!("errors-gltf-node-twice", node = number())));
        }
        let to_world = parent * transform(node);
        if let Some(mesh) = node.mesh {
            let m = mesh.value();
            let mesh = root.get(mesh).ok_or_else(|| malformed(say!("errors-gltf-no-mesh", mesh = m.to_string())))?;
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                collected.add(&root, &buffers, primitive, names.of_primitive(m, p), to_world).await?;
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
struct Collected<'a> {
    raw: RawSurface,
    /// A mesh may be placed many times over by a few bytes each; this is as much as a file may grow by that.
    room: Room,
    /// The attributes that are arrays, and the bytes that they take.
    columns: Columns,
    array_bytes: u64,
    pace: &'a Pace,
}

impl Collected<'_> {
    /// Adds one primitive, placed by `to_world`; `names` has its attributes.
    async fn add(
        &mut self,
        root: &Root,
        buffers: &Buffers<'_>,
        primitive: &Primitive,
        names: Option<&BTreeMap<String, u32>>,
        to_world: DMat4,
    ) -> Result<(), ReadError> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err(malformed(say!("errors-gltf-mode")));
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
                self.add_triangles(root, buffers, primitive, positions, mode, to_world).await?;
                let count = self.raw.positions.len() - vertices;
                let arrays = names.into_iter().flatten().filter_map(|(name, &at)| Some((array_name(name)?, at)));
                for (name, accessor) in arrays {
                    match self.values(root, buffers, Index::new(accessor), count).await {
                        Ok((components, values)) => self.columns.add(On::Point, name, components, values),
                        Err(why) => self.columns.leave_out(name, &why.say()),
                    }
                }
                self.columns.end_part(count, 0);
            }
        }
        Ok(())
    }

    /// The numbers of an attribute of `count` vertices and its components, or why they cannot be had.
    async fn values(
        &mut self,
        root: &Root,
        buffers: &Buffers<'_>,
        accessor: Index<Accessor>,
        count: usize,
    ) -> Result<(usize, Values), Key> {
        const DAMAGED: Key = Key("errors-array-damaged");
        let Some(Checked::Valid(shape)) = root.get(accessor).map(|accessor| accessor.type_) else {
            return Err(DAMAGED);
        };
        if !matches!(shape, Type::Scalar | Type::Vec2 | Type::Vec3 | Type::Vec4) {
            return Err(Key("errors-array-matrices"));
        }
        let items = buffers.items(root, accessor, shape).map_err(|_| DAMAGED)?;
        if items.count != count {
            return Err(Key("errors-array-other-length"));
        }
        let bytes = self.array_bytes.saturating_add((items.count * items.size) as u64);
        if !self.room.holds_arrays(self.raw.positions.len(), self.raw.triangles.len(), bytes) {
            return Err(Key("errors-array-memory"));
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
        for block in items.blocks() {
            block.clone().for_each(|i| numbers.extend_from_slice(items.item(i)));
            self.pace.rest(items.done(&block)).await;
        }
        Ok((shape.multiplicity(), Values::from_bytes(scalar, numbers)))
    }

    async fn add_triangles(
        &mut self,
        root: &Root,
        buffers: &Buffers<'_>,
        primitive: &Primitive,
        positions: Index<Accessor>,
        mode: Mode,
        to_world: DMat4,
    ) -> Result<(), ReadError> {
        let positions = buffers.items(root, positions, Type::Vec3)?;
        if positions.component == ComponentType::U32 {
            let feature = say!("errors-gltf-whole-positions");
            return Err(ReadError::Unsupported { format: FORMAT, feature });
        }
        let indices = primitive.indices.map(|index| buffers.items(root, index, Type::Scalar)).transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let more = if mode == Mode::Triangles { corners / 3 } else { corners };
        let (vertices, triangles) = (self.raw.positions.len(), self.raw.triangles.len());
        self.room.check(FORMAT, vertices.saturating_add(positions.count), triangles.saturating_add(more))?;
        let base = self.raw.positions.len() as u32;
        self.raw.positions.reserve(positions.count);
        for block in positions.blocks() {
            self.raw.positions.extend(block.clone().map(|i| {
                let item = positions.item(i);
                let size = item.len() / 3;
                let [x, y, z] = [0, 1, 2].map(|i| positions.number(&item[i * size..(i + 1) * size]));
                to_world.transform_point3(DVec3::new(x, y, z)).as_vec3()
            }));
            self.pace.rest(positions.done(&block)).await;
        }
        let order: Vec<u32> = match indices {
            None => (0..positions.count as u32).collect(),
            Some(indices) => indices.indices(self.pace).await?,
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
        let count = if mode == Mode::Triangles { order.len() / 3 } else { order.len().saturating_sub(2) };
        let corners: fn(usize) -> [usize; 3] = match mode {
            Mode::TriangleStrip => |i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] },
            Mode::TriangleFan => |i| [0, i + 1, i + 2],
            _ => |i| [3 * i, 3 * i + 1, 3 * i + 2],
        };
        self.raw.triangles.reserve(count);
        for start in (0..count).step_by(NUMBERS) {
            let block = start..count.min(start + NUMBERS);
            self.raw.triangles.extend(block.map(|i| place(corners(i).map(|corner| order[corner]))));
            self.pace.rest(0.0).await;
        }
        Ok(())
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
    use super::super::pace::at_once;
    use base64::Engine as _;

    use super::super::text::BASE64;
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
        at_once(read_text(text.as_bytes(), Unit::Metre, DVec3::ZERO, &Pace::default()))
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
        let problem = |bytes: &[u8]| {
            let read = at_once(read_binary(bytes, Unit::Metre, DVec3::ZERO, &Pace::default()));
            read.err().unwrap().to_string()
        };
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
            let raw = at_once(read_binary(&raw, Unit::Metre, DVec3::ZERO, &Pace::default())).unwrap();
            assert_eq!((&raw.positions, &raw.triangles), (&mesh.positions, &mesh.triangles));
        }
    }
}
