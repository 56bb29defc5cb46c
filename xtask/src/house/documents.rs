//! The files that a document names.

/// What stands in a line of a document between backticks, or as the target of a link, and may be the name of a file or
/// folder, `{a,b}` written out; and whether it can be nothing else.
pub(super) fn names(line: &str) -> Vec<(String, bool)> {
    let is_sign = |c: char| c.is_ascii_alphanumeric() || "/._-{}*,".contains(c);
    let is_name = |name: &str| name.chars().all(is_sign) && !name.starts_with('/') && !name.is_empty();
    let quoted = line.split('`').skip(1).step_by(2).filter(|name| is_name(name));
    let linked = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()).filter(|name| is_name(name));
    let quoted = quoted.flat_map(written_out).map(|name| {
        let is_path = is_path(&name);
        (name, is_path)
    });
    quoted.chain(linked.map(|name| (name.to_string(), true))).collect()
}

/// Whether what stands between backticks can be nothing else.
fn is_path(name: &str) -> bool {
    let last = name.rsplit('/').next().unwrap_or(name);
    name.starts_with("src/") || name.contains('/') && (last.is_empty() || last.contains('.'))
}

/// `a/{b,c}.rs` is `a/b.rs` and `a/c.rs`.
fn written_out(name: &str) -> Vec<String> {
    let braces = name.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)));
    let Some((before, (choices, after))) = braces else { return vec![name.to_string()] };
    choices.split(',').flat_map(|choice| written_out(&format!("{before}{choice}{after}"))).collect()
}
