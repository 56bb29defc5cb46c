//! What every fuzz target checks.

use lumen_io::volume::{self, Head, Part, Scan, ScanError};
use lumen_io::{ImportOptions, Imported, read};
use lumen_mesh::arrays::Association;

/// Reads bytes that may be anything: they give a sound surface or a sentence. Panics, hangs and memory are libFuzzer's to
/// find.
pub fn survives(bytes: &[u8], name: &str) {
    match read(bytes, name, &ImportOptions::default()) {
        Ok(Imported { mesh, arrays, report }) => {
            assert!(!mesh.triangles.is_empty() && report.area_mm2.is_finite());
            assert!(mesh.triangles.as_flattened().iter().all(|&v| (v as usize) < mesh.positions.len()));
            for array in &arrays {
                let rows = if array.on == Association::Point { mesh.positions.len() } else { mesh.triangles.len() };
                assert_eq!(array.values.len(), rows * array.components);
            }
            assert!(mesh.positions.iter().all(|p| p.is_finite()));
        }
        Err(error) => assert!(error.to_string().ends_with('.')),
    }
}

/// Bytes of a file that are known before the rest comes in pieces: those that say what it is.
const KNOWN: usize = 4096;
/// Bytes of such a piece.
const PIECE: usize = 61;

/// Reads bytes that may be anything as a scan, or as a header with its data: they give a number for each point in a place, or a
/// sentence, and the same whole and in pieces.
pub fn survives_as_scan(bytes: &[u8]) {
    let (first, second) = bytes.split_at(bytes.len() / 2);
    let alone = [Part { name: "a.hdr", bytes }];
    let both = [Part { name: "a.raw", bytes: second }, Part { name: "a.hdr", bytes: first }];
    for parts in [&alone[..], &both] {
        let whole = volume::read(parts);
        match &whole {
            Ok(scan) => {
                let geometry = scan.grid.geometry();
                assert!(geometry.check().is_ok() && geometry.points() == scan.grid.samples().len());
            }
            Err(error) => assert!(error.to_string().ends_with('.')),
        }
        if let Some(scan) = in_pieces(parts) {
            assert_eq!(scan.is_ok(), whole.is_ok());
            if let (Ok(scan), Ok(whole)) = (scan, whole) {
                assert!(
                    scan.grid.geometry() == whole.grid.geometry()
                        && scan.grid.samples().len() == whole.grid.samples().len()
                );
            }
        }
    }
}

/// The scan in files of which the beginnings are known, its numbers in pieces; `None` where they do not come so.
fn in_pieces(parts: &[Part]) -> Option<Result<Scan, ScanError>> {
    let head = |part: &Part<'_>| part.bytes.len().min(KNOWN);
    let heads: Vec<Head> = parts
        .iter()
        .map(|part| Head { name: part.name, bytes: &part.bytes[..head(part)], length: part.bytes.len() as u64 })
        .collect();
    let mut stream = volume::begin(&heads).ok()??;
    let start = usize::try_from(stream.start()).ok()?.min(parts[stream.file()].bytes.len());
    for piece in parts[stream.file()].bytes[start..].chunks(PIECE) {
        if let Err(error) = stream.push(piece) {
            return Some(Err(error));
        }
    }
    Some(stream.finish())
}
