//! What is wrong in a PLY file.

use lumen_message::messages;

messages! {
    /// What is wrong in a PLY file.
    #[derive(Clone, Debug, PartialEq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum PlyProblem {
        "errors-ply-begin" Begin => "it does not begin with the word \"ply\"",
        "errors-ply-end" NoEndHeader => "its header has no \"end_header\"",
        "errors-ply-encoding" UnknownEncoding { word: String } => "the encoding {word} is not known",
        "errors-ply-no-encoding" NoEncoding => "its header does not say which encoding it has",
        "errors-ply-property-first" PropertyFirst => "a property stands before any element",
        "errors-ply-property" ShortProperty => "a property needs a type and a name",
        "errors-ply-no-xyz" NoCoordinates => "its vertices have no x, y and z",
        "errors-ply-list" ListLength { length: f64 } => "a list has the length {length}",
    }
}
