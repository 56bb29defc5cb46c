//! Joins the English messages into one file without comments and empty lines, a sixth of their size.

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=locales/en");
    let folder = std::env::var_os("OUT_DIR").expect("cargo sets it");
    std::fs::write(Path::new(&folder).join("english.ftl"), english()).expect("the folder is cargo's own");
}

/// The messages of `locales/en`, one file after another in the order of their names.
fn english() -> String {
    let files = std::fs::read_dir("locales/en").expect("it is there");
    let mut paths: Vec<_> = files.map(|file| file.expect("it can be listed").path()).collect();
    paths.sort();
    let mut all = String::new();
    for path in paths {
        let text = std::fs::read_to_string(path).expect("it can be read");
        // An empty line ends a message unless an indented one follows.
        let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
        for (i, line) in lines.iter().enumerate() {
            let next = lines[i + 1..].iter().find(|line| !line.is_empty());
            if !line.is_empty() || next.is_some_and(|next| next.starts_with(' ')) {
                all.push_str(line);
                all.push('\n');
            }
        }
    }
    all
}
