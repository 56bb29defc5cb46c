//! How surfaces cross: each of their arrays as a buffer beside the line ([`transfer`](crate::transfer)).

use serde::{Deserialize, Serialize};

use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::classes::Lines;
use crate::pipeline::progressive::{Limit, ProgressiveMesh};

#[derive(Serialize, Deserialize)]
#[serde(remote = "TriMesh")]
struct Surface {
    #[serde(with = "crate::transfer::bulk")]
    positions: Vec<Vec3>,
    #[serde(with = "crate::transfer::bulk")]
    triangles: Vec<[u32; 3]>,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "ProgressiveMesh")]
struct Levels {
    #[serde(with = "crate::transfer::bulk")]
    positions: Vec<Vec3>,
    #[serde(with = "crate::transfer::bulk")]
    parents: Vec<u32>,
    #[serde(with = "crate::transfer::bulk")]
    node_ends: Vec<u32>,
    #[serde(with = "crate::transfer::bulk")]
    triangles: Vec<[u32; 3]>,
    #[serde(with = "crate::transfer::bulk")]
    triangle_ends: Vec<u32>,
    #[serde(with = "crate::transfer::bulk")]
    errors: Vec<f32>,
    #[serde(with = "crate::transfer::bulk")]
    costs: Vec<f32>,
    #[serde(with = "LevelLines")]
    lines: Lines,
    limit: Limit,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Lines")]
struct LevelLines {
    #[serde(with = "crate::transfer::bulk")]
    features: Vec<[u32; 2]>,
    #[serde(with = "crate::transfer::bulk")]
    boundary: Vec<[u32; 2]>,
    #[serde(with = "crate::transfer::bulk")]
    complex: Vec<u32>,
}

/// For fields that are a surface, or share one.
pub(super) mod surface {
    use std::borrow::Borrow;

    use serde::{Deserializer, Serializer};

    use super::{Surface, TriMesh};

    pub(in crate::engine) fn serialize<S: Serializer>(mesh: &impl Borrow<TriMesh>, to: S) -> Result<S::Ok, S::Error> {
        Surface::serialize(mesh.borrow(), to)
    }

    pub(in crate::engine) fn deserialize<'de, M, D>(from: D) -> Result<M, D::Error>
    where
        M: From<TriMesh>,
        D: Deserializer<'de>,
    {
        Surface::deserialize(from).map(M::from)
    }
}

/// For fields that share all levels of a surface.
pub(super) mod levels {
    use std::sync::Arc;

    use serde::{Deserializer, Serializer};

    use super::{Levels, ProgressiveMesh};

    pub(in crate::engine) fn serialize<S: Serializer>(mesh: &Arc<ProgressiveMesh>, to: S) -> Result<S::Ok, S::Error> {
        Levels::serialize(mesh, to)
    }

    pub(in crate::engine) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Arc<ProgressiveMesh>, D::Error> {
        Levels::deserialize(from).map(Arc::new)
    }
}
