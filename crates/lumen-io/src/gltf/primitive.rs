//! The primitives of a scene's meshes, one after another: triangles, strips and fans with their arrays; lines and points are
//! counted.

use std::collections::BTreeMap;

use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index, Root};
use glam::DVec3;

use super::super::columns::Columns;
use super::super::error::{Feature, ReadError};
use super::super::pace::{NUMBERS, Pace};
use super::super::problem::GltfProblem;
use super::super::raw::RawSurface;
use super::super::warnings::ArrayProblem;
use super::arrays::array_name;
use super::buffers::Buffers;
use super::skin::Placement;
use super::{FORMAT, malformed};
use lumen_mesh::arrays::{Association, Scalar, Values};

/// What has been read so far.
pub(super) struct Collected<'a> {
    pub(super) raw: RawSurface,
    /// The attributes that are arrays, and the bytes that they take.
    pub(super) columns: Columns,
    pub(super) array_bytes: u64,
    pub(super) pace: &'a Pace,
}

impl Collected<'_> {
    /// Adds one primitive; `names` has its attributes.
    pub(super) async fn add(
        &mut self,
        root: &Root,
        buffers: &mut Buffers<'_>,
        primitive: &Primitive,
        names: Option<&BTreeMap<String, u32>>,
        placement: &Placement<'_>,
    ) -> Result<(), ReadError> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err(malformed(GltfProblem::DrawingMode));
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
                self.add_triangles(root, buffers, primitive, positions, mode, placement).await?;
                let count = self.raw.positions.len() - vertices;
                let arrays = names.into_iter().flatten().filter_map(|(name, &at)| Some((array_name(name)?, at)));
                for (name, accessor) in arrays {
                    match self.values(root, buffers, Index::new(accessor), count).await {
                        Ok((components, values)) => self.columns.add(Association::Point, name, components, values),
                        Err(why) => self.columns.leave_out(name, why),
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
        buffers: &mut Buffers<'_>,
        accessor: Index<Accessor>,
        count: usize,
    ) -> Result<(usize, Values), ArrayProblem> {
        const DAMAGED: ArrayProblem = ArrayProblem::Damaged;
        let Some(Checked::Valid(shape)) = root.get(accessor).map(|accessor| accessor.type_) else {
            return Err(DAMAGED);
        };
        if !matches!(shape, Type::Scalar | Type::Vec2 | Type::Vec3 | Type::Vec4) {
            return Err(ArrayProblem::Matrices);
        }
        buffers.prepare(root, accessor, self.pace).await.map_err(|_| DAMAGED)?;
        let items = buffers.items(root, accessor, shape).map_err(|_| DAMAGED)?;
        if items.count != count {
            return Err(ArrayProblem::OtherLength);
        }
        let bytes = self.array_bytes.saturating_add((items.count * items.size) as u64);
        // A mesh may be placed many times over by a few bytes each.
        if !buffers.budget().holds_arrays(self.raw.positions.len(), self.raw.triangles.len(), bytes) {
            return Err(ArrayProblem::Memory);
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
        buffers: &mut Buffers<'_>,
        primitive: &Primitive,
        positions: Index<Accessor>,
        mode: Mode,
        placement: &Placement<'_>,
    ) -> Result<(), ReadError> {
        let joints = placement.joints;
        let bound = joints.map(|joints| joints.accessors(primitive)).transpose()?.unwrap_or_default();
        for accessor in [positions].into_iter().chain(primitive.indices).chain(bound.into_iter().flatten()) {
            buffers.prepare(root, accessor, self.pace).await?;
        }
        let buffers = &*buffers;
        let positions = buffers.items(root, positions, Type::Vec3)?;
        let bound = joints.map(|joints| joints.bind(root, buffers, primitive, positions.count)).transpose()?.flatten();
        if positions.component == ComponentType::U32 {
            let feature = Feature::WholePositions;
            return Err(ReadError::Unsupported { format: FORMAT, feature });
        }
        let indices = primitive.indices.map(|index| buffers.items(root, index, Type::Scalar)).transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let more = if mode == Mode::Triangles { corners / 3 } else { corners };
        let (vertices, triangles) = (self.raw.positions.len(), self.raw.triangles.len());
        buffers.budget().check(FORMAT, vertices.saturating_add(positions.count), triangles.saturating_add(more))?;
        let base = self.raw.positions.len() as u32;
        self.raw.positions.reserve(positions.count);
        for block in positions.blocks() {
            let place = |i: usize| {
                let item = positions.item(i);
                let size = item.len() / 3;
                let [x, y, z] = [0, 1, 2].map(|i| positions.number(&item[i * size..(i + 1) * size]));
                DVec3::new(x, y, z)
            };
            match &bound {
                None => {
                    let placed = block.clone().map(|i| placement.node.transform_point3(place(i)).as_vec3());
                    self.raw.positions.extend(placed);
                }
                Some(bound) => {
                    for i in block.clone() {
                        self.raw.positions.push(bound.matrix(i)?.transform_point3(place(i)).as_vec3());
                    }
                }
            }
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
        let first = bound.as_ref().filter(|_| positions.count > 0).map(|bound| bound.matrix(0)).transpose()?;
        let mirrored = first.unwrap_or(placement.node).determinant() < 0.0;
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
