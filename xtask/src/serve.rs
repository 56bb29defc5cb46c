//! `cargo xtask serve`: a small static server for `dist/`, heard on this machine alone.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, anyhow};
use tiny_http::{Header, Method, Request, Response, Server};

use crate::build::gzip;
use crate::package::HEADERS;

/// Takes a port of this machine, 0 a free one: before the build, so that one that is taken is told at once.
pub(crate) fn take_port(port: u16) -> Result<Server> {
    Server::http(("127.0.0.1", port)).map_err(|error| anyhow!("port {port}: {error}; --port 0 takes a free one"))
}

/// Serves `dist` until the program is stopped.
pub(crate) fn serve(server: &Server, dist: &Path, open: bool) -> Result<()> {
    let port = server.server_addr().to_ip().context("the server has no address")?.port();
    let address = format!("http://127.0.0.1:{port}/");
    eprintln!("==> Lumen is at {address} (Ctrl+C ends it)");
    if open {
        open_browser(&address);
    }
    let mut compressed = BTreeMap::new();
    for request in server.incoming_requests() {
        // A visitor who goes away in the middle of an answer is no reason to stop.
        if let Err(error) = answer(request, dist, &mut compressed) {
            eprintln!("    {error:#}");
        }
    }
    Ok(())
}

fn answer(request: Request, dist: &Path, compressed: &mut BTreeMap<PathBuf, Vec<u8>>) -> Result<()> {
    if !matches!(request.method(), Method::Get | Method::Head) {
        return Ok(request.respond(Response::empty(405))?);
    }
    let Some(file) = file_for(request.url(), dist) else {
        return Ok(request.respond(Response::from_string("not found").with_status_code(404))?);
    };
    let takes_gzip = request.headers().iter().any(|header| {
        header.field.equiv("Accept-Encoding")
            && header.value.as_str().split(',').any(|it| it.trim().starts_with("gzip"))
    });
    let mut headers = vec![("Content-Type", media_type(&file)), ("Vary", "Accept-Encoding")];
    headers.extend(HEADERS);
    let body = if takes_gzip {
        headers.push(("Content-Encoding", "gzip"));
        match compressed.get(&file) {
            Some(body) => body.clone(),
            None => {
                let body = gzip(&std::fs::read(&file)?)?;
                compressed.insert(file, body.clone());
                body
            }
        }
    } else {
        std::fs::read(&file)?
    };
    let mut response = Response::from_data(body);
    // What has a media type of its own replaces the one tiny_http gives to bytes.
    for (name, value) in headers {
        response.add_header(Header::from_bytes(name, value).map_err(|()| anyhow!("no header: {name}"))?);
    }
    Ok(request.respond(response)?)
}

/// The file of an address, if there is one inside `dist`.
fn file_for(address: &str, dist: &Path) -> Option<PathBuf> {
    let path = address.split(['?', '#']).next()?.trim_start_matches('/');
    let path = Path::new(if path.is_empty() { "index.html" } else { path });
    // Plain names alone: no "..", no root, no drive. Nothing in dist/ needs an escape.
    let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    let file = dist.join(path);
    (plain && file.is_file()).then_some(file)
}

fn media_type(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("css") => "text/css; charset=utf-8",
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("json") => "application/json",
        Some("png") => "image/png",
        Some("svg") => "image/svg+xml",
        Some("wasm") => "application/wasm",
        Some("webmanifest") => "application/manifest+json",
        _ => "application/octet-stream",
    }
}

fn open_browser(address: &str) {
    let program = match std::env::consts::OS {
        "macos" => "open",
        "windows" => "explorer",
        _ => "xdg-open",
    };
    if Command::new(program).arg(address).spawn().is_err() {
        eprintln!("    {program} did not start: open the address by hand");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_outside_the_folder_is_served() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        assert_eq!(file_for("/main.rs?v=1", &folder), Some(folder.join("main.rs")));
        for address in ["/../Cargo.toml", "/./../Cargo.toml", "//etc/passwd", "/%2e%2e/Cargo.toml", "/none", "/"] {
            assert_eq!(file_for(address, &folder), None, "{address}");
        }
    }
}
