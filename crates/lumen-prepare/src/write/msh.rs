//! Gmsh MSH 4.1 as text: a discrete surface for each patch, of the physical surface with the patch's id and name.
//!
//! Arrays are views, on nodes or on elements.
//!
//! A node belongs to the first patch that uses it: Gmsh has the rims where patches meet as curves, which nothing that
//! follows needs.

use lumen_mesh::arrays::Association;
use lumen_mesh::{Array, used_vertices};

use super::{NOTICE, Sheet, point, put, tuple};

/// Numbers of a scalar, a vector and a tensor. What has others gets zeros behind them.
const COMPONENTS: [usize; 3] = [1, 3, 9];

pub(super) fn msh(sheet: &Sheet, arrays: &[Array]) -> String {
    let Sheet { mesh, parts } = sheet;
    let text = &mut String::new();
    text.push_str("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    put!(text, "$Comments\nLengths in mm. {NOTICE}\n$EndComments");
    put!(text, "$PhysicalNames\n{}", parts.len());
    for part in parts {
        put!(text, "2 {} \"{}\"", part.patch.id, part.name);
    }
    put!(text, "$EndPhysicalNames\n$Entities\n0 0 {} 0", parts.len());
    for part in parts {
        let corners = || sheet.corners(part).flatten();
        let low = corners().fold(glam::Vec3::INFINITY, glam::Vec3::min);
        let high = corners().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
        let id = part.patch.id;
        put!(text, "{id} {} {} 1 {id} 0", point(low, " "), point(high, " "));
    }
    text.push_str("$EndEntities\n");
    let mut is_written = vec![false; mesh.positions.len()];
    put!(text, "$Nodes\n{} {nodes} 1 {nodes}", parts.len(), nodes = mesh.positions.len());
    for part in parts {
        let of_part: Vec<[u32; 3]> = sheet.vertices(part).collect();
        let mut own = used_vertices(mesh.positions.len(), &of_part);
        own.retain(|&v| !std::mem::replace(&mut is_written[v as usize], true));
        put!(text, "2 {} 0 {}", part.patch.id, own.len());
        own.iter().for_each(|v| put!(text, "{}", v + 1));
        own.iter().for_each(|&v| put!(text, "{}", point(mesh.positions[v as usize], " ")));
    }
    put!(text, "$EndNodes\n$Elements\n{} {elements} 1 {elements}", parts.len(), elements = mesh.triangles.len());
    for part in parts {
        put!(text, "2 {} 2 {}", part.patch.id, part.triangles.len());
        for (t, [a, b, c]) in part.triangles.iter().zip(sheet.vertices(part)) {
            put!(text, "{} {} {} {}", t + 1, a + 1, b + 1, c + 1);
        }
    }
    text.push_str("$EndElements\n");
    arrays.iter().for_each(|array| view(text, array));
    std::mem::take(text)
}

/// An array as a view; left out where a tuple has more numbers than a tensor.
fn view(text: &mut String, array: &Array) {
    let section = if array.on == Association::Point { "NodeData" } else { "ElementData" };
    let Some(components) = COMPONENTS.into_iter().find(|&most| array.components <= most) else { return };
    let name = array.name.replace('"', "'").replace(['\n', '\r'], " ");
    // A name, a time, a step, and how many numbers and tuples there are.
    put!(text, "${section}\n1\n\"{name}\"\n1\n0.0\n3\n0\n{components}\n{}", array.len());
    (0..array.len()).for_each(|i| put!(text, "{} {}", i + 1, tuple(array, i, components)));
    put!(text, "$End{section}");
}
