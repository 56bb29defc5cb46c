//! What only the finished build knows about the page: the module's size and the build's version.

use std::hash::{DefaultHasher, Hasher as _};
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

/// Writes into `dist/index.html` the size of the module, which the loading screen needs for its percentage, and a
/// version, which keeps a browser from mixing the files of two builds; and sees to it that the page keeps its policy.
pub(crate) fn stamp(dist: &Path, module: &Path) -> Result<()> {
    let file = dist.join("index.html");
    let page = std::fs::read_to_string(&file).context("dist/index.html cannot be read")?;
    ensure!(page.contains("http-equiv=\"Content-Security-Policy\""), "the page has no Content-Security-Policy");
    // The policy names no hash and no nonce: it holds only as long as every script is a file.
    let inline = page.split("<script").skip(1).any(|script| !script.split('>').next().unwrap_or("").contains("src="));
    ensure!(!inline, "the page has an inline script, which its Content-Security-Policy forbids");

    let bytes = std::fs::read(module)?;
    let mut hasher = DefaultHasher::new();
    hasher.write(&bytes);
    for name in ["lumen-web.js", "boot.js", "worker.js", "style.css"] {
        hasher.write(&std::fs::read(dist.join(name)).with_context(|| format!("dist/{name} cannot be read"))?);
    }
    let version = format!("{:016x}", hasher.finish());
    let facts = format!(
        "    <meta name=\"lumen-module-bytes\" content=\"{}\">\n    <meta name=\"lumen-version\" content=\"{version}\">\n  </head>",
        bytes.len()
    );
    // The links that tell Trunk what to do tell a browser nothing.
    let lines = page.lines().filter(|line| !line.trim().is_empty() && !line.contains("data-trunk"));
    let page = lines
        .collect::<Vec<_>>()
        .join("\n")
        .replacen("  </head>", &facts, 1)
        .replace("\"boot.js\"", &format!("\"boot.js?v={version}\""))
        .replace("\"style.css\"", &format!("\"style.css?v={version}\""));
    std::fs::write(&file, page + "\n").context("dist/index.html cannot be written")
}
