//! The scene of a glTF file: its tree of nodes, each of which places meshes.

use std::collections::BTreeMap;

use ::gltf::json::{Index, Mesh, Node, Root, deserialize};
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::super::Unit;
use super::super::columns::Columns;
use super::super::error::{Feature, ReadError};
use super::super::memory_budget::MemoryBudget;
use super::super::pace::Pace;
use super::super::problem::GltfProblem;
use super::super::raw::RawSurface;
use super::super::text;
use super::super::warnings::Warning;
use super::beyond::{self, Beyond};
use super::buffers::Buffers;
use super::primitive::Collected;
use super::skin::{Joints, Placement};
use super::{DRACO, FORMAT, draco, malformed, unsupported};

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
    // Some pad the JSON of a GLB with zeros, where spaces should be.
    let json = text::without_mark(json);
    let json = &json[..json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1)];
    let room = MemoryBudget::of(file_length);
    room.check_parts(FORMAT, json.iter().filter(|&&byte| byte == b'{').count())?;
    pace.rest(0.0).await;
    // The crate parses the JSON at once. Of a GLB that is some kilobytes, of a text mostly one long string: a few tens of
    // milliseconds for a million triangles, and twice, for the names.
    let root: Root = deserialize::from_slice(json).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        beyond::other_version(json).map_or_else(
            || malformed(GltfProblem::Json { line, column }),
            |version| unsupported(Feature::Version { version }),
        )
    })?;
    if root.extensions_required.iter().any(|name| name == DRACO) {
        return Err(draco());
    }
    pace.rest(0.0).await;
    let mut beyond = Beyond::of(json);
    pace.rest(0.0).await;
    let mut buffers = Buffers::new(&root, binary, beyond.take_packed(), file_length, pace).await?;
    let raw = RawSurface::new(label, Vec::new(), Vec::new());
    let mut collected = Collected { raw, columns: Columns::default(), array_bytes: 0, pace };
    collected.raw.in_mm = true;
    (collected.raw.has_doubles, collected.raw.origin) = (root.nodes.iter().any(is_moved), origin);
    let to_mm = DMat4::from_translation(-origin) * upright() * DMat4::from_scale(DVec3::splat(unit.to_mm()));

    let tree = Tree::of(&root, to_mm)?;
    let mut skins = BTreeMap::new();
    for (mesh, placed) in &tree.meshes {
        let m = mesh.value();
        let mesh = root.get(*mesh).ok_or_else(|| malformed(GltfProblem::NoMesh { mesh: m }))?;
        let skin = placed.and_then(|node| root.nodes[node].skin);
        if let Some(skin) = skin.filter(|skin| !skins.contains_key(&skin.value())) {
            skins.insert(skin.value(), Joints::of(&root, &mut buffers, skin, &tree.globals, pace).await?);
        }
        let joints = skin.and_then(|skin| skins.get(&skin.value()));
        let node = placed.and_then(|node| tree.globals[node]).unwrap_or(to_mm);
        let placement = Placement { node, joints };
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            collected.add(&root, &mut buffers, primitive, beyond.attributes(m, p), &placement).await?;
        }
    }
    let Collected { mut raw, columns, .. } = collected;
    if root.extensions_used.iter().any(|name| name == "EXT_mesh_gpu_instancing") {
        raw.warnings.push(Warning::GltfInstances);
    }
    let mut primitives = tree.meshes.iter().filter_map(|(mesh, _)| root.get(*mesh)).flat_map(|mesh| &mesh.primitives);
    if primitives.any(|primitive| primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty())) {
        raw.warnings.push(Warning::GltfMorphs);
    }
    raw.unpacked = buffers.unpacked_bytes();
    raw.carry(columns.finish(), buffers.budget());
    Ok(raw)
}

/// The nodes of the scene that opens first.
struct Tree {
    /// The global transform of each node of the file that is in the scene.
    globals: Vec<Option<DMat4>>,
    /// The meshes in the order of the tree, with their nodes; all of the file where it has no scene.
    meshes: Vec<(Index<Mesh>, Option<usize>)>,
}

impl Tree {
    /// Walks from the root of the scene, which `to_mm` places.
    fn of(root: &Root, to_mm: DMat4) -> Result<Self, ReadError> {
        let (mut globals, mut meshes) = (vec![None; root.nodes.len()], Vec::new());
        let Some(scene) = root.scene.or((!root.scenes.is_empty()).then(|| Index::new(0))) else {
            // A library of meshes that are placed nowhere.
            meshes.extend((0..root.meshes.len()).map(|mesh| (Index::new(mesh as u32), None)));
            return Ok(Self { globals, meshes });
        };
        let scene = root.get(scene).ok_or_else(|| malformed(GltfProblem::NoScene))?;
        let mut stack: Vec<(Index<Node>, DMat4)> = scene.nodes.iter().rev().map(|&node| (node, to_mm)).collect();
        while let Some((index, parent)) = stack.pop() {
            let number = index.value();
            let node = root.get(index).ok_or_else(|| malformed(GltfProblem::NoNode { node: number }))?;
            let global = parent * transform(node);
            if globals[number].replace(global).is_some() {
                return Err(malformed(GltfProblem::NodeTwice { node: number }));
            }
            meshes.extend(node.mesh.map(|mesh| (mesh, Some(number))));
            stack.extend(node.children.iter().flatten().rev().map(|&child| (child, global)));
        }
        Ok(Self { globals, meshes })
    }
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
