//! What the JSON of a glTF file says beyond the structure that `gltf::json` has for it: attributes with names that the
//! specification does not know, views of buffers that meshopt has packed, and a version that is laid out otherwise.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::unpack::Packed;

/// The parts of the JSON that matter here.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Beyond {
    meshes: Vec<Mesh>,
    buffer_views: Vec<View>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Mesh {
    primitives: Vec<Primitive>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Primitive {
    attributes: BTreeMap<String, u32>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct View {
    extensions: Extensions,
}

/// Both have the same fields; the later one allows newer versions of the data.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Extensions {
    #[serde(rename = "EXT_meshopt_compression")]
    ext: Option<Stated>,
    #[serde(rename = "KHR_meshopt_compression")]
    khr: Option<Stated>,
}

/// What a view says of how it is packed: read by itself, so that one that is damaged spoils no other.
#[derive(Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum Stated {
    Packed(Packed),
    Damaged(IgnoredAny),
}

/// The version of a file that is laid out otherwise than 2, if it names one: a text, or a number in files of the first.
pub(super) fn other_version(json: &[u8]) -> Option<u32> {
    let root: serde_json::Value = serde_json::from_slice(json).ok()?;
    let version = &root["asset"]["version"];
    let text = version.as_str().map_or_else(|| version.to_string(), str::to_owned);
    text.split('.').next()?.parse().ok().filter(|&major| major != 2)
}

impl Beyond {
    /// None where the JSON is not as it should be, which is said elsewhere.
    pub(super) fn of(json: &[u8]) -> Self {
        serde_json::from_slice(json).unwrap_or_default()
    }

    /// The attributes of a primitive of a mesh by their names.
    pub(super) fn attributes(&self, mesh: usize, primitive: usize) -> Option<&BTreeMap<String, u32>> {
        Some(&self.meshes.get(mesh)?.primitives.get(primitive)?.attributes)
    }

    /// What each view says of how it is packed.
    pub(super) fn take_packed(&mut self) -> Vec<Option<Stated>> {
        let views = std::mem::take(&mut self.buffer_views).into_iter();
        views.map(|View { extensions: Extensions { ext, khr } }| khr.or(ext)).collect()
    }
}
