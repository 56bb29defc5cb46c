//! The scene of a glTF file: its tree of nodes, each of which places meshes.

use ::gltf::json::{Index, Node, Root, deserialize};
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::super::Unit;
use super::super::columns::Columns;
use super::super::error::{Feature, ReadError};
use super::super::memory_budget::MemoryBudget;
use super::super::pace::Pace;
use super::super::problem::GltfProblem;
use super::super::raw::RawSurface;
use super::arrays::Names;
use super::buffers::Buffers;
use super::primitive::Collected;
use super::{FORMAT, malformed};

/// Collects every triangle of the scene that opens first, through its tree of nodes.
pub(super) async fn read_scene(
    label: &'static str,
    json: &[u8],
    binary: Option<&[u8]>,
    unit: Unit,
    file_length: usize,
    origin: DVec3,
    pace: &Pace,
) -> Result<RawSurface, ReadError> {
    let room = MemoryBudget::of(file_length);
    room.check_parts(FORMAT, json.iter().filter(|&&byte| byte == b'{').count())?;
    pace.rest(0.0).await;
    // The crate parses the JSON at once. Of a GLB that is some kilobytes, of a text mostly one long string: a few tens of
    // milliseconds for a million triangles, and twice, for the names.
    let root: Root = deserialize::from_slice(json).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        malformed(GltfProblem::Json { line, column })
    })?;
    let compressions = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"];
    if let Some(feature) = root.extensions_required.iter().find(|name| compressions.contains(&name.as_str())) {
        return Err(ReadError::Unsupported { format: FORMAT, feature: Feature::Extension { name: feature.clone() } });
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
            let scene = root.get(scene).ok_or_else(|| malformed(GltfProblem::NoScene))?;
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
        let number = index.value();
        let node = root.get(index).ok_or_else(|| malformed(GltfProblem::NoNode { node: number }))?;
        if std::mem::replace(&mut visited[index.value()], true) {
            return Err(malformed(GltfProblem::NodeTwice { node: number }));
        }
        let to_world = parent * transform(node);
        if let Some(mesh) = node.mesh {
            let m = mesh.value();
            let mesh = root.get(mesh).ok_or_else(|| malformed(GltfProblem::NoMesh { mesh: m }))?;
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
