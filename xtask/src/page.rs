//! What only the finished build knows about itself: the module's size, the build's version, and the hash of each file.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use sha2::{Digest as _, Sha256};

use crate::step::files_below;

/// The line of `www/service-worker.js` that the build replaces.
const BUILD: &str = "const BUILD = { version: \"\", files: {} };";

/// Writes into `dist/index.html` the size of the module, which the loading screen needs for its percentage, and a
/// version, which keeps a browser from mixing the files of two builds; and sees to it that the page keeps its policy.
/// Writes into `dist/service-worker.js` the version and all files that the page needs without a network.
pub(crate) fn stamp(dist: &Path, module: &Path) -> Result<()> {
    let file = dist.join("index.html");
    let page = std::fs::read_to_string(&file).context("dist/index.html cannot be read")?;
    ensure!(page.contains("http-equiv=\"Content-Security-Policy\""), "the page has no Content-Security-Policy");
    // The policy names no hash and no nonce: it holds only as long as every script is a file.
    let inline = page.split("<script").skip(1).any(|script| !script.split('>').next().unwrap_or("").contains("src="));
    ensure!(!inline, "the page has an inline script, which its Content-Security-Policy forbids");

    let bytes = std::fs::metadata(module)?.len();
    let version = sha256(format!("{:?}", hashes(dist)?).as_bytes())[..16].to_owned();
    let facts = format!(
        "    <meta name=\"lumen-module-bytes\" content=\"{bytes}\">\n    <meta name=\"lumen-version\" content=\"{version}\">\n  </head>"
    );
    // The links that tell Trunk what to do tell a browser nothing.
    let lines = page.lines().filter(|line| !line.trim().is_empty() && !line.contains("data-trunk"));
    let page = lines
        .collect::<Vec<_>>()
        .join("\n")
        .replacen("  </head>", &facts, 1)
        .replace("\"boot.js\"", &format!("\"boot.js?v={version}\""))
        .replace("\"style.css\"", &format!("\"style.css?v={version}\""));
    std::fs::write(&file, page + "\n").context("dist/index.html cannot be written")?;

    let file = dist.join("service-worker.js");
    let worker = std::fs::read_to_string(&file).context("dist/service-worker.js cannot be read")?;
    ensure!(worker.matches(BUILD).count() == 1, "the service worker has no place for the build's files");
    let mut files = hashes(dist)?;
    // What installs the page asks for its icons, and the worker itself is the browser's to keep.
    files.retain(|name, _| name != "service-worker.js" && !name.ends_with(".png"));
    let build = serde_json::json!({ "version": version, "files": files });
    std::fs::write(&file, worker.replacen(BUILD, &format!("const BUILD = {build};"), 1))
        .context("dist/service-worker.js cannot be written")
}

/// SHA-256 of each file, by its name.
fn hashes(dist: &Path) -> Result<BTreeMap<String, String>> {
    files_below(dist)?
        .into_iter()
        .map(|path| {
            let bytes = std::fs::read(&path).with_context(|| format!("{} cannot be read", path.display()))?;
            let name = path.strip_prefix(dist)?.to_string_lossy().replace('\\', "/");
            Ok((name, sha256(&bytes)))
        })
        .collect()
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::root;

    #[test]
    fn page_and_service_worker_bear_one_version_and_the_hashes_of_what_is_there() {
        let dist = std::env::temp_dir().join(format!("lumen-page-{}", std::process::id()));
        std::fs::create_dir_all(&dist).unwrap();
        for file in files_below(&root().join("www")).unwrap() {
            std::fs::copy(&file, dist.join(file.file_name().unwrap())).unwrap();
        }
        let module = dist.join("lumen-web_bg.wasm");
        std::fs::write(&module, "12345").unwrap();
        std::fs::write(dist.join("lumen-web.js"), "glue").unwrap();
        std::fs::write(dist.join("lumen-scan.js"), "glue").unwrap();
        stamp(&dist, &module).unwrap();

        let text = |name: &str| std::fs::read_to_string(dist.join(name)).unwrap();
        let (page, worker) = (text("index.html"), text("service-worker.js"));
        assert!(page.contains("<meta name=\"lumen-module-bytes\" content=\"5\">"));
        let (_, version) = page.split_once("name=\"lumen-version\" content=\"").unwrap();
        let version = &version[..16];
        assert!(
            page.contains(&format!("\"boot.js?v={version}\"")) && page.contains(&format!("\"style.css?v={version}\""))
        );
        assert!(!page.contains("data-trunk"));
        let line = worker.lines().find_map(|line| line.strip_prefix("const BUILD = ")).unwrap();
        let build: serde_json::Value = serde_json::from_str(line.strip_suffix(';').unwrap()).unwrap();
        assert_eq!(build["version"], version);
        let files = build["files"].as_object().unwrap();
        for (name, hash) in files {
            assert_eq!(*hash, sha256(&std::fs::read(dist.join(name)).unwrap()), "{name}");
        }
        let page = ["index.html", "boot.js", "drop.js", "store.js", "video.js", "worker.js", "style.css"];
        for name in page.into_iter().chain(["lumen-web.js", "lumen-web_bg.wasm", "lumen-scan.js"]) {
            assert!(files.contains_key(name), "{name}");
        }
        assert!(!files.contains_key("service-worker.js"));
        std::fs::remove_dir_all(&dist).unwrap();
    }

    #[test]
    fn trunk_lays_out_every_file_of_www_and_every_language() {
        let www = root().join("www");
        let page = std::fs::read_to_string(www.join("index.html")).unwrap();
        for file in files_below(&www).unwrap() {
            let name = file.file_name().unwrap().to_str().unwrap();
            let link = format!("<link data-trunk rel=\"copy-file\" href=\"{name}\">");
            assert!(name == "index.html" || page.contains(&link), "{name}");
        }
        let trunk = std::fs::read_to_string(root().join("Trunk.toml")).unwrap();
        assert_eq!(trunk.matches(&format!("in {}", crate::build::LANGUAGES.join(" "))).count(), 1);
        assert_eq!(trunk.matches(&format!("({})", crate::build::LANGUAGES.join(" "))).count(), 1);
    }
}
