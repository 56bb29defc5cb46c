//! Which format has a place for which array.

use super::Format;
use super::formats::Arrays;
use lumen_mesh::Array;
use lumen_mesh::arrays::Association;
use lumen_message::messages;

/// Each array, and whether `format` has a place for it.
fn places(arrays: &[Array], format: Format) -> impl Iterator<Item = (&Array, bool)> {
    let places = &format.written().arrays;
    let colour = if let Arrays::Colour(of) = places { of(arrays) } else { None };
    arrays.iter().map(move |array| {
        let has_place = match places {
            Arrays::All => true,
            Arrays::None => false,
            Arrays::Colour(_) => colour.is_some_and(|colour| std::ptr::eq(colour, array)),
            Arrays::Vertices(has_place) => has_place(array),
        };
        (array, has_place)
    })
}

messages! {
    /// Arrays that have no place in a format.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum LeftOut {
        /// The format has no arrays.
        "errors-no-place-arrays" All {
            /// The format.
            format: &'static str,
            /// How many there are.
            count: usize,
            /// Their names, with commas between.
            names: String,
        } => (
            count,
            "{format} has no place for arrays: {names} is left out.",
            "{format} has no place for arrays: {names} are left out."
        ),
        /// It has none of triangles.
        "errors-no-place-triangles" OfTriangles {
            /// The format.
            format: &'static str,
            /// How many there are.
            count: usize,
            /// Their names, with commas between.
            names: String,
        } => (
            count,
            "{format} has no place for arrays of triangles: {names} is left out.",
            "{format} has no place for arrays of triangles: {names} are left out."
        ),
        /// It has one colour alone.
        "errors-no-place-colour" AllButColour {
            /// The format.
            format: &'static str,
            /// How many there are.
            count: usize,
            /// Their names, with commas between.
            names: String,
        } => (
            count,
            "{format} has no place for arrays other than one colour: {names} is left out.",
            "{format} has no place for arrays other than one colour: {names} are left out."
        ),
        /// It has none of their types.
        "errors-no-place-such" Such {
            /// The format.
            format: &'static str,
            /// How many there are.
            count: usize,
            /// Their names, with commas between.
            names: String,
        } => (
            count,
            "{format} has no place for such arrays: {names} is left out.",
            "{format} has no place for such arrays: {names} are left out."
        ),
    }
}

/// The arrays that a file of `format` does not hold, if there are any.
pub fn left_out(arrays: &[Array], format: Format) -> Option<LeftOut> {
    let homeless = || places(arrays, format).filter(|&(_, has_place)| !has_place).map(|(array, _)| array);
    let names: Vec<&str> = homeless().map(|array| array.name.as_str()).collect();
    if names.is_empty() {
        return None;
    }
    let of_triangles = homeless().all(|array| array.on == Association::Triangle);
    let (label, count, names) = (format.label(), names.len(), names.join(", "));
    Some(match format.written().arrays {
        Arrays::Vertices(_) if of_triangles => LeftOut::OfTriangles { format: label, count, names },
        Arrays::Colour(_) => LeftOut::AllButColour { format: label, count, names },
        Arrays::None => LeftOut::All { format: label, count, names },
        _ => LeftOut::Such { format: label, count, names },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::arrays::{Scalar, Values};

    #[test]
    fn what_a_format_leaves_out_is_one_sentence() {
        let zeros = |scalar| Values::from_bytes(scalar, vec![0; 96]);
        let height = Array::new("Height", Association::Point, 1, zeros(Scalar::F32));
        let face = Array::new("Face", Association::Triangle, 1, zeros(Scalar::I32));
        let colour = Array::new("RGB", Association::Point, 3, zeros(Scalar::F32));
        let tensor = Array::new("Stress", Association::Point, 9, zeros(Scalar::F64));
        let all = [height, face, colour, tensor];
        for format in [Format::Vtp, Format::Vtk, Format::Ply] {
            assert_eq!(left_out(&all, format), None);
        }
        let said = |arrays: &[Array], format| left_out(arrays, format).unwrap().to_string();
        assert_eq!(said(&all, Format::Stl), "STL has no place for arrays: Height, Face, RGB, Stress are left out.");
        assert_eq!(
            said(&all[..3], Format::Obj),
            "OBJ has no place for arrays other than one colour: Height, Face are left out."
        );
        let two = [all[2].clone(), Array { name: "RGBA".to_owned(), ..all[2].clone() }];
        assert_eq!(said(&two, Format::Obj), "OBJ has no place for arrays other than one colour: RGBA is left out.");
        assert_eq!(said(&all[..3], Format::Glb), "GLB has no place for arrays of triangles: Face is left out.");
        assert_eq!(said(&all, Format::Glb), "GLB has no place for such arrays: Face, Stress are left out.");
    }
}
