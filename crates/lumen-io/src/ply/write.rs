//! A surface as a PLY file.

use super::super::output::Output;
use super::arrays::Written;
use lumen_mesh::arrays::Association;

/// The little-endian binary form.
pub(super) fn write(output: &Output) -> Vec<u8> {
    let Output { mesh, normals, axes, .. } = *output;
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    let [on_vertices, on_triangles] =
        [Association::Point, Association::Triangle].map(|on| Written::on(on, output.arrays));
    let xyz = |names: [&str; 3]| names.map(|name| format!("property float {name}\n")).concat();
    let properties = |arrays: &[Written]| arrays.iter().map(Written::header).collect::<String>();
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment Surface written by Lumen; millimetres{}\n\
         element vertex {vertices}\n{}{}{}element face {triangles}\nproperty list uchar int vertex_indices\n{}end_header\n",
        axes.said(),
        xyz(["x", "y", "z"]),
        normals.map_or(String::new(), |_| xyz(["nx", "ny", "nz"])),
        properties(&on_vertices),
        properties(&on_triangles),
    );
    let mut out = header.into_bytes();
    out.reserve(vertices * if normals.is_some() { 24 } else { 12 } + triangles * 13);
    for (v, position) in mesh.positions.iter().enumerate() {
        for p in [Some(position), normals.map(|normals| &normals[v])].into_iter().flatten() {
            out.extend_from_slice(bytemuck::cast_slice(&p.to_array().map(f32::to_le_bytes)));
        }
        on_vertices.iter().for_each(|array| array.push(v, &mut out));
    }
    for (t, corners) in mesh.triangles.iter().enumerate() {
        out.push(3);
        out.extend_from_slice(bytemuck::cast_slice(&corners.map(u32::to_le_bytes)));
        on_triangles.iter().for_each(|array| array.push(t, &mut out));
    }
    out
}
