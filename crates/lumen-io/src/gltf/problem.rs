//! What is wrong in a glTF file.

use lumen_message::messages;

messages! {
    /// What is wrong in a glTF file.
    #[derive(Clone, Debug, PartialEq)]
    #[allow(missing_docs, reason = "its sentence says what each is")]
    pub enum GltfProblem {
        "errors-gltf-no-json" NoJson => "it has no JSON part",
        "errors-gltf-json" Json { line: usize, column: usize } => "its JSON is wrong or incomplete at line {line}, column {column}",
        "errors-gltf-no-scene" NoScene => "its scene is missing",
        "errors-gltf-no-node" NoNode { node: usize } => "node {node} is missing",
        "errors-gltf-node-twice" NodeTwice { node: usize } => "node {node} hangs from two others, or from itself",
        "errors-gltf-no-mesh" NoMesh { mesh: usize } => "mesh {mesh} is missing",
        "errors-gltf-mode" DrawingMode => "a mesh has a drawing mode that does not exist",
        "errors-gltf-base64" Base64 => "its base64 data are damaged",
        "errors-gltf-no-accessor" NoAccessor { accessor: usize } => "accessor {accessor} is missing",
        "errors-gltf-accessor-type" AccessorType { accessor: usize } => "accessor {accessor} has a type that does not exist",
        "errors-gltf-accessor-shape" AccessorShape { accessor: usize } =>
            "accessor {accessor} is not of the shape that its use asks for",
        "errors-gltf-accessor-empty" AccessorEmpty { accessor: usize } => "accessor {accessor} has no data",
        "errors-gltf-accessor-beyond" AccessorBeyond { accessor: usize } => "accessor {accessor} lies beyond the end of the data",
        "errors-gltf-accessor-overlap" AccessorOverlap { accessor: usize } => "accessor {accessor} has items that overlap",
        "errors-gltf-packed" Packed { view: usize } => "its compressed view {view} is damaged, or of a kind that is not read",
        "errors-gltf-skin" Skin { skin: usize } => "skin {skin} does not fit the scene or the mesh that it moves",
        "errors-gltf-indices" Indices => "its vertex numbers are not whole numbers without sign",
    }
}
