//! The files that a document names.

/// What stands in a line of a document between backticks, or as the target of a link, and may be the name of a file or
/// folder, `{a,b}` written out.
pub(super) fn names(line: &str) -> Vec<String> {
    let is_sign = |c: char| c.is_ascii_alphanumeric() || "/._-{}*,".contains(c);
    let quoted = line.split('`').skip(1).step_by(2);
    let linked = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    let names = quoted.chain(linked).filter(|name| name.chars().all(is_sign) && !name.starts_with('/'));
    names.flat_map(written_out).collect()
}

/// Whether a name can be nothing else.
pub(super) fn is_path(name: &str) -> bool {
    let last = name.rsplit('/').next().unwrap_or(name);
    name.contains('/') && (last.is_empty() || last.contains('.'))
}

/// `a/{b,c}.rs` is `a/b.rs` and `a/c.rs`.
fn written_out(name: &str) -> Vec<String> {
    let braces = name.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)));
    let Some((before, (choices, after))) = braces else { return vec![name.to_string()] };
    choices.split(',').flat_map(|choice| written_out(&format!("{before}{choice}{after}"))).collect()
}
