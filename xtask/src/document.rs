//! The parts of pages under `docs/` that commands write, between `<!-- generated: NAME -->` and `<!-- end -->`.

use anyhow::{Context as _, Result};

use crate::step::root;

/// Puts `text` into the place called `name` of `docs/benchmarks.md`.
pub(crate) fn replace(name: &str, text: &str) -> Result<()> {
    replace_in("docs/benchmarks.md", name, text)
}

/// Puts `text` into the place called `name` of a page.
pub(crate) fn replace_in(page: &str, name: &str, text: &str) -> Result<()> {
    let file = root().join(page);
    let old = std::fs::read_to_string(&file).with_context(|| format!("{page} cannot be read"))?;
    let new = replaced(&old, name, text).with_context(|| format!("{page} has no place for {name}"))?;
    std::fs::write(&file, new).with_context(|| format!("{page} cannot be written"))
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
