//! A surface as a GLB file.

use std::fmt::Write as _;

use super::super::error::WriteError;
use super::super::output::Output;
use super::arrays::Attribute;
use super::container::{BIN_CHUNK, JSON_CHUNK};

/// A GLB file of one mesh, with y up, in mm under a node scale of 0.001.
pub(super) fn write(output: &Output) -> Result<Vec<u8>, WriteError> {
    let Output { mesh, normals, .. } = *output;
    let (vertices, corners) = (mesh.positions.len(), 3 * mesh.triangles.len());
    let (vector_bytes, index_bytes) = (12 * vertices as u64, 4 * corners as u64);
    let arrays: Vec<Attribute> = output.arrays.iter().filter_map(Attribute::of).collect();
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

/// From z up and the front towards -y, as Lumen has it, to y up and the front towards z: a right angle, exactly.
fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}
