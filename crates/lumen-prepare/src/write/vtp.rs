//! VTK XML PolyData as text, and the surface files of a SimVascular mesh, which are of the same kind.
//!
//! On cells stand `ModelFaceID`, the id of the patch, and `CapID`, the same for inlets and outlets and -1 for the wall; behind
//! them the arrays that were carried. The files of SimVascular also have `GlobalNodeID` and `GlobalElementID`, from 1 on: a vertex and a triangle have the number
//! of the whole surface in each file.

use std::fmt::Display;

use lumen_mesh::arrays::Association;
use lumen_mesh::{Array, used_vertices};

use super::{Part, Sheet, cap_id, point, put, tuple};
use crate::PatchKind;

/// Values on a line.
const ACROSS: usize = 12;
/// The arrays on cells that stand in every file.
const OWN: [&str; 2] = ["ModelFaceID", "CapID"];

/// The whole surface.
pub(super) fn vtp(sheet: &Sheet, arrays: &[Array]) -> String {
    polydata(sheet, &sheet.parts.iter().collect::<Vec<_>>(), arrays, false)
}

/// The files of a SimVascular mesh.
pub(super) fn simvascular(sheet: &Sheet) -> Vec<(String, String)> {
    let all: Vec<&Part> = sheet.parts.iter().collect();
    let walls: Vec<&Part> = all.iter().copied().filter(|part| part.patch.kind == PatchKind::Wall).collect();
    let mut files = vec![("mesh-complete.exterior.vtp".to_owned(), polydata(sheet, &all, &[], true))];
    if !walls.is_empty() {
        files.push(("walls_combined.vtp".to_owned(), polydata(sheet, &walls, &[], true)));
    }
    files.extend(
        all.iter().map(|part| (format!("mesh-surfaces/{}.vtp", part.name), polydata(sheet, &[part], &[], true))),
    );
    files
}

/// A file of these parts; triangles in the order of the surface. Of `arrays` each has a tuple for every vertex or triangle of
/// the whole surface.
fn polydata(sheet: &Sheet, parts: &[&Part], arrays: &[Array], with_global_ids: bool) -> String {
    let positions = &sheet.mesh.positions;
    let of_part = |part: &&Part| -> Vec<(u32, u32, i64)> {
        part.triangles.iter().map(|&t| (t, part.patch.id, cap_id(part.patch))).collect()
    };
    let mut cells: Vec<(u32, u32, i64)> = parts.iter().flat_map(of_part).collect();
    cells.sort_unstable();
    let triangles: Vec<[u32; 3]> = cells.iter().map(|&(t, ..)| sheet.mesh.triangles[t as usize]).collect();
    let vertices = used_vertices(positions.len(), &triangles);
    let mut place = vec![0; positions.len()];
    (0..).zip(&vertices).for_each(|(i, &v)| place[v as usize] = i);

    let text = &mut String::new();
    text.push_str("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n");
    put!(text, "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">", vertices.len(), cells.len());
    text.push_str("<PointData>\n");
    if with_global_ids {
        array(text, "Int32", "GlobalNodeID", vertices.iter().map(|v| v + 1));
    }
    arrays.iter().filter(|array| array.on == Association::Point).for_each(|array| carried(text, array, &vertices));
    text.push_str("</PointData>\n");
    text.push_str("<CellData>\n");
    array(text, "Int32", "ModelFaceID", cells.iter().map(|cell| cell.1));
    array(text, "Int32", "CapID", cells.iter().map(|cell| cell.2));
    if with_global_ids {
        array(text, "Int32", "GlobalElementID", cells.iter().map(|cell| cell.0 + 1));
    }
    let rows: Vec<u32> = cells.iter().map(|cell| cell.0).collect();
    let is_other = |array: &&Array| array.on == Association::Triangle && !OWN.contains(&array.name.as_str());
    arrays.iter().filter(is_other).for_each(|array| carried(text, array, &rows));
    text.push_str("</CellData>\n<Points>\n");
    put!(text, "<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">");
    vertices.iter().for_each(|&v| put!(text, "{}", point(positions[v as usize], " ")));
    text.push_str("</DataArray>\n</Points>\n<Polys>\n");
    array(text, "Int32", "connectivity", triangles.as_flattened().iter().map(|&v| place[v as usize]));
    array(text, "Int32", "offsets", (1..=triangles.len()).map(|t| 3 * t));
    text.push_str("</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    std::mem::take(text)
}

/// These rows of an array.
fn carried(text: &mut String, array: &Array, rows: &[u32]) {
    let kind = array.values.scalar().vtk_name();
    let (name, components) = (escaped(&array.name), array.components);
    put!(text, "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">");
    rows.iter().for_each(|&row| put!(text, "{}", tuple(array, row as usize, components)));
    text.push_str("</DataArray>\n");
}

/// A text as XML has it between quotation marks.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// An array of one number each.
fn array(text: &mut String, kind: &str, name: &str, values: impl Iterator<Item = impl Display>) {
    put!(text, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">");
    let values: Vec<String> = values.map(|value| value.to_string()).collect();
    values.chunks(ACROSS).for_each(|row| put!(text, "{}", row.join(" ")));
    text.push_str("</DataArray>\n");
}
