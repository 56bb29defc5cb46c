//! Digits as a language writes them: in groups, with its decimal mark.

use super::languages::Language;

/// A number that is given to a message: as many decimals as it has, in groups.
pub(super) fn written(number: f64, language: Language) -> String {
    in_groups(&number.to_string(), language)
}

/// The digits before the point of a number as Rust writes it in groups of three.
pub(super) fn in_groups(number: &str, language: Language) -> String {
    let mark = |c| match c {
        ',' => language.group_mark(),
        '.' => language.decimal_mark(),
        digit => digit,
    };
    lumen_message::grouped(number).chars().map(mark).collect()
}
