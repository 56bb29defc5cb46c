//! What is said of a file before work on it begins, where the machine may not have the memory.

use crate::io::estimate;
use crate::language::decimal;
use crate::say;

/// A sentence where opening and reducing the file may take more than `limit` bytes.
pub(super) fn warning(name: &str, bytes: &[u8], limit: u64) -> Option<String> {
    let estimate = estimate(bytes, name).filter(|estimate| estimate.memory > limit)?;
    // To two digits: it is no more than an estimate.
    let unit = 10u64.pow(estimate.triangles.ilog10().saturating_sub(1));
    Some(say!(
        "views-large",
        name = name,
        count = estimate.triangles / unit * unit,
        needed = decimal(estimate.memory as f64 / 1e9, 0),
        limit = decimal(limit as f64 / 1e9, 0),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_may_not_fit_is_told_of() {
        let mut bytes = vec![0; 84 + 50 * 30_000];
        bytes[80..84].copy_from_slice(&30_000u32.to_le_bytes());
        assert_eq!(warning("a.stl", &bytes, 4_000_000_000), None);
        let text = warning("a.stl", &bytes, 5_000_000).unwrap();
        assert!(text.starts_with("a.stl has about 30,000 triangles, for which some 0 GB"), "{text}");
    }
}
