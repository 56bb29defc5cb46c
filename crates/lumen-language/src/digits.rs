//! Digits as a language writes them: in groups, with its decimal mark.

use super::languages::Language;

/// A number that is given to a message: as many decimals as it has, in groups.
pub(super) fn written(number: f64, language: Language) -> String {
    in_groups(&number.to_string(), language)
}

/// The digits before the point of a number as Rust writes it in groups of three.
pub(super) fn in_groups(number: &str, language: Language) -> String {
    let (sign, rest) = number.strip_prefix('-').map_or(("", number), |rest| ("-", rest));
    let (whole, decimals) = rest.split_once('.').unwrap_or((rest, ""));
    let mut text = sign.to_owned();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            text.push(language.group_mark());
        }
        text.push(digit);
    }
    if !decimals.is_empty() {
        text.push(language.decimal_mark());
        text += decimals;
    }
    text
}
