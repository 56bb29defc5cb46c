//! Skinned meshes, as they stand in the pose of the file.
//!
//! By the specification (3.7.3.3) the joints alone place such a mesh; the transform of its own node does not count. A vertex
//! p comes to lie at the sum of w J B p over its joints, where w is the weight of the joint, J the joint's global
//! transform and B its inverse bind matrix. Weights that do not add up to 1 are scaled, since what packs them rounds
//! them.

use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Root, Skin};
use glam::DMat4;

use super::super::error::ReadError;
use super::super::pace::Pace;
use super::super::problem::GltfProblem;
use super::buffers::{Buffers, Items};
use super::malformed;

/// Sets of four joints that a vertex may have: programs write one or two, and each takes its time.
const MOST_SETS: usize = 8;

/// Where the vertices of a mesh come to lie.
pub(super) struct Placement<'a> {
    /// The global transform of its node.
    pub(super) node: DMat4,
    pub(super) joints: Option<&'a Joints>,
}

/// The joints of a skin: what each does to a vertex.
pub(super) struct Joints {
    skin: usize,
    matrices: Vec<DMat4>,
}

/// Joints and weights of the vertices of a primitive, four of each an item.
pub(super) struct Bound<'a> {
    joints: &'a Joints,
    sets: Vec<[Items<'a>; 2]>,
}

fn unfit(skin: usize) -> ReadError {
    malformed(GltfProblem::Skin { skin })
}

impl Joints {
    /// Those of a skin, by the global transforms of the scene's nodes.
    pub(super) async fn of(
        root: &Root,
        buffers: &mut Buffers<'_>,
        index: Index<Skin>,
        globals: &[Option<DMat4>],
        pace: &Pace,
    ) -> Result<Self, ReadError> {
        let number = index.value();
        let skin = root.get(index).ok_or_else(|| unfit(number))?;
        let globals = skin.joints.iter().map(|joint| globals.get(joint.value()).copied().flatten());
        let mut matrices: Vec<DMat4> = globals.collect::<Option<_>>().ok_or_else(|| unfit(number))?;
        if let Some(accessor) = skin.inverse_bind_matrices {
            buffers.prepare(root, accessor, pace).await?;
            let inverse = buffers.items(root, accessor, Type::Mat4)?;
            if inverse.count < matrices.len() {
                return Err(unfit(number));
            }
            for (i, matrix) in matrices.iter_mut().enumerate() {
                let mut numbers = inverse.numbers(i);
                *matrix *= DMat4::from_cols_array(&std::array::from_fn(|_| numbers.next().unwrap_or(f64::NAN)));
            }
        }
        Ok(Self { skin: number, matrices })
    }

    /// The accessors of joints and weights that a primitive has.
    pub(super) fn accessors(
        &self,
        primitive: &Primitive,
    ) -> Result<Vec<[Index<::gltf::json::Accessor>; 2]>, ReadError> {
        let attribute = |name: Semantic| primitive.attributes.get(&Checked::Valid(name)).copied();
        let sets = (0..).map_while(|set| Some((attribute(Semantic::Joints(set))?, attribute(Semantic::Weights(set)))));
        let sets = sets.take(MOST_SETS + 1).map(|(joints, weights)| Some([joints, weights?]));
        sets.collect::<Option<Vec<_>>>().filter(|sets| sets.len() <= MOST_SETS).ok_or_else(|| unfit(self.skin))
    }

    /// Binds the `count` vertices of a primitive, whose accessors are prepared; `None` where it has no joints.
    pub(super) fn bind<'a>(
        &'a self,
        root: &Root,
        buffers: &'a Buffers<'_>,
        primitive: &Primitive,
        count: usize,
    ) -> Result<Option<Bound<'a>>, ReadError> {
        let mut sets = Vec::new();
        for accessors in self.accessors(primitive)? {
            let [joints, weights] = accessors.map(|accessor| buffers.items(root, accessor, Type::Vec4));
            let set = [joints?, weights?];
            if set.iter().any(|items| items.count != count) {
                return Err(unfit(self.skin));
            }
            sets.push(set);
        }
        Ok((!sets.is_empty()).then_some(Bound { joints: self, sets }))
    }
}

impl Bound<'_> {
    /// What a vertex is multiplied by.
    pub(super) fn matrix(&self, vertex: usize) -> Result<DMat4, ReadError> {
        let Joints { skin, matrices } = self.joints;
        let matrix = |joint: f64| matrices.get(joint as usize).copied().ok_or_else(|| unfit(*skin));
        let (mut blended, mut sum) = (DMat4::ZERO, 0.0);
        for [joints, weights] in &self.sets {
            for (joint, weight) in joints.numbers(vertex).zip(weights.numbers(vertex)) {
                if weight > 0.0 {
                    blended += matrix(joint)? * weight;
                    sum += weight;
                }
            }
        }
        if sum > 0.0 {
            return Ok(blended * (1.0 / sum));
        }
        // Nothing holds it: its first joint does.
        matrix(self.sets[0][0].numbers(vertex).next().unwrap_or(0.0))
    }
}
