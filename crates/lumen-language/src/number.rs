//! Numbers as the language that is spoken writes and reads them.

use std::fmt::Display;

use super::digits::in_groups;
use super::spoken;

/// The digits before the point in groups of three, in the language that is spoken: 74,307; -1,234.50. `number` is a number
/// as Rust writes it.
pub fn grouped(number: impl Display) -> String {
    in_groups(&number.to_string(), spoken())
}

/// A number with `places` decimals, in the language that is spoken, not in groups: 0.010.
pub fn decimal(number: impl Into<f64>, places: usize) -> String {
    marked(format!("{:.places$}", number.into()))
}

/// As [`decimal`], with a power of ten: 1.50e-5.
pub fn scientific(number: impl Into<f64>, places: usize) -> String {
    marked(format!("{:.places$e}", number.into()))
}

/// With the decimal mark of the language that is spoken.
fn marked(text: String) -> String {
    match spoken().decimal_mark() {
        '.' => text,
        mark => text.replace('.', mark.encode_utf8(&mut [0; 4])),
    }
}

/// As [`decimal`], with a plus where it is above zero: +0.5.
pub fn signed(number: impl Into<f64>, places: usize) -> String {
    marked(lumen_message::signed(number.into(), places))
}

/// What is typed as a number, with a decimal point or a decimal comma, whatever is spoken. Where both stand in it, or one of
/// them more than once, the last kind marks the decimals and the other the groups; in a field for a whole number
/// (`is_whole`) one that has three digits behind it marks a group.
pub fn parse(text: &str, is_whole: bool) -> Option<f64> {
    // A minus as it is printed is one too.
    let text: String =
        text.chars().filter(|c| !c.is_whitespace() && *c != '\'').collect::<String>().replace('\u{2212}', "-");
    let (points, commas) = (text.matches('.').count(), text.matches(',').count());
    let mark = match (points, commas) {
        (0, 0) => None,
        (1, 0) => Some('.'),
        (0, 1) => Some(','),
        (0, _) | (_, 0) => None,
        _ => text.chars().rev().find(|c| matches!(c, '.' | ',')),
    };
    let is_group = |mark| {
        let (before, behind) = text.split_once(mark).unwrap_or((&text, ""));
        let lead = before.trim_start_matches(['-', '+']);
        behind.len() == 3 && !lead.is_empty() && lead != "0" && behind.bytes().all(|c| c.is_ascii_digit())
    };
    let mark = mark.filter(|&mark| !(is_whole && points + commas == 1 && is_group(mark)));
    let plain: String = match mark {
        Some(mark) => {
            let other = if mark == '.' { ',' } else { '.' };
            text.replace(other, "").replace(mark, ".")
        }
        None => text.replace(['.', ','], ""),
    };
    plain.parse().ok().filter(|number: &f64| number.is_finite())
}

/// A number with as many decimals as it has, in the language that is spoken, not in groups: 1234.5.
pub fn exact(number: f64) -> String {
    let text = number.to_string();
    match text.split_once('.') {
        Some((_, decimals)) => decimal(number, decimals.len()),
        None => text,
    }
}
