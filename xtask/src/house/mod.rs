//! What ARCHITECTURE.md says of the house, held by tests: a room knows only those below it, in a room no two files know
//! each other, directly or round about, some crates are for some rooms alone, and the files that are named are there.
//! The firmware, the fuzzing, the benches and all tests that stand outside of `src`, `tests/ui` too, are not read.
//!
//! - `source`: what a file declares and names; `program`: which file uses which of that; `circles`: those that use each
//!   other; `rooms`: the order; `documents`: the names in a document.

mod circles;
mod documents;
mod program;
mod rooms;
mod source;

use std::collections::BTreeMap;
use std::path::Path;

use self::circles::circles;
use self::program::{Files, Program, Uses};
use self::rooms::{EXCEPT, Order, may_use, room};
use crate::step::root;

/// The programs and libraries, by the names that others know them by, with their first files.
const CRATES: [(&str, &str); 6] = [
    ("lumen", "src/lib.rs"),
    ("lumen_program", "src/main.rs"),
    ("lumen_worker", "web/worker/src/lib.rs"),
    ("lumen_scan", "web/scan/src/main.rs"),
    ("lumen_web", "web/src/main.rs"),
    ("xtask", "xtask/src/main.rs"),
];

/// The files of a folder.
struct Checkout<'a>(&'a Path);

impl Files for Checkout<'_> {
    fn text(&self, path: &str) -> Option<String> {
        std::fs::read_to_string(self.0.join(path)).ok()
    }
}

/// The lines between the first fences of ARCHITECTURE.md.
fn order(document: &str) -> &str {
    let (_, rest) = document.split_once("```text\n").expect("ARCHITECTURE.md has the order of the rooms");
    rest.split_once("```").map_or(rest, |(lines, _)| lines)
}

/// Each file that one uses or hands on and that its room must not know.
fn upward(order: &Order, program: &Program) -> Vec<String> {
    let all = [program.uses(), program.handed_on()];
    let all = all.iter().flatten();
    let all = all.flat_map(|(file, used)| used.iter().map(move |(other, names)| (file, other, names)));
    let wrong = all.filter(|(file, other, _)| !order.allows(file, other));
    wrong.map(|(file, other, names)| format!("{file} uses {other}: {names:?}")).collect()
}

/// Each crate of others in a file that it is not for.
fn out_of_place(program: &Program) -> Vec<String> {
    let others = program.others();
    let named = others.iter().flat_map(|(file, crates)| crates.iter().map(move |name| (file, name)));
    named.filter(|(file, name)| !may_use(file, name)).map(|(file, name)| format!("{file} uses {name}")).collect()
}

fn house() -> Program {
    let mut program = Program::default();
    CRATES.iter().for_each(|(name, first)| program.add(&Checkout(root()), name, first));
    assert!(program.missing.is_empty(), "declared, but not there: {:?}", program.missing);
    program
}

#[test]
fn a_room_knows_only_those_below_it() {
    let architecture = Checkout(root()).text("ARCHITECTURE.md").unwrap();
    let lines = order(&architecture);
    let library = Checkout(root()).text("src/lib.rs").unwrap();
    let (_, map) = library.split_once("//! ```text\n").expect("src/lib.rs has the order of the rooms");
    let (map, _) = map.split_once("//! ```\n").unwrap();
    assert_eq!(map.replace("//! ", ""), lines, "src/lib.rs has the same order");
    let program = house();
    let uses = program.uses();
    assert!(uses.len() > 650, "only {} files were found", uses.len());
    let wrong = upward(&Order::of(lines), &program);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for (file, rooms) in EXCEPT {
        let used: Vec<&str> = uses.get(file).into_iter().flatten().map(|(other, _)| room(other)).collect();
        assert!(
            rooms.iter().all(|room| used.contains(room)),
            "{file} is an exception for {rooms:?}, but uses {used:?}"
        );
    }
}

#[test]
fn some_crates_are_for_some_rooms_alone() {
    let wrong = out_of_place(&house());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_crate_that_is_not_for_a_room_is_found() {
    let found = |mesh| {
        let files = [("src/lib.rs", "mod desktop; mod mesh;"), ("src/desktop.rs", "use rfd::FileDialog;")];
        out_of_place(&made_up([files[0], files[1], ("src/mesh.rs", mesh)]))
    };
    assert_eq!(
        found("use serde::Serialize; fn f(egui: u8) { rayon.wgpu(); \"web_sys::Blob\"; }"),
        Vec::<String>::new()
    );
    for (mesh, name) in [
        ("use rfd::FileDialog;", "rfd"),
        ("use ::{egui as e};", "egui"),
        ("fn f() { web_sys::window(); }", "web_sys"),
        ("#[serde(with = \"wgpu::a\")] struct S;", "wgpu"),
    ] {
        assert_eq!(found(mesh), [format!("src/mesh.rs uses {name}")], "{mesh}");
    }
}

#[test]
fn no_two_files_of_a_room_know_each_other() {
    let program = house();
    assert_eq!(program.globs(), Vec::<String>::new(), "`use ...::*` hides what a file knows");
    let uses = program.uses();
    let circles = circles(&uses);
    let told = circles.iter().map(|circle| {
        let within = |file: &str| uses[file].iter().filter(|(used, _)| circle.contains(*used)).collect::<Vec<_>>();
        let ways: Vec<String> = circle.iter().map(|file| format!("{file} uses {:?}", within(file))).collect();
        format!("a circle:\n{}", ways.join("\n"))
    });
    assert!(circles.is_empty(), "{}", told.collect::<Vec<_>>().join("\n"));
}

/// Folders that are not of the checkout: what a build makes, and the test data.
const ELSEWHERE: [&str; 4] = ["dist/", "target/", "bench/", "reject/"];

#[test]
fn files_that_documents_name_are_there() {
    let docs = std::fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().file_name());
    let docs = docs.filter_map(|name| Some(format!("docs/{}", name.to_str()?)));
    let mut documents = vec!["ARCHITECTURE.md".to_string(), "README.md".to_string()];
    documents.extend(docs.filter(|name| name.ends_with(".md")));
    let (mut found, mut missing) = (0, Vec::new());
    for document in documents {
        let text = Checkout(root()).text(&document).unwrap();
        for (line, number) in text.lines().zip(1..) {
            let (there, others) = named(line);
            found += there;
            missing.extend(others.into_iter().map(|name| format!("{document}:{number}: {name}")));
        }
    }
    assert!(found > 300, "only {found} names of files were found");
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

/// How many files and folders of those that a line names are there, and the others. A name may go on from the folder that
/// one before it in the line is, or is in.
fn named(line: &str) -> (usize, Vec<String>) {
    let mut places = vec![root().to_path_buf(), root().join("src"), root().join("docs")];
    let (mut found, mut missing) = (0, Vec::new());
    let is_here = |name: &String| !ELSEWHERE.iter().any(|folder| name.starts_with(folder));
    for (name, is_path) in documents::names(line).into_iter().filter(|(name, _)| is_here(name)) {
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

#[test]
fn a_name_in_a_document_that_is_no_file_is_missed() {
    let missed = |line| named(line).1;
    let line = "| `src/mesh` | `mending/`, `mending/{fill,none}.rs` or `none/`, `dist/`, `Event::Opened` |";
    assert_eq!(named(line), (3, vec!["mending/none.rs".to_string(), "none/".to_string()]));
    assert_eq!(missed("`locales/*/lesson.ftl`, `none/*/x.ftl`, `src/mesh/*.rs`"), ["none/*/x.ftl"]);
    assert_eq!(missed("`src/none`, `none`, [a](none.md), [b](benchmarks.md#c), [d](#e)"), ["src/none", "none.md"]);
}

#[test]
fn each_room_of_the_table_is_there() {
    let architecture = Checkout(root()).text("ARCHITECTURE.md").unwrap();
    let (_, table) = architecture.split_once("| room | what is in it |\n").unwrap();
    let rows = table.lines().take_while(|line| line.starts_with('|')).skip(1);
    let rooms: Vec<&str> = rows.map(|row| row.split('`').nth(1).unwrap()).collect();
    assert!(rooms.len() > 20, "only {rooms:?} were found");
    let missing: Vec<&&str> = rooms.iter().filter(|room| !root().join(room).exists()).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// A house that is made up: paths and texts.
#[derive(Default)]
struct MadeUp(BTreeMap<&'static str, &'static str>);

impl Files for MadeUp {
    fn text(&self, path: &str) -> Option<String> {
        self.0.get(path).map(ToString::to_string)
    }
}

fn made_up<const N: usize>(files: [(&'static str, &'static str); N]) -> Program {
    let mut program = Program::default();
    program.add(&MadeUp(files.into()), "lumen", "src/lib.rs");
    assert!(program.missing.is_empty(), "{:?}", program.missing);
    program
}

fn uses_of<const N: usize>(files: [(&'static str, &'static str); N]) -> Uses {
    made_up(files).uses()
}

fn circles_of<const N: usize>(files: [(&'static str, &'static str); N]) -> Vec<Vec<String>> {
    circles(&uses_of(files)).into_iter().map(|circle| circle.into_iter().collect()).collect()
}

const ROOM: [(&str, &str); 2] = [("src/lib.rs", "mod room;"), ("src/room/mod.rs", "mod a; mod b; mod c;")];

#[test]
fn two_files_that_use_each_other_are_a_circle_and_so_are_three_round_about() {
    let [lib, room] = ROOM;
    let two = ["src/room/a.rs", "src/room/b.rs"];
    let a = (two[0], "use super::b::B;\npub struct A(B);");
    let c = ("src/room/c.rs", "");
    assert_eq!(circles_of([lib, room, a, (two[1], "pub struct B(Option<Box<super::a::A>>);"), c]), [two]);
    assert_eq!(circles_of([lib, room, a, (two[1], "pub fn b() { crate::room::a::A::new(); }"), c]), [two]);
    for attribute in [
        "use super::a;\n#[serde(with = \"a\")] struct B;",
        "#[serde(with = \"super::a\")] struct B;",
        "#[serde(default = \"super::a::f\")] struct B;",
        "#[cfg_attr(test, arg(value_parser = super::a::f))] struct B;",
        "#[error(\"{}\", super::a::f(\"{}\"))] struct B;",
        "#![doc = super::a::F]",
    ] {
        assert_eq!(circles_of([lib, room, a, (two[1], attribute), c]), [two], "{attribute}");
    }
    let b = (two[1], "use super::c::{self, D as C};");
    for names in ["use crate::room::{a::{A}};", "use super::a::*;", "static C: [u8; super::a::N] = [0..super::a::N];"] {
        let round = circles_of([lib, room, a, b, ("src/room/c.rs", names)]);
        assert_eq!(round, [["src/room/a.rs", "src/room/b.rs", "src/room/c.rs"]], "{names}");
    }
}

#[test]
fn what_a_file_says_without_using_it_makes_no_circle() {
    let [lib, room] = ROOM;
    let a = ("src/room/a.rs", "use super::b::B;\npub struct A(B);");
    let says = "//! See [`super::a::A`].\n/* super::a::A /* twice */ super::a::A */\n\
        pub struct B<'a>(&'a str, char);\nfn b() { (\"super::a::A\", r#\"super::a::A\"#, '\"', '\\'').a::<B>(); }\n\
        #[cfg(test)]\nuse super::a::A;\n#[cfg(test)]\nfn f<T, U>(_: [A; 2]) -> A { super::a::A {} }\n\
        #[cfg(test)]\nmod tests {\n    use super::super::a::A;\n}\n";
    assert_eq!(circles_of([lib, room, a, ("src/room/b.rs", says), ("src/room/c.rs", "")]), Vec::<Vec<String>>::new());
    // What stands behind all that is seen again.
    let seen = ("src/room/b.rs", "fn f(c: char) { c == '\\''; } #[cfg(test)] fn t() {} static S: super::a::A = 0;");
    assert_eq!(circles_of([lib, room, a, seen, ("src/room/c.rs", "")]), [["src/room/a.rs", "src/room/b.rs"]]);
}

#[test]
fn a_room_s_own_file_that_hands_on_is_passed_through_and_one_that_defines_is_used() {
    let lib = ("src/lib.rs", "mod room;");
    let (a, b) = (("src/room/a.rs", "pub struct A;"), ("src/room/b.rs", "use super::A;\npub fn b(_: A) {}"));
    let hands_on = ("src/room/mod.rs", "mod a; mod b;\npub use a::A;\npub use self::b::b;");
    let uses = uses_of([lib, hands_on, a, b]);
    assert_eq!(uses["src/room/b.rs"].keys().collect::<Vec<_>>(), ["src/room/a.rs"]);
    assert!(circles(&uses).is_empty());
    let defines = ("src/room/mod.rs", "mod a; mod b;\npub struct A;\npub fn all() { b::b(A) }");
    assert_eq!(circles_of([lib, defines, a, b]), [["src/room/b.rs", "src/room/mod.rs"]]);
    let uses_what_it_hands_on =
        ("src/room/mod.rs", "mod a; mod b;\npub use b::b;\npub struct A;\npub fn all() { b(A) }");
    assert_eq!(circles_of([lib, uses_what_it_hands_on, a, b]), [["src/room/b.rs", "src/room/mod.rs"]]);
}

#[test]
fn a_function_that_is_named_as_its_module_is_used_through_what_hands_it_on() {
    let lib = ("src/lib.rs", "mod room;");
    let room = ("src/room/mod.rs", "mod a; mod b; mod c;\npub use self::a::a;\npub use b::{b, B};");
    let b = ("src/room/b.rs", "pub fn b() { crate::room::a(); }");
    for names in ["fn a() { super::b(); }", "use super::b;\nfn a() { b(1); }", "use super::{b as other};"] {
        let uses = uses_of([lib, room, ("src/room/a.rs", names), b, ("src/room/c.rs", "")]);
        assert_eq!(circles(&uses), [["src/room/a.rs", "src/room/b.rs"].map(String::from).into()], "{names}");
    }
}

#[test]
fn an_arrow_that_runs_up_is_found() {
    let order = Order::of("mesh < io, vessel < engine < app\nmesh < render < app\n");
    let lib = ("src/lib.rs", "mod mesh; mod io; mod vessel; mod render; mod app; mod language; mod task;");
    let found = |mesh, io, vessel, render, language| {
        let app = "pub struct App(crate::mesh::Mesh, crate::io::Read, crate::render::Picture);";
        let files = [
            lib,
            ("src/mesh.rs", mesh),
            ("src/io.rs", io),
            ("src/vessel/mod.rs", vessel),
            ("src/render.rs", render),
            ("src/app.rs", app),
            ("src/language.rs", language),
            ("src/task.rs", ""),
        ];
        upward(&order, &made_up(files))
    };
    let mesh = "pub struct Mesh(crate::language::Key);";
    assert_eq!(found(mesh, "use crate::mesh::Mesh;", "", "use crate::mesh::Mesh;", ""), Vec::<String>::new());
    assert_eq!(found("use crate::io::Read;", "", "", "", ""), ["src/mesh.rs uses src/io.rs: {\"crate::io::Read\"}"]);
    for handed_on in ["pub use crate::app::App;", "pub(crate) use crate::app;", "pub use crate::app::App as _;"] {
        assert_eq!(found(handed_on, "", "", "", "").len(), 1, "{handed_on}");
    }
    assert_eq!(found("", "use crate::vessel::Tree;", "", "", "").len(), 1, "rooms of one level do not know each other");
    assert_eq!(found("", "", "use crate::app::App;", "", "").len(), 1);
    assert_eq!(found("", "", "", "use crate::io::Read;", "").len(), 1, "render knows mesh alone");
    assert_eq!(found("", "", "", "", "use crate::mesh::Mesh;").len(), 1, "what is below all knows none");
    assert_eq!(found("", "use crate::task::Task;", "", "", "").len(), 1, "a room without a place is known by none");
}

#[test]
fn rooms_are_folders_and_files_of_src_and_what_stands_before_another() {
    let rooms = ["src/mesh/mending/fill.rs", "src/task.rs", "web/src/hid/page.rs", "web/worker/src/lib.rs"].map(room);
    assert_eq!(rooms, ["mesh", "task", "web", "web/worker"]);
}

#[test]
fn names_in_a_document_are_written_out() {
    let line = "`Action`, `src/{a,b/c}.rs`, `a < b/c`, [x](docs/x.md#y), [z](https://z) and `locales/*/lesson.ftl`";
    let names = documents::names(line);
    let (paths, others): (Vec<_>, Vec<_>) = names.into_iter().partition(|(_, is_path)| *is_path);
    assert_eq!(
        paths.iter().map(|(name, _)| name).collect::<Vec<_>>(),
        ["src/a.rs", "src/b/c.rs", "locales/*/lesson.ftl", "docs/x.md"]
    );
    assert_eq!(others, [("Action".to_string(), false)]);
}
