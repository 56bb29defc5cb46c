//! Pages and tables under `docs/` that commands write: a text between `<!-- generated: NAME -->` and `<!-- end -->`, or a
//! table in a CSV file of its own.

use std::fmt::Write as _;

use anyhow::{Context as _, Result};

use crate::step::root;

/// Puts `text` into the place called `name` of a page.
pub(crate) fn replace(page: &str, name: &str, text: &str) -> Result<()> {
    let file = root().join(page);
    let old = std::fs::read_to_string(&file).with_context(|| format!("{page} cannot be read"))?;
    let new = replaced(&old, name, text).with_context(|| format!("{page} has no place for {name}"))?;
    std::fs::write(&file, new).with_context(|| format!("{page} cannot be written"))
}

/// Writes the Markdown tables of `text` as one CSV file, the heading above each table as the first column.
pub(crate) fn write_csv(page: &str, text: &str) -> Result<()> {
    std::fs::write(root().join(page), csv(text)).with_context(|| format!("{page} cannot be written"))
}

fn replaced(page: &str, name: &str, text: &str) -> Option<String> {
    let mark = format!("<!-- generated: {name} -->\n");
    let (before, rest) = page.split_once(&mark)?;
    let (_, after) = rest.split_once("<!-- end -->")?;
    Some(format!("{before}{mark}\n{}\n\n<!-- end -->{after}", text.trim()))
}

fn csv(text: &str) -> String {
    let (mut heading, mut head, mut rows) = ("", None, String::new());
    for line in text.lines() {
        if let Some(words) = line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#')) {
            heading = words;
            continue;
        }
        let Some(cells) = line.strip_prefix('|').and_then(|line| line.strip_suffix('|')) else { continue };
        let cells: Vec<&str> = cells.split('|').map(str::trim).collect();
        if cells.iter().all(|cell| cell.chars().all(|c| "-:".contains(c)) && !cell.is_empty()) {
            continue;
        }
        let first = if head.as_ref() == Some(&cells) { continue } else { heading };
        let first = if head.is_none() { "surface" } else { first };
        let quoted = [first].into_iter().chain(cells.iter().copied()).map(|cell| field(&cell.replace("**", "")));
        let _ = writeln!(rows, "{}", quoted.collect::<Vec<_>>().join(","));
        head.get_or_insert(cells);
    }
    rows
}

/// A field as RFC 4180 has it.
pub(crate) fn field(text: &str) -> String {
    if text.contains([',', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_filled_again_and_again_and_the_rest_stays() {
        let page = "# Title\n\n<!-- generated: one -->\n<!-- end -->\n\nBy hand.\n\n<!-- generated: two -->\nold\n<!-- end -->\n";
        let once = replaced(page, "one", "first").unwrap();
        let twice = replaced(&once, "one", "| a |\n").unwrap();
        assert_eq!(twice, page.replace("one -->\n", "one -->\n\n| a |\n\n"));
        assert_eq!(replaced(page, "three", "text"), None);
    }

    #[test]
    fn tables_become_one_csv_with_their_headings() {
        let text = "### one, 60\n\n| a | b |\n|---|---:|\n| 1 | **missed**: x |\n\n### two\n\n| a | b |\n|---|---|\n| 2 |  |\n";
        assert_eq!(csv(text), "surface,a,b\n\"one, 60\",1,missed: x\ntwo,2,\n");
    }
}
