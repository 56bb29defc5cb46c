//! What every fuzz target checks.

use lumen::io::{ImportOptions, Imported, read};
use lumen::mesh::arrays::On;

/// Reads bytes that may be anything: they give a sound surface or a sentence. Panics, hangs and memory are libFuzzer's to
/// find.
pub fn survives(bytes: &[u8], name: &str) {
    match read(bytes, name, &ImportOptions::default()) {
        Ok(Imported { mesh, arrays, report }) => {
            assert!(!mesh.triangles.is_empty() && report.area_mm2.is_finite());
            assert!(mesh.triangles.as_flattened().iter().all(|&v| (v as usize) < mesh.positions.len()));
            for array in &arrays {
                let rows = if array.on == On::Point { mesh.positions.len() } else { mesh.triangles.len() };
                assert_eq!(array.values.len(), rows * array.components);
            }
            assert!(mesh.positions.iter().all(|p| p.is_finite()));
        }
        Err(error) => assert!(error.to_string().ends_with('.')),
    }
}
