//! Surfaces as a GLB file: one, or one and coarser levels of it.
//!
//! Coarser levels stand in the extension `MSFT_lod` (Microsoft, 2018): the node of the finest names the nodes of the others,
//! and from which part of the screen on each is shown. A reader that does not know it shows the finest.

use std::fmt::Write as _;

use super::super::error::WriteError;
use super::super::output::Output;
use super::arrays::Attribute;
use super::container::{BIN_CHUNK, JSON_CHUNK};

/// A GLB file of one mesh, with y up, in mm under a node scale of 0.001.
pub(super) fn write(output: &Output) -> Result<Vec<u8>, WriteError> {
    write_levels(std::slice::from_ref(output))
}

/// A GLB file of a surface and coarser levels of it, the finest first.
pub(crate) fn write_levels(levels: &[Output]) -> Result<Vec<u8>, WriteError> {
    let mut parts = Parts::default();
    let arrays: Vec<Vec<Attribute>> =
        levels.iter().map(|level| level.arrays.iter().filter_map(Attribute::of).collect()).collect();
    for (level, arrays) in levels.iter().zip(&arrays) {
        parts.add(level, arrays);
    }
    let Parts { meshes, accessors, views, bytes: binary_bytes, .. } = parts;
    let (nodes, used) = nodes(levels.len());
    let mut json = format!(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"Lumen\"}},{used}\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\
         \"nodes\":[{nodes}],\"meshes\":[{meshes}],\"accessors\":[{accessors}],\"bufferViews\":[{views}],\
         \"buffers\":[{{\"byteLength\":{binary_bytes}}}]}}"
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
    for (Output { mesh, normals, .. }, arrays) in levels.iter().zip(&arrays) {
        for p in mesh.positions.iter().chain(normals.unwrap_or_default()) {
            out.extend_from_slice(bytemuck::cast_slice(&y_up(p.to_array()).map(f32::to_le_bytes)));
        }
        for t in &mesh.triangles {
            out.extend_from_slice(bytemuck::cast_slice(&t.map(u32::to_le_bytes)));
        }
        arrays.iter().for_each(|array| array.write(&mut out));
    }
    Ok(out)
}

/// The nodes of so many levels, and what is said of extensions.
fn nodes(levels: usize) -> (String, &'static str) {
    let scale = "\"scale\":[0.001,0.001,0.001]";
    if levels == 1 {
        return (format!("{{\"name\":\"surface\",\"mesh\":0,{scale}}}"), "");
    }
    let ids: Vec<String> = (1..levels).map(|level| level.to_string()).collect();
    // On half of the area half of the triangles are as fine.
    let halves = std::iter::successors(Some(0.5_f64), |part| Some(part / 2.0)).take(levels - 1);
    // Below the last nothing would be shown.
    let coverage: Vec<String> = halves.chain([0.0]).map(|part| part.to_string()).collect();
    let mut nodes = format!(
        "{{\"name\":\"surface\",\"mesh\":0,{scale},\"extensions\":{{\"MSFT_lod\":{{\"ids\":[{}]}}}},\
         \"extras\":{{\"MSFT_screencoverage\":[{}]}}}}",
        ids.join(","),
        coverage.join(",")
    );
    for level in 1..levels {
        let _ = write!(nodes, ",{{\"name\":\"level {level}\",\"mesh\":{level},{scale}}}");
    }
    (nodes, "\"extensionsUsed\":[\"MSFT_lod\"],")
}

/// What the JSON says of the data, as lists without their brackets.
#[derive(Default)]
struct Parts {
    meshes: String,
    accessors: String,
    views: String,
    /// How many accessors there are, and as many views.
    count: usize,
    /// Bytes of the data.
    bytes: u64,
}

impl Parts {
    /// Adds a surface. In the order of the data: positions, normals, indices, arrays.
    fn add(&mut self, output: &Output, arrays: &[Attribute]) {
        let Output { mesh, normals, .. } = *output;
        let (vertices, corners) = (mesh.positions.len(), 3 * mesh.triangles.len());
        let (vector_bytes, index_bytes) = (12 * vertices as u64, 4 * corners as u64);
        let bounds = mesh.bounds();
        let (one, other) = (y_up(bounds.min), y_up(bounds.max));
        let corner = |of: fn(f32, f32) -> f32| -> [f32; 3] { std::array::from_fn(|i| of(one[i], other[i])) };
        let list = |[x, y, z]: [f32; 3]| format!("[{x},{y},{z}]");
        let begin = self.bytes;
        let first = self.view(begin, vector_bytes, "\"target\":34962");
        let (min, max) = (list(corner(f32::min)), list(corner(f32::max)));
        self.accessor(&format!(
            "{{\"bufferView\":{first},\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\",\"min\":{min},\"max\":{max}}}"
        ));
        let index_start = begin + vector_bytes * if normals.is_some() { 2 } else { 1 };
        let indices = self.view(index_start, index_bytes, "\"target\":34963");
        self.accessor(&format!(
            "{{\"bufferView\":{indices},\"componentType\":5125,\"count\":{corners},\"type\":\"SCALAR\"}}"
        ));
        let mut attributes = format!("\"POSITION\":{first}");
        if normals.is_some() {
            let view = self.view(begin + vector_bytes, vector_bytes, "\"target\":34962");
            let _ = write!(attributes, ",\"NORMAL\":{view}");
            self.accessor(&format!(
                "{{\"bufferView\":{view},\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\"}}"
            ));
        }
        self.bytes = index_start + index_bytes;
        for array in arrays {
            let about = format!("\"byteStride\":{},\"target\":34962", array.stride());
            let view = self.view(self.bytes, array.bytes(), &about);
            let _ = write!(attributes, ",{}:{view}", array.name());
            self.accessor(&array.accessor(view));
            self.bytes += array.bytes();
        }
        let meshes = &mut self.meshes;
        let comma = if meshes.is_empty() { "" } else { "," };
        let _ = write!(meshes, "{comma}{{\"primitives\":[{{\"attributes\":{{{attributes}}},\"indices\":{indices}}}]}}");
    }

    /// Adds a view of the data, and gives its number, which is that of the accessor to be added next.
    fn view(&mut self, offset: u64, length: u64, about: &str) -> usize {
        let comma = if self.views.is_empty() { "" } else { "," };
        let offset = if offset == 0 { String::new() } else { format!("\"byteOffset\":{offset},") };
        let _ = write!(self.views, "{comma}{{\"buffer\":0,{offset}\"byteLength\":{length},{about}}}");
        self.count
    }

    fn accessor(&mut self, text: &str) {
        if !self.accessors.is_empty() {
            self.accessors.push(',');
        }
        self.accessors.push_str(text);
        self.count += 1;
    }
}

/// From z up and the front towards -y, as Lumen has it, to y up and the front towards z: a right angle, exactly.
fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}
