//! The glue between page and module, made short: wasm-bindgen gives each import a name with a hash in it, which no compression
//! shortens, and each stands in the module and in the glue.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result};
use wasm_bindgen_cli_support::Bindgen;

use crate::step::run;

/// Lets wasm-bindgen write module and glue of a compiled program into the folder `made`, with short names for what the two
/// have of each other.
pub(crate) fn write(compiled: &Path, made: &Path) -> Result<()> {
    let mut output = Bindgen::new().input_path(compiled).web(true)?.typescript(false).generate_output()?;
    let words = words(output.js());
    let counts = words.iter().fold(BTreeMap::<&str, usize>::new(), |mut counts, word| {
        *counts.entry(word).or_default() += 1;
        counts
    });
    let mut fresh = (0..).map(|number| format!("_{number}")).filter(|name| !counts.contains_key(name.as_str()));
    let mut short = BTreeMap::new();
    let module = output.wasm();
    let imports = module.imports.iter().map(|import| &import.name);
    let exports = module.exports.iter().map(|export| &export.name);
    for name in imports.chain(exports).filter(|name| has_hash(name) && counts.contains_key(name.as_str())) {
        short.entry(name.clone()).or_insert_with(|| fresh.next().unwrap_or_else(|| name.clone()));
    }
    let glue: String = words.iter().map(|word| short.get(*word).map_or(*word, String::as_str)).collect();
    let module = output.wasm_mut();
    for import in module.imports.iter_mut() {
        rename(&mut import.name, &short);
    }
    for export in module.exports.iter_mut() {
        rename(&mut export.name, &short);
    }
    output.emit(made)?;
    let name = compiled.file_stem().context("a program has no name")?;
    let file = made.join(name).with_extension("js");
    std::fs::write(&file, glue).with_context(|| format!("{} cannot be written", file.display()))
}

/// Takes comments, spaces and long names of its own out of a script.
pub(crate) fn shorten(npm: &Path, script: &Path) -> Result<()> {
    let terser = npm.join("node_modules/terser/bin/terser");
    let options = ["--module", "--compress", "--mangle", "--output"];
    run(Command::new("node").arg(terser).arg(script).args(options).arg(script))
}

/// Whether a part of a name is sixteen hexadecimal digits, with or without an h before them.
fn has_hash(name: &str) -> bool {
    name.split('_').any(|part| {
        let digits = part.strip_prefix('h').unwrap_or(part);
        digits.len() == 16 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
    })
}

fn rename(name: &mut String, short: &BTreeMap<String, String>) {
    if let Some(other) = short.get(name) {
        name.clone_from(other);
    }
}

/// A script in pieces: names, and what stands between them.
fn words(script: &str) -> Vec<&str> {
    let is_of_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '$';
    let mut words = Vec::new();
    let mut rest = script;
    while let Some(first) = rest.chars().next() {
        let kind = is_of_name(first);
        let end = rest.find(|letter| is_of_name(letter) != kind).unwrap_or(rest.len());
        words.push(&rest[..end]);
        rest = &rest[end..];
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_a_hash_are_known_from_others() {
        for name in ["__wbg_now_0123456789abcdef", "wasm_bindgen__closures___h5a38fa006f145a75_12"] {
            assert!(has_hash(name), "{name}");
        }
        for name in ["worker_main", "__wbindgen_init_externref_table", "__wbg_now_0123456789abcdeg", "_abcdef"] {
            assert!(!has_hash(name), "{name}");
        }
    }

    #[test]
    fn a_script_is_the_sum_of_its_words() {
        let script = "import { a } from './b.js';\nwasm.__wbg_now_0123456789abcdef($x, ü);\n";
        let words = words(script);
        assert_eq!(words.concat(), script);
        assert!(words.contains(&"__wbg_now_0123456789abcdef") && words.contains(&"$x"));
    }
}
