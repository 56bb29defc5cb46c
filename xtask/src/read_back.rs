//! `cargo xtask read-back`: what Lumen writes, read by VTK, trimesh and meshio with equal counts, places and normals.

use std::process::Command;

use anyhow::Result;

use crate::step::{cargo, root, run, step, target};
use crate::tools;

/// The formats that Lumen writes, by extension.
const FORMATS: [&str; 6] = ["stl", "ply", "obj", "vtp", "vtk", "glb"];

/// Writes a surface in every format and lets the other programs read it.
pub(crate) fn read_back() -> Result<()> {
    let folder = target().join("read-back");
    std::fs::create_dir_all(&folder)?;
    let python = tools::read_back_python(&folder)?;
    step("Write a surface in every format", || {
        for format in FORMATS {
            run(cargo()
                .args(["run", "--quiet", "--no-default-features", "--bin=lumen", "--", "optimise", "sample:coronary"])
                .args(["--reduction", "50", "--iterations", "0", "--output"])
                .arg(folder.join(format!("surface.{format}")))
                .arg("--report")
                .arg(folder.join("report.json")))?;
        }
        Ok(())
    })?;
    step("Read it with VTK, trimesh and meshio", || {
        run(Command::new(python).arg(root().join("tests/formats/read_back.py")).arg(&folder))
    })
}
