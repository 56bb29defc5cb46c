//! The parts of `docs/benchmarks.md` that commands write, between `<!-- generated: NAME -->` and `<!-- end -->`.

use anyhow::{Context as _, Result};

use crate::step::root;

/// Puts `text` into the place called `name`.
pub(crate) fn replace(name: &str, text: &str) -> Result<()> {
    let file = root().join("docs/benchmarks.md");
    let page = std::fs::read_to_string(&file).context("docs/benchmarks.md cannot be read")?;
    let page = replaced(&page, name, text).with_context(|| format!("docs/benchmarks.md has no place for {name}"))?;
    std::fs::write(&file, page).context("docs/benchmarks.md cannot be written")
}

fn replaced(page: &str, name: &str, text: &str) -> Option<String> {
    let mark = format!("<!-- generated: {name} -->\n");
    let (before, rest) = page.split_once(&mark)?;
    let (_, after) = rest.split_once("<!-- end -->")?;
    Some(format!("{before}{mark}\n{}\n\n<!-- end -->{after}", text.trim()))
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
}
