//! meshoptimizer's simplification, run on request: a line of JSON in, a line of JSON out.
//!
//! `{"positions": FILE, "indices": FILE, "rates": [90], "update": false, "output": FILE}` simplifies to each rate (the
//! part removed, in percent) from the same surface and answers `{"ms": [...], "version": "..."}`. Files hold
//! little-endian f32 xyz and u32 corners. With "output", the positions of the last rate go to FILE.positions and its
//! corners to FILE.indices. With "update" vertices move to where the error is least, else they stay.

use std::io::{BufRead as _, Write as _};
use std::time::Instant;

use anyhow::{Context as _, Result};
use meshopt::{SimplifyOptions, VertexDataAdapter, simplify, simplify_with_update, typed_to_bytes};
use serde::{Deserialize, Serialize};

/// No limit: the error is told as a part of the surface's extent.
const ANY_ERROR: f32 = 1.0;

#[derive(Deserialize)]
struct Request {
    positions: String,
    indices: String,
    rates: Vec<f64>,
    #[serde(default)]
    update: bool,
    output: Option<String>,
}

#[derive(Serialize)]
struct Answer {
    ms: Vec<f64>,
    version: &'static str,
}

fn main() -> Result<()> {
    for line in std::io::stdin().lock().lines() {
        let request: Request = serde_json::from_str(&line?)?;
        println!("{}", serde_json::to_string(&answer(&request)?)?);
        std::io::stdout().flush()?;
    }
    Ok(())
}

fn answer(request: &Request) -> Result<Answer> {
    let words_of_positions = words(&request.positions)?;
    let positions: Vec<[f32; 3]> = words_of_positions.chunks_exact(3).map(point).collect();
    let indices = words(&request.indices)?;
    let mut ms = Vec::new();
    for rate in &request.rates {
        let target = (indices.len() as f64 / 3.0 * (1.0 - rate / 100.0)).floor() as usize * 3;
        let (mut moved, mut corners) = (positions.clone(), indices.clone());
        let begun = Instant::now();
        if request.update {
            let count = simplify_with_update(
                &mut corners,
                &mut moved,
                &mut [],
                &[],
                0,
                None,
                target,
                ANY_ERROR,
                SimplifyOptions::None,
                None,
            );
            corners.truncate(count);
        } else {
            let vertices = VertexDataAdapter::new(typed_to_bytes(&positions), 12, 0)?;
            corners = simplify(&indices, &vertices, target, ANY_ERROR, SimplifyOptions::None, None);
        }
        ms.push(begun.elapsed().as_secs_f64() * 1e3);
        if let Some(output) = &request.output {
            std::fs::write(format!("{output}.positions"), typed_to_bytes(&moved))?;
            std::fs::write(format!("{output}.indices"), typed_to_bytes(&corners))?;
        }
    }
    Ok(Answer { ms, version: env!("CARGO_PKG_VERSION") })
}

fn point(words: &[u32]) -> [f32; 3] {
    [words[0], words[1], words[2]].map(f32::from_bits)
}

/// A file's 32-bit words.
fn words(path: &str) -> Result<Vec<u32>> {
    let bytes = std::fs::read(path).with_context(|| format!("{path} cannot be read"))?;
    Ok(bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect())
}
