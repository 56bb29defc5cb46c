//! What is wrong in a VTK file of a surface.

use lumen_message::messages;

use super::super::problem::Problem;

messages! {
    /// What is wrong in a VTK file of a surface.
    #[derive(Clone, Debug, PartialEq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum VtkProblem {
        "errors-at-byte" AtByte { problem: Box<Problem>, byte: usize } => "{problem} at byte {byte}",
        "errors-vtk-xml" Xml => "its XML is wrong or incomplete there",
        "errors-vtk-no-file" NoFile => "it has no element \"VTKFile\"",
        "errors-vtk-no-arrays" NoArrays { element: &'static str } => "\"{element}\" has no arrays",
        "errors-vtk-no-points" NoPoints => "a piece has no points",
        "errors-vtk-fractions" Fractions => "its cells are numbered with fractions",
        "errors-vtk-beyond" ArrayBeyond => "an array lies beyond the end of the file",
        "errors-vtk-underscore" NoUnderscore => "its appended data do not begin with an underscore",
        "errors-vtk-no-place" NoPlace => "an array does not say where its data are",
        "errors-vtk-array-end" ArrayEnds => "an array goes on beyond the end of its data, or these are damaged",
        "errors-vtk-block" Block => "a compressed block is damaged",
        "errors-vtk-cell" CellLength { cell: u64, length: f64 } => "cell {cell} has the length {length}",
        "errors-vtk-third-line" ThirdLine => "neither \"ASCII\" nor \"BINARY\" stands in its third line",
        "errors-vtk-no-part" NoPart { word: String } => "{word} is no part of a surface",
        "errors-vtk-no-types" NoTypes => "its cells have no types",
        "errors-vtk-cells-lack" CellsLack { name: &'static str } => "{name} of its cells are missing",
        "errors-vtk-ends-count" EndsAtCount => "it ends where a count should stand",
        "errors-vtk-ends-type" EndsAtType => "it ends where a type should stand",
        "errors-vtk-field-type" FieldType => "a field has values of a type that is not known",
    }
}
