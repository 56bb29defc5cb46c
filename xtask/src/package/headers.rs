//! The headers that the browser app is served with, and the files that tell common hosts of them.
//!
//! The page has its policy in itself; as a header it holds for the Workers too, which take theirs from their own response.

use anyhow::{Result, ensure};

use super::packed::Packed;

/// Every header that goes with every file, whatever its type.
pub(crate) const HEADERS: [(&str, &str); 5] = [
    // A browser asks whether there is a newer build, and takes what it has where there is none.
    ("Cache-Control", "no-cache"),
    // What `www/index.html` says, and that no page may frame this one unless the host wants it to (`files`).
    (
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; style-src 'self'; \
         img-src 'self' data: blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
];

/// No page has Lumen as a part.
const NOWHERE: &str = "frame-ancestors 'none'";

/// `_headers` (Netlify, Cloudflare Pages), `.htaccess` (Apache) and lines for nginx. Pages of the origins in `embed_in`, such as
/// `https://lectures.example`, may have Lumen as a part.
///
/// # Errors
/// When one of them is no origin.
pub(super) fn files(embed_in: &[String]) -> Result<Vec<Packed>> {
    let is_name = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-.:".contains(c));
    let is_origin = |origin: &str| {
        origin == "'self'" || origin.strip_prefix("https://").is_some_and(|host| is_name(host.trim_start_matches("*.")))
    };
    for origin in embed_in {
        ensure!(is_origin(origin), "{origin} is no origin such as https://lectures.example");
    }
    let ancestors =
        if embed_in.is_empty() { NOWHERE.to_owned() } else { format!("frame-ancestors {}", embed_in.join(" ")) };
    let all = |line: fn(&str, &str) -> String| -> String {
        HEADERS.iter().map(|(name, value)| line(name, &value.replace(NOWHERE, &ancestors))).collect()
    };
    let netlify = format!("/*\n{}", all(|name, value| format!("  {name}: {value}\n")));
    let apache = format!(
        "AddType application/wasm .wasm\nAddType application/manifest+json .webmanifest\n<IfModule mod_headers.c>\n{}</IfModule>\n\
         <IfModule mod_deflate.c>\n  AddOutputFilterByType DEFLATE application/wasm text/css text/html text/javascript\n</IfModule>\n",
        all(|name, value| format!("  Header set {name} \"{value}\"\n"))
    );
    let nginx = format!(
        "# For the location that serves Lumen: include this file there.\ntypes {{\n  application/manifest+json webmanifest;\n  \
         application/wasm wasm;\n  image/png png;\n  image/svg+xml svg;\n  text/css css;\n  text/html html;\n  text/javascript js;\n\
         }}\ngzip on;\ngzip_types application/wasm text/css text/javascript;\n{}",
        all(|name, value| format!("add_header {name} \"{value}\" always;\n"))
    );
    Ok(vec![Packed::new("_headers", netlify), Packed::new(".htaccess", apache), Packed::new("nginx.conf", nginx)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::root;

    fn policy() -> String {
        let page = std::fs::read_to_string(root().join("www/index.html")).unwrap();
        let (_, rest) = page.split_once("http-equiv=\"Content-Security-Policy\" content=\"").unwrap();
        rest.split('"').next().unwrap().to_owned()
    }

    #[test]
    fn every_host_is_told_the_policy_of_the_page_and_no_other_origin_is_in_it() {
        let policy = policy();
        assert!(!policy.contains("http") && !policy.contains('*') && policy.starts_with("default-src 'none';"));
        let files = files(&[]).unwrap();
        assert_eq!(files.iter().map(|file| &*file.path).collect::<Vec<_>>(), ["_headers", ".htaccess", "nginx.conf"]);
        for file in files {
            let text = String::from_utf8(file.bytes).unwrap();
            assert!(text.contains(&format!("{policy}; frame-ancestors 'none'")), "{}: {text}", file.path);
            assert!(HEADERS.iter().all(|(name, _)| text.contains(name)), "{}", file.path);
        }
    }

    #[test]
    fn the_host_chooses_whose_pages_may_have_it_as_a_part() {
        let [ours, theirs] = ["'self'", "https://*.lectures.example:8443"].map(str::to_owned);
        for file in files(&[ours, theirs]).unwrap() {
            let text = String::from_utf8(file.bytes).unwrap();
            let expected = "form-action 'none'; frame-ancestors 'self' https://*.lectures.example:8443";
            assert!(text.contains(expected) && !text.contains(NOWHERE), "{}: {text}", file.path);
        }
        for wrong in
            ["*", "http://a.example", "https://a.example; script-src *", "https://a.example/path", "https://", "a"]
        {
            assert!(files(&[wrong.to_owned()]).is_err(), "{wrong}");
        }
    }
}
