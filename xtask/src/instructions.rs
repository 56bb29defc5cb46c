//! `cargo xtask instructions`: counts the WebAssembly instructions of each stage on the samples and holds them against
//! `benches/instructions/kept.csv` (`benches/instructions/src/main.rs`).

use anyhow::Result;

use crate::step::{cargo, root, run, step, target};
use crate::tools;

const PACKAGE: &str = "--package=lumen-instructions";

/// Counts, and fails where a stage takes more than 5 % more than is kept; with `keep` what is counted is kept.
pub(crate) fn count(keep: bool) -> Result<()> {
    tools::wasm_target()?;
    step("Compile what is counted", || {
        let lib = ["--lib", "--target=wasm32-unknown-unknown"];
        run(cargo().args(["build", "--quiet", "--release", PACKAGE]).args(lib))?;
        run(cargo().args(["build", "--quiet", "--release", PACKAGE, "--bins"]))
    })?;
    let module = target().join("wasm32-unknown-unknown/release/lumen_instructions.wasm");
    let mut counting = cargo();
    counting.args(["run", "--quiet", "--release", PACKAGE, "--"]).arg(module);
    counting.arg(root().join("benches/instructions/kept.csv")).args(keep.then_some("--keep"));
    step("Count the instructions of each stage", || run(&mut counting))
}
