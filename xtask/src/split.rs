//! The page's module in two: what its start calls, and what is fetched after the first picture, or when it is first called.
//!
//! Each late function that the early half calls, exports or has in its table leaves a stub there: it sees to it that the late
//! half is there (`www/late.js`), and calls the function by a place of its own in the table. The late half fills these places as
//! it is instantiated; memory, tables and globals are those of the early half.
//!
//! Binaryen's `wasm-split` does the same, but is no part of its npm package.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hasher as _};
use std::path::Path;

use anyhow::{Context as _, Result};
use walrus::ir::{UnaryOp, Value, Visitor, dfs_in_order};
use walrus::{
    ConstExpr, ElementItems, ElementKind, ExportItem, FunctionBuilder, FunctionId, FunctionKind, GlobalKind,
    ImportKind, ImportedFunction, Module, ModuleConfig, TableId, ValType, passes,
};

/// A function is late if its name has one of these in it; and so is what only late functions call.
const LATE: [&str; 44] = [
    // Files and what they are packed with, solvers, the trial and its devices.
    "lumen_feeder",
    "lumen_haptics",
    "lumen_io",
    "lumen_prepare",
    "lumen_trial",
    "lumen_web::hid::served",
    "fdeflate",
    "kurbo",
    "meshoptimizer",
    "miniz_oxide",
    "png::",
    "quick_xml",
    "robust::",
    "serde_json",
    "spade::",
    "xz4rust",
    "zip::",
    "lumen_volume::surface_nets",
    // Panels, and the engine's work for them.
    "egui_plot",
    "lumen::app::collapses",
    "lumen::app::compare",
    "lumen::app::equations",
    "lumen::app::lesson",
    "lumen::app::measure",
    "lumen::app::plot_file",
    "lumen::app::record",
    "lumen::app::reference",
    "lumen::app::scan",
    "lumen::app::solver",
    "lumen::app::trial",
    "lumen::app::vessels",
    "lumen::engine::averaging",
    "lumen::engine::beside",
    "lumen::engine::compare",
    "lumen::engine::preparing",
    "lumen::engine::record",
    "lumen::engine::trial",
    "lumen::report",
    "lumen::sharing",
    "lumen_mesh::capsule",
    "lumen_mesh::hausdorff",
    "lumen_mesh::mending",
    // What Lumen's letters and shaders never come to.
    "codespan_reporting",
    "read_fonts::ps",
];

/// What the first picture of the sample calls, although it has a name of [`LATE`] in it.
const EARLY: [&str; 30] = [
    // Panels that are closed, messages, and what is compared, made and let go.
    " shim",
    "app::filling::Filling",
    "app::measure::marks",
    "app::mode::Panel",
    "app::record::Record",
    "app::scan::state",
    "app::trial::mode",
    "app::trial::state",
    "core::cmp::",
    "core::default",
    "drop_in_place",
    "engine::link::Link",
    "follow_hand",
    "serde_core",
    "serde_json::ser",
    "view::TrialView",
    // The sample, made and measured, and saved where the page has stopped.
    "bezpath",
    "lumen_io::import",
    "lumen_io::output",
    "lumen_io::places",
    "lumen_io::report",
    "lumen_io::size",
    "lumen_io::stl",
    "lumen_io::warnings",
    "lumen_io::weld",
    "lumen_io::write_output",
    "lumen_mesh::mending::faults",
    "lumen_mesh::mending::holes",
    "lumen_mesh::mending::wall",
    "lumen_trial::wire",
];

/// The module that the late half imports from: the exports of the early one.
const FROM: &str = "early";

/// The early half's export that brings the late one (`web/src/late.rs`).
const BRING: &str = "bring_late";

/// The start of the name of the early half's export that says whether the late one is there: 0 or 1. What follows is a hash
/// of the whole, so that halves of two builds do not go together.
const IS_THERE: &str = "lateIsThere";

/// The late half has copies of early functions of at most so many instructions.
const COPIED: u64 = 200;

/// Splits a module of the page that wasm-bindgen has made, and writes the late half beside it.
pub(crate) fn split(module: &Path, late: &Path) -> Result<()> {
    let is_late =
        |name: &str| LATE.iter().any(|part| name.contains(part)) && !EARLY.iter().any(|part| name.contains(part));
    let whole = std::fs::read(module).with_context(|| format!("{} cannot be read", module.display()))?;
    let (early_half, late_half) = halves(&whole, is_late)?;
    std::fs::write(module, early_half).with_context(|| format!("{} cannot be written", module.display()))?;
    std::fs::write(late, late_half).with_context(|| format!("{} cannot be written", late.display()))
}

/// The early and the late half of a module.
fn halves(whole: &[u8], is_late: impl Fn(&str) -> bool) -> Result<(Vec<u8>, Vec<u8>)> {
    let (mut early, mut late) = (parse(whole)?, parse(whole)?);
    let kept = early_functions(&early, is_late);
    // Both are read from the same bytes: what one has at a place, the other has there too.
    let pairs: Vec<(FunctionId, FunctionId)> =
        early.funcs.iter().zip(late.funcs.iter()).map(|(early, late)| (early.id(), late.id())).collect();
    let called: HashSet<FunctionId> =
        roots(&early).into_iter().chain(kept.iter().flat_map(|&id| callees(&early, id))).collect();
    let stubs: Vec<_> = pairs.iter().filter(|(id, _)| called.contains(id) && !kept.contains(id)).copied().collect();

    let table = main_table(&early)?;
    let base = early.tables.get(table).initial;
    let mut hasher = DefaultHasher::new();
    hasher.write(whole);
    let is_there = format!("{IS_THERE}{:016x}", hasher.finish());
    leave_stubs(&mut early, &is_there, table, stubs.iter().map(|&(id, _)| id))?;

    strip(&mut late);
    // A call from one half to the other takes longer than one within a half.
    let is_copied =
        |id| matches!(&early.funcs.get(id).kind, FunctionKind::Local(function) if function.size() <= COPIED);
    let imported = pairs.into_iter().filter(|&(id, _)| kept.contains(&id) && !is_copied(id));
    let items = import_all(&mut late, &early, imported);
    let flag = late.add_import_global(FROM, &is_there, ValType::I32, true, false).0;
    let mut start = FunctionBuilder::new(&mut late.types, &[], &[]);
    start.func_body().i32_const(1).global_set(flag);
    late.start = Some(start.finish(Vec::new(), &mut late.funcs));
    let places = ElementItems::Functions(stubs.into_iter().map(|(_, id)| id).collect());
    let table = main_table(&late)?;
    let active = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(i32::try_from(base)?)) };
    let element = late.elements.add(active, places);
    late.tables.get_mut(table).elem_segments.insert(element);
    passes::gc::run(&mut late);

    for import in late.imports.iter() {
        if let Some(&item) = import.name.parse().ok().and_then(|place: usize| items.get(place)) {
            early.exports.add(&import.name, item);
        }
    }
    passes::gc::run(&mut early);
    Ok((early.emit_wasm(), late.emit_wasm()))
}

fn parse(module: &[u8]) -> Result<Module> {
    ModuleConfig::new().generate_producers_section(false).parse(module)
}

fn main_table(module: &Module) -> Result<TableId> {
    module.tables.main_function_table()?.context("the module has no table of functions")
}

/// What the start, the exports and the table lead to without a late function on the way; imports are never late.
fn early_functions(module: &Module, is_late: impl Fn(&str) -> bool) -> HashSet<FunctionId> {
    let is_late = |id: FunctionId| {
        let function = module.funcs.get(id);
        matches!(function.kind, FunctionKind::Local(_)) && function.name.as_deref().is_some_and(&is_late)
    };
    let imported = module.funcs.iter().filter(|function| matches!(function.kind, FunctionKind::Import(_)));
    let mut early: HashSet<FunctionId> = imported.map(walrus::Function::id).collect();
    let mut open = roots(module);
    while let Some(id) = open.pop() {
        if !is_late(id) && early.insert(id) {
            open.extend(callees(module, id));
        }
    }
    early
}

/// What is called from outside or by the table.
fn roots(module: &Module) -> Vec<FunctionId> {
    let exported = module.exports.iter().filter_map(|export| match export.item {
        ExportItem::Function(id) => Some(id),
        _ => None,
    });
    let mut roots: Vec<FunctionId> = exported.chain(module.start).collect();
    for element in module.elements.iter() {
        match &element.items {
            ElementItems::Functions(ids) => roots.extend(ids),
            ElementItems::Expressions(_, items) => roots.extend(items.iter().filter_map(|item| match item {
                ConstExpr::RefFunc(id) => Some(*id),
                _ => None,
            })),
        }
    }
    roots
}

/// What a function calls or takes the address of.
fn callees(module: &Module, id: FunctionId) -> Vec<FunctionId> {
    struct Callees(Vec<FunctionId>);
    impl<'instr> Visitor<'instr> for Callees {
        fn visit_function_id(&mut self, id: &FunctionId) {
            self.0.push(*id);
        }
    }
    let mut callees = Callees(Vec::new());
    if let FunctionKind::Local(function) = &module.funcs.get(id).kind {
        dfs_in_order(&mut callees, function, function.entry_block());
    }
    callees.0
}

/// Puts stubs in the place of late functions, and makes room for the functions at the end of the table.
fn leave_stubs(early: &mut Module, name: &str, table: TableId, late: impl Iterator<Item = FunctionId>) -> Result<()> {
    let bring = early.exports.get_func(BRING)?;
    let is_there = early.globals.add_local(ValType::I32, true, false, ConstExpr::Value(Value::I32(0)));
    early.exports.add(name, is_there);
    let mut place = early.tables.get(table).initial;
    for id in late {
        let ty = early.funcs.get(id).ty();
        let (params, results) = (early.types.params(ty).to_vec(), early.types.results(ty).to_vec());
        let arguments: Vec<_> = params.iter().map(|&param| early.locals.add(param)).collect();
        let mut stub = FunctionBuilder::new(&mut early.types, &params, &results);
        let mut body = stub.func_body();
        let is_missing = body.global_get(is_there).unop(UnaryOp::I32Eqz);
        is_missing.if_else(
            None,
            |missing| {
                missing.call(bring);
            },
            |_| {},
        );
        for &argument in &arguments {
            body.local_get(argument);
        }
        body.i32_const(i32::try_from(place)?).call_indirect(ty, table);
        early.funcs.get_mut(id).kind = FunctionKind::Local(stub.local_func(arguments));
        place += 1;
    }
    let table = early.tables.get_mut(table);
    table.initial = place;
    table.maximum = table.maximum.map(|maximum| maximum.max(place));
    Ok(())
}

/// Leaves a module nothing but its functions.
fn strip(module: &mut Module) {
    module.start = None;
    let ids: Vec<_> = module.exports.iter().map(walrus::Export::id).collect();
    ids.into_iter().for_each(|id| module.exports.delete(id));
    let ids: Vec<_> = module.imports.iter().map(walrus::Import::id).collect();
    ids.into_iter().for_each(|id| module.imports.delete(id));
    let ids: Vec<_> = module.elements.iter().map(walrus::Element::id).collect();
    ids.into_iter().for_each(|id| module.elements.delete(id));
    let ids: Vec<_> = module.data.iter().map(walrus::Data::id).collect();
    ids.into_iter().for_each(|id| module.data.delete(id));
    module.tables.iter_mut().for_each(|table| table.elem_segments.clear());
    module.memories.iter_mut().for_each(|memory| memory.data_segments.clear());
}

/// Lets the late half import the early functions, and the early half's tables, memories and globals, each by its number in
/// what is returned.
fn import_all(
    late: &mut Module,
    early: &Module,
    functions: impl Iterator<Item = (FunctionId, FunctionId)>,
) -> Vec<ExportItem> {
    let mut items: Vec<ExportItem> = Vec::new();
    let Module { imports, funcs, tables, memories, globals, .. } = late;
    let mut import = |item: ExportItem, kind: ImportKind| {
        items.push(item);
        imports.add(FROM, &(items.len() - 1).to_string(), kind)
    };
    for (theirs, id) in functions {
        let function = funcs.get_mut(id);
        let ty = function.ty();
        let import = import(theirs.into(), id.into());
        function.kind = FunctionKind::Import(ImportedFunction { import, ty });
    }
    for (ours, theirs) in tables.iter_mut().zip(early.tables.iter()) {
        (ours.initial, ours.maximum) = (theirs.initial, theirs.maximum);
        ours.import = Some(import(theirs.id().into(), ours.id().into()));
    }
    for (ours, theirs) in memories.iter_mut().zip(early.memories.iter()) {
        ours.import = Some(import(theirs.id().into(), ours.id().into()));
    }
    let ids: Vec<_> = globals.iter().map(walrus::Global::id).collect();
    for (id, theirs) in ids.into_iter().zip(early.globals.iter()) {
        globals.get_mut(id).kind = GlobalKind::Import(import(theirs.id().into(), id.into()));
    }
    items
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::*;

    /// A module of an early `go` and a late one that calls back, by the table and directly, each of which counts in memory.
    fn whole() -> Vec<u8> {
        let mut module = Module::with_config(ModuleConfig::new());
        let memory = module.memories.add_local(false, false, 1, None, None);
        module
            .data
            .add(walrus::DataKind::Active { memory, offset: ConstExpr::Value(Value::I32(8)) }, vec![40, 0, 0, 0]);
        let table = module.tables.add_local(false, 2, Some(2), walrus::RefType::FUNCREF);
        let log = module.types.add(&[ValType::I32], &[]);
        let (log, _) = module.add_import_func("env", "log", log);
        let bring = module.types.add(&[], &[]);
        let (bring_it, _) = module.add_import_func("env", "bring", bring);

        let function =
            |module: &mut Module, name: &str, body: &dyn Fn(&mut walrus::InstrSeqBuilder<'_>, walrus::LocalId)| {
                let argument = module.locals.add(ValType::I32);
                let mut builder = FunctionBuilder::new(&mut module.types, &[ValType::I32], &[ValType::I32]);
                builder.name(name.to_owned());
                body(&mut builder.func_body(), argument);
                builder.finish(vec![argument], &mut module.funcs)
            };
        let load = walrus::ir::LoadKind::I32 { atomic: false };
        let at = |offset| walrus::ir::MemArg { align: 4, offset };
        // What is in memory, and what it was asked for, more.
        let count = function(&mut module, "early::count", &|body, argument| {
            body.i32_const(0).load(memory, load, at(8)).local_get(argument).binop(walrus::ir::BinaryOp::I32Add);
        });
        let only = function(&mut module, "only::late::ones::call", &|body, argument| {
            body.local_get(argument).call(log).local_get(argument).call(count);
        });
        let late = function(&mut module, "late::work", &|body, argument| {
            body.local_get(argument).call(only);
        });
        let by_table = function(&mut module, "late::by_table", &|body, argument| {
            body.local_get(argument).i32_const(1).binop(walrus::ir::BinaryOp::I32Add).call(late);
        });
        let ty = module.funcs.get(count).ty();
        let go = function(&mut module, "go", &|body, argument| {
            body.local_get(argument).call(late).i32_const(1).call_indirect(ty, table);
        });
        let active = ElementKind::Active { table, offset: ConstExpr::Value(Value::I32(0)) };
        let element = module.elements.add(active, ElementItems::Functions(vec![count, by_table]));
        module.tables.get_mut(table).elem_segments.insert(element);
        let mut brings = FunctionBuilder::new(&mut module.types, &[], &[]);
        brings.func_body().call(bring_it);
        let brings = brings.finish(Vec::new(), &mut module.funcs);
        module.exports.add(BRING, brings);
        module.exports.add("go", go);
        module.exports.add("count", count);
        module.emit_wasm()
    }

    #[test]
    fn the_halves_do_what_the_whole_does_and_the_late_one_is_asked_for_once() {
        let folder = std::env::temp_dir().join(format!("lumen-split-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let whole = whole();
        let (early, late) = halves(&whole, |name| name.starts_with("late::")).unwrap();
        // The same but for what is in memory: all calls fit.
        let mut other = whole.clone();
        let forty = other.windows(4).position(|bytes| bytes == [40, 0, 0, 0]).unwrap();
        other[forty] = 41;
        let (_, other) = halves(&other, |name| name.starts_with("late::")).unwrap();
        for (name, bytes) in [("whole", &whole), ("early", &early), ("late", &late), ("other", &other)] {
            std::fs::write(folder.join(name), bytes).unwrap();
        }
        let script = r#"
            const compiled = (name) => new WebAssembly.Module(require("fs").readFileSync(name));
            const said = [];
            let early = null;
            const env = {
              log: (number) => said.push(`log ${number}`),
              bring: () => { said.push("bring"); new WebAssembly.Instance(compiled("late"), { early }); },
            };
            const whole = new WebAssembly.Instance(compiled("whole"), { env }).exports;
            said.push(whole.count(2), whole.go(1), whole.go(5));
            early = new WebAssembly.Instance(compiled("early"), { env }).exports;
            const isThere = early[Object.keys(early).find((name) => name.startsWith("lateIsThere"))];
            said.push(early.count(2), isThere.value, early.go(1), isThere.value, early.go(5));
            console.log(said.join(", "));
            try { new WebAssembly.Instance(compiled("other"), { early }); } catch (error) { console.log(error.name); }
        "#;
        let node = Command::new("node").args(["-e", script]).current_dir(&folder).output().unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(node.status.success(), "{}", String::from_utf8_lossy(&node.stderr));
        // 40 and what was asked for; the second call adds one to the first one's result.
        let expected =
            "log 1, log 42, log 5, log 46, 42, 82, 86, bring, log 1, log 42, log 5, log 46, 42, 0, 82, 1, 86";
        let said = String::from_utf8_lossy(&node.stdout);
        assert_eq!(said.lines().collect::<Vec<_>>(), [expected, "LinkError"]);
        // What only late functions call has gone with them; what all call stands in both where it is short.
        assert!(
            early.len() < whole.len() + 400
                && !Module::from_buffer(&early)
                    .unwrap()
                    .funcs
                    .iter()
                    .any(|function| { function.name.as_deref().is_some_and(|name| name.starts_with("only")) })
        );
    }
}
