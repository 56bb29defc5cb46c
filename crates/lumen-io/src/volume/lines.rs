//! The lines of a header that is text, with numbers behind it that are none: NRRD's and MetaImage's.

/// Lines of a header at most.
const MAX_LINES: usize = 1000;

/// The lines of a header that begins at `start`, without their ends, each with the place where what is behind it begins. They
/// end with the bytes, or where there are more than any header has.
pub(super) fn lines(bytes: &[u8], start: usize) -> impl Iterator<Item = (&[u8], usize)> {
    let mut at = start;
    let next = move || {
        let rest = bytes.get(at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        at = bytes.len().min(at + length + 1);
        Some((&rest[..length], at))
    };
    std::iter::from_fn(next).take(MAX_LINES)
}
