//! The files of one or more crates, and which of them uses what of which.
//!
//! A file uses another if it names something that is defined there, by whatever way: what a module hands on by
//! `pub use` belongs to the file that defines it, so a `mod.rs` that only declares and hands on is used by nobody.

use std::collections::{BTreeMap, BTreeSet};

use super::source::{Import, Source};

/// Where files are read from: a folder, or what a test makes up.
pub(super) trait Files {
    fn text(&self, path: &str) -> Option<String>;
}

#[derive(Default)]
pub(super) struct Program {
    modules: Vec<Module>,
    crates: BTreeMap<String, usize>,
    /// Files that a `mod` declares and that are not there.
    pub(super) missing: Vec<String>,
}

struct Module {
    file: String,
    parent: usize,
    /// More than one where a condition decides which it is.
    children: BTreeMap<String, Vec<usize>>,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
    quoted: Vec<Vec<String>>,
}

impl Module {
    /// Whether it uses by itself what it imports so.
    fn names(&self, import: &Import) -> bool {
        self.paths.iter().chain(&self.quoted).any(|path| path[0] == import.name)
    }
}

/// File by file, which others it uses, and by which names.
pub(super) type Uses = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// So many `pub use` may lead on to each other.
const DEPTH: usize = 16;

impl Program {
    /// Adds a crate: the name that others know it by, and its first file.
    pub(super) fn add(&mut self, files: &impl Files, name: &str, root: &str) {
        let folder = root.rsplit_once('/').map_or("", |(folder, _)| folder).to_string();
        let index = self.read(files, root.to_string(), &folder, None);
        self.crates.extend(index.map(|index| (name.to_string(), index)));
    }

    /// Reads a file whose child modules stand in `folder`.
    fn read(&mut self, files: &impl Files, file: String, folder: &str, parent: Option<usize>) -> Option<usize> {
        let Some(text) = files.text(&file) else {
            self.missing.push(file);
            return None;
        };
        Some(self.module(files, &file, folder, parent, Source::of(&text)))
    }

    fn module(&mut self, files: &impl Files, file: &str, folder: &str, parent: Option<usize>, source: Source) -> usize {
        let index = self.modules.len();
        let Source { files: declared, parts, imports, paths, quoted } = source;
        self.modules.push(Module {
            file: file.to_string(),
            parent: parent.unwrap_or(index),
            children: BTreeMap::new(),
            imports,
            paths,
            quoted,
        });
        for child in declared {
            let inside = format!("{folder}/{}", child.name);
            let file = match &child.path {
                Some(path) => format!("{}/{path}", file.rsplit_once('/').map_or("", |(folder, _)| folder)),
                None => {
                    let beside = format!("{inside}.rs");
                    if files.text(&beside).is_some() { beside } else { format!("{inside}/mod.rs") }
                }
            };
            let read = self.read(files, file, &inside, Some(index));
            self.modules[index].children.entry(child.name).or_default().extend(read);
        }
        for (name, part) in parts {
            let child = self.module(files, file, &format!("{folder}/{name}"), Some(index), part);
            self.modules[index].children.entry(name).or_default().push(child);
        }
        index
    }

    /// Which file uses which.
    pub(super) fn uses(&self) -> Uses {
        self.by_file(|index, module| {
            let is_used = |import: &&Import| !import.public || module.names(import);
            let imported = module.imports.iter().filter(is_used).map(|import| &import.path);
            let items = imported.chain(&module.paths).chain(&module.quoted);
            let items = items.map(|path| (path, self.defining(index, path, DEPTH)));
            // Between quotes a module may stand for what is in it, and one that no path begins with for all of that.
            let unnamed = module.imports.iter().filter(|import| !import.public && !module.names(import));
            let modules = unnamed.map(|import| &import.path).chain(&module.quoted);
            items.chain(modules.map(|path| (path, self.files_at(index, path)))).collect()
        })
    }

    /// What files hand on by `pub use` and do not use themselves.
    pub(super) fn handed_on(&self) -> Uses {
        self.by_file(|index, module| {
            let handed_on = module.imports.iter().filter(|import| import.public && !module.names(import));
            let files = |path| [self.defining(index, path, DEPTH), self.files_at(index, path)].concat();
            handed_on.map(|import| (&import.path, files(&import.path))).collect()
        })
    }

    /// File by file, what `named` says of its modules: paths, and the files that each means.
    fn by_file<'a>(&'a self, named: impl Fn(usize, &'a Module) -> Vec<(&'a Vec<String>, Vec<String>)>) -> Uses {
        let mut uses = Uses::new();
        for (index, module) in self.modules.iter().enumerate() {
            let used = uses.entry(module.file.clone()).or_default();
            for (path, files) in named(index, module) {
                for file in files.into_iter().filter(|file| *file != module.file) {
                    used.entry(file).or_default().insert(path.join("::"));
                }
            }
        }
        uses
    }

    /// File by file, the crates that are not ours, by which a path or an import begins.
    pub(super) fn others(&self) -> BTreeMap<String, BTreeSet<String>> {
        let mut others = BTreeMap::<String, BTreeSet<String>>::new();
        for module in &self.modules {
            let longer = module.paths.iter().chain(&module.quoted).filter(|path| path.len() > 1);
            let paths = module.imports.iter().map(|import| &import.path).chain(longer);
            let first = paths.map(|path| path[0].clone()).filter(|name| !module.children.contains_key(name));
            others.entry(module.file.clone()).or_default().extend(first);
        }
        others
    }

    /// Imports of everything in a module of ours, which hide what a file uses.
    pub(super) fn globs(&self) -> Vec<String> {
        let ours = |index, import: &Import| !self.modules_at(index, &import.path, DEPTH).is_empty();
        let modules = self.modules.iter().enumerate();
        modules
            .filter(|(index, module)| module.imports.iter().any(|import| import.name == "*" && ours(*index, import)))
            .map(|(_, module)| module.file.clone())
            .collect()
    }

    /// The files that define what `path` means in the module `from`; none if it is a module alone, or is not ours.
    fn defining(&self, from: usize, path: &[String], depth: usize) -> Vec<String> {
        let [modules @ .., last] = path else { return Vec::new() };
        if modules.is_empty() {
            return self.imported(from, last, depth);
        }
        let mut files = Vec::new();
        for end in 1..path.len() {
            // Behind the last module stands an item, and behind that at most what belongs to it. An item may bear the
            // name of a module.
            let found = self.modules_at(from, &path[..end], depth);
            let deeper = self.modules_at(from, &path[..=end], depth);
            let is_last = end + 1 == path.len();
            if found.is_empty() || !deeper.is_empty() && !is_last {
                continue;
            }
            for module in found {
                let has = |import: &Import| import.name == path[end];
                if self.modules[module].imports.iter().any(has) {
                    files.extend(self.imported(module, &path[end], depth));
                } else if deeper.is_empty() {
                    files.push(self.modules[module].file.clone());
                }
            }
            return files;
        }
        // Something imported, and what belongs to it.
        self.imported(from, &path[0], depth)
    }

    /// The files that define what the module imports as `name`.
    fn imported(&self, module: usize, name: &str, depth: usize) -> Vec<String> {
        let Some(depth) = depth.checked_sub(1) else { return Vec::new() };
        let imports = self.modules[module].imports.iter().filter(|import| import.name == name);
        imports.flat_map(|import| self.defining(module, &import.path, depth)).collect()
    }

    /// The files of the modules that `path` means in the module `from`.
    fn files_at(&self, from: usize, path: &[String]) -> Vec<String> {
        self.modules_at(from, path, DEPTH).into_iter().map(|module| self.modules[module].file.clone()).collect()
    }

    /// The modules that `path` means in the module `from`.
    fn modules_at(&self, from: usize, path: &[String], depth: usize) -> Vec<usize> {
        let Some(depth) = depth.checked_sub(1) else { return Vec::new() };
        let [first, rest @ ..] = path else { return vec![from] };
        let mut modules = match first.as_str() {
            "crate" => vec![self.root(from)],
            "self" => vec![from],
            "super" => vec![self.modules[from].parent],
            name => {
                let mut known = self.children(from, name, depth);
                if known.is_empty() {
                    known.extend(self.crates.get(name));
                }
                known
            }
        };
        for name in rest {
            modules = match name.as_str() {
                "super" => modules.iter().map(|&module| self.modules[module].parent).collect(),
                "self" => modules,
                name => modules.iter().flat_map(|&module| self.children(module, name, depth)).collect(),
            };
        }
        modules
    }

    /// The modules that a module declares or imports under a name.
    fn children(&self, module: usize, name: &str, depth: usize) -> Vec<usize> {
        let Module { children, imports, .. } = &self.modules[module];
        if let Some(children) = children.get(name) {
            return children.clone();
        }
        let imports = imports.iter().filter(|import| import.name == name);
        imports
            // `use name::...` is about another crate, not about itself.
            .filter(|import| import.path.len() > 1 || import.path[0] != name)
            .flat_map(|import| self.modules_at(module, &import.path, depth))
            .collect()
    }

    fn root(&self, mut module: usize) -> usize {
        while self.modules[module].parent != module {
            module = self.modules[module].parent;
        }
        module
    }
}
