//! The table of formats and the documents that tell of it.

use lumen::io::Format;

#[test]
fn every_extension_has_a_row_in_the_documents_table() {
    let document = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/formats.md")).unwrap();
    let rows: Vec<String> = document.lines().filter(|line| line.starts_with("| ")).map(str::to_lowercase).collect();
    for extension in Format::opened() {
        let has_row = rows.iter().any(|row| row.starts_with(&format!("| {extension} ")));
        assert!(has_row, "docs/formats.md says nothing of {extension}");
    }
}
