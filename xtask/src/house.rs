//! What Cargo cannot hold of the house: the order of the folders in `src`, and that files named in documents are there.

use std::path::{Path, PathBuf};

use crate::step::{files_below, root};

/// The folders of `src`, and which modules of the crate and crates of others a file there must not name.
const ORDER: [(&str, &[&str]); 6] = [
    ("sharing", &["crate::report", "crate::engine", "crate::app", "crate::cli", "crate::desktop", "egui", "rfd"]),
    ("report", &["crate::engine", "crate::app", "crate::cli", "crate::desktop", "egui", "rfd"]),
    ("engine", &["crate::app", "crate::cli", "crate::desktop", "egui", "rfd"]),
    ("app", &["crate::cli", "crate::desktop", "rfd", "hidapi", "tungstenite"]),
    ("cli", &["crate::desktop", "rfd", "hidapi", "tungstenite"]),
    ("desktop", &["crate::cli"]),
];

#[test]
fn the_folders_of_src_keep_their_order() {
    let mut wrong = Vec::new();
    for (folder, barred) in ORDER {
        for file in files_below(&root().join("src").join(folder)).unwrap() {
            let text = std::fs::read_to_string(&file).unwrap_or_default();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            for line in code {
                let names =
                    |name: &str| line.match_indices(name).any(|(at, _)| line[at + name.len()..].starts_with("::"));
                wrong
                    .extend(barred.iter().filter(|name| names(name)).map(|name| format!("{}: {name}", file.display())));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Folders that are not of the checkout: what a build makes, and the test data.
const ELSEWHERE: [&str; 4] = ["dist/", "target/", "bench/", "reject/"];

#[test]
fn files_that_documents_name_are_there() {
    let is_document = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "md");
    let mut documents = files_below(&root().join("docs")).unwrap();
    documents.extend(
        ["ARCHITECTURE.md", "CONTRIBUTING.md", "README.md", "SECURITY.md", "python/README.md"]
            .map(|name| root().join(name)),
    );
    documents.extend(crates().into_iter().map(|folder| folder.join("README.md")));
    let (mut found, mut missing) = (0, Vec::new());
    for document in documents.into_iter().filter(is_document) {
        for (line, number) in std::fs::read_to_string(&document).unwrap().lines().zip(1..) {
            let (there, others) = named(line, document.parent().unwrap());
            found += there;
            missing.extend(others.into_iter().map(|name| format!("{}:{number}: {name}", document.display())));
        }
    }
    assert!(found > 100, "only {found} names of files were found");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// The folders of the crates.
fn crates() -> Vec<PathBuf> {
    let folders = std::fs::read_dir(root().join("crates")).unwrap();
    folders.map(|folder| folder.unwrap().path()).filter(|folder| folder.is_dir()).collect()
}

/// A crate stands by itself: it says in a line and on half a page what it is, shows that by an example that is run, and
/// names the file for each thing.
#[test]
fn every_crate_is_described_where_others_would_look() {
    for folder in crates() {
        let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_default();
        let (readme, manifest) = (read("README.md"), read("Cargo.toml"));
        let name = folder.file_name().unwrap().to_string_lossy();
        assert!(manifest.contains("\ndescription = ") && manifest.contains("\nreadme = \"README.md\""), "{name}");
        assert!(read("src/lib.rs").starts_with("#![doc = include_str!(\"../README.md\")]"), "{name}");
        assert!(readme.starts_with(&format!("# {name}\n")) && readme.contains("Licence: "), "{name}");
        let code = readme.split("```rust").nth(1).and_then(|behind| behind.split("```").next()).unwrap_or_default();
        assert!(code.contains("assert"), "{name}: no example");
        let words = readme.split("```").step_by(2).flat_map(str::split_whitespace).count();
        assert!((80..=250).contains(&words), "{name}: {words} words");
    }
}

/// How many files and folders of those that a line names are there, and the others. A name may go on from the folder that
/// one before it in the line is, or is in.
fn named(line: &str, folder: &Path) -> (usize, Vec<String>) {
    let [src, docs] = ["src", "docs"].map(|name| root().join(name));
    let mut places = vec![root().to_path_buf(), src, docs, folder.to_path_buf(), folder.join("src")];
    let (mut found, mut missing) = (0, Vec::new());
    let is_here = |name: &String| !ELSEWHERE.iter().any(|folder| name.starts_with(folder));
    for (name, is_path) in names(line).into_iter().filter(|(name, _)| is_here(name)) {
        // Of names with a star the folder that it stands in.
        let sought =
            name.split_once('*').map_or(&*name, |(before, _)| before.rsplit_once('/').map_or("", |(at, _)| at));
        match places.iter().map(|place| place.join(sought)).find(|path| path.exists()) {
            Some(path) => {
                found += usize::from(is_path);
                let folder = if path.is_dir() { Some(&*path) } else { path.parent() };
                places.extend(folder.map(Path::to_path_buf));
            }
            None if is_path => missing.push(name),
            None => {}
        }
    }
    (found, missing)
}

/// What stands in a line between backticks, or as the target of a link, and may be the name of a file or folder, `{a,b}`
/// written out; and whether it can be nothing else.
fn names(line: &str) -> Vec<(String, bool)> {
    let is_sign = |c: char| c.is_ascii_alphanumeric() || "/._-{}*,".contains(c);
    let is_name = |name: &&str| name.chars().all(is_sign) && !name.starts_with('/') && !name.is_empty();
    let quoted = line.split('`').skip(1).step_by(2).filter(is_name).flat_map(written_out);
    let linked = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()).filter(is_name);
    let quoted = quoted.map(|name| {
        let last = name.rsplit('/').next().unwrap_or(&name);
        let is_path = name.starts_with("src/") || name.contains('/') && (last.is_empty() || last.contains('.'));
        (name, is_path)
    });
    quoted.chain(linked.map(|name| (name.to_owned(), true))).collect()
}

/// `a/{b,c}.rs` is `a/b.rs` and `a/c.rs`.
fn written_out(name: &str) -> Vec<String> {
    let braces = name.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)));
    let Some((before, (choices, after))) = braces else { return vec![name.to_owned()] };
    choices.split(',').flat_map(|choice| written_out(&format!("{before}{choice}{after}"))).collect()
}
