//! What a dependency may be: names and licences by `deny.toml`, from crates.io, and of ours none in any version.
//!
//! cargo-deny reads the same file, and took 158 s to compile on every fresh machine. Its crate `spdx` is what is needed of it:
//! this looks at the dependencies for all systems in 2 s.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, anyhow, bail};
use serde::Deserialize;
use spdx::{AdditionItem, Expression, LicenseItem, LicenseReq};

use crate::step::{cargo, root};

/// What is read of `deny.toml`.
#[derive(Deserialize)]
struct Policy {
    bans: Bans,
    licenses: Licences,
}

#[derive(Deserialize)]
struct Bans {
    deny: Vec<Crate>,
}

#[derive(Deserialize)]
struct Licences {
    allow: Vec<String>,
    exceptions: Vec<Crate>,
}

#[derive(Deserialize)]
struct Crate {
    #[serde(rename = "crate")]
    name: String,
    /// Licences that it alone may have.
    #[serde(default)]
    allow: Vec<String>,
}

/// What `cargo metadata --no-deps` says: our own packages.
#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    dependencies: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    name: String,
    req: String,
    path: Option<PathBuf>,
}

/// Fails at a dependency of a licence, source or name that is not allowed, and names all of them.
pub(crate) fn check() -> Result<()> {
    // `cargo metadata` names crates as well that no feature asks for.
    let asked =
        ["tree", "--locked", "--workspace", "--all-features", "--target=all", "--prefix=none", "--format={p}\t{l}"];
    let policy: Policy = toml::from_str(&std::fs::read_to_string(root().join("deny.toml"))?).context("deny.toml")?;
    let mut found: BTreeSet<String> = said(&asked)?.lines().filter_map(|line| policy.complaint(line)).collect();
    let own: Metadata = serde_json::from_str(&said(&["metadata", "--locked", "--no-deps", "--format-version=1"])?)?;
    found.extend(own.packages.iter().flat_map(wildcards));
    if !found.is_empty() {
        bail!("{}", found.into_iter().collect::<Vec<_>>().join("\n"));
    }
    Ok(())
}

/// What cargo answers.
fn said(asked: &[&str]) -> Result<String> {
    let output = cargo().args(asked).output().context("cargo did not start")?;
    if !output.status.success() {
        bail!("cargo {}: {}", asked[0], String::from_utf8_lossy(&output.stderr));
    }
    Ok(String::from_utf8(output.stdout)?)
}

impl Policy {
    /// What is not allowed of a package: "name v1.0.0 (proc-macro) (where it is from)", and behind a tab its licence.
    fn complaint(&self, line: &str) -> Option<String> {
        let (package, licence) = line.split_once('\t').unwrap_or((line, ""));
        let (called, licence) = (package.split(" (").next()?, licence.trim_end_matches(" (*)"));
        let name = called.split(' ').next().filter(|name| !name.is_empty())?;
        if self.bans.deny.iter().any(|refused| refused.name == name) {
            return Some(format!("{called} is refused by name"));
        }
        // From crates.io it says nothing.
        let mut from = package.split(" (").skip(1).map(|of| of.trim_end_matches(')'));
        if let Some(other) = from.find(|of| !["proc-macro", "*"].contains(of) && !Path::new(of).is_absolute()) {
            return Some(format!("{called} comes from {other}"));
        }
        match self.allows(name, licence) {
            Ok(true) => None,
            Ok(false) => Some(format!("{called} has the licence {licence:?}")),
            Err(error) => Some(format!("{called}: {error:#}")),
        }
    }

    /// Whether what is allowed suffices for the licence of a crate.
    fn allows(&self, name: &str, licence: &str) -> Result<bool> {
        // As crates wrote it before there was a grammar: "MIT/Apache-2.0".
        let licence = licence.replace('/', " OR ");
        let expression = Expression::parse(&licence).map_err(|error| anyhow!("{licence:?}: {error}"))?;
        let own = self.licenses.exceptions.iter().filter(|of| of.name == name).flat_map(|of| &of.allow);
        let allowed: Vec<&str> = self.licenses.allow.iter().chain(own).map(String::as_str).collect();
        Ok(expression.evaluate(|LicenseReq { license, addition }| {
            // An exception that SPDX lists only ever allows more.
            matches!(license, LicenseItem::Spdx { id, .. } if allowed.contains(&id.name))
                && matches!(addition, None | Some(AdditionItem::Spdx(_)))
        }))
    }
}

/// Dependencies of which a package of ours takes any version.
fn wildcards(package: &Package) -> impl Iterator<Item = String> {
    let any = package.dependencies.iter().filter(|wanted| wanted.path.is_none() && wanted.req == "*");
    any.map(|wanted| format!("{} takes any version of {}", package.name, wanted.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn policy() -> Policy {
        let named = |name: &str, allow: &[&str]| Crate {
            name: name.to_owned(),
            allow: allow.iter().map(|&licence| licence.to_owned()).collect(),
        };
        let allow = ["MIT", "Apache-2.0", "Unicode-3.0"].map(str::to_owned).to_vec();
        Policy {
            bans: Bans { deny: vec![named("ureq", &[])] },
            licenses: Licences { allow, exceptions: vec![named("letters", &["OFL-1.1"])] },
        }
    }

    #[test]
    fn licences_are_read_as_spdx_has_them() {
        for (licence, is_fine) in [
            ("MIT OR GPL-3.0-only", true),
            ("MIT AND GPL-3.0-only", false),
            ("(MIT OR Apache-2.0) AND Unicode-3.0", true),
            ("MIT/Apache-2.0", true),
            ("Apache-2.0 WITH LLVM-exception", true),
            ("MIT WITH AdditionRef-not-for-money", false),
            ("OFL-1.1", false),
        ] {
            assert_eq!(policy().allows("a", licence).unwrap(), is_fine, "{licence}");
        }
        assert!(policy().allows("letters", "(MIT OR Apache-2.0) AND OFL-1.1").unwrap());
        assert!(policy().allows("a", "as you like it").is_err());
    }

    #[test]
    fn names_sources_and_licences_are_complained_of() {
        let here = std::env::current_dir().unwrap();
        for line in ["serde v1.0.0\tMIT OR Apache-2.0", "serde_derive v1.0.0 (proc-macro)\tMIT (*)", ""] {
            assert_eq!(policy().complaint(line), None, "{line}");
        }
        assert_eq!(policy().complaint(&format!("ours v0.1.0 ({})\tMIT", here.display())), None);
        for (line, said) in [
            ("ureq v3.0.0\tMIT", "ureq v3.0.0 is refused by name"),
            ("b v1.0.0 (https://git.test/b#0123)\tMIT", "b v1.0.0 comes from https://git.test/b#0123"),
            ("b v1.0.0 (registry `other`)\tMIT", "b v1.0.0 comes from registry `other`"),
            ("b v1.0.0\tGPL-3.0-only", "b v1.0.0 has the licence \"GPL-3.0-only\""),
        ] {
            assert_eq!(policy().complaint(line).as_deref(), Some(said));
        }
        assert!(policy().complaint("b v1.0.0\t").is_some(), "no licence");
    }

    #[test]
    fn any_version_is_too_many() {
        let wanted = |req: &str, path: Option<&str>| Dependency {
            name: "b".to_owned(),
            req: req.to_owned(),
            path: path.map(PathBuf::from),
        };
        let dependencies = vec![wanted("^1", None), wanted("*", Some("b")), wanted("*", None)];
        let package = Package { name: "a".to_owned(), dependencies };
        assert_eq!(wildcards(&package).collect::<Vec<_>>(), ["a takes any version of b"]);
    }
}
