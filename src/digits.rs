//! Numbers as they are read: digits in groups of three.

use std::fmt::Display;

/// The digits before the point in groups of three: 74,307; -1,234.50.
pub(crate) fn grouped(number: impl Display) -> String {
    let number = number.to_string();
    let (sign, rest) = number.strip_prefix('-').map_or(("", &*number), |rest| ("-", rest));
    let whole = rest.split('.').next().unwrap_or(rest);
    let mut text = sign.to_owned();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text + &rest[whole.len()..]
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn numbers_are_grouped_in_threes() {
        assert_eq!(
            [0, 12, 743, 7_430, 74_307, 1_000_000].map(grouped),
            ["0", "12", "743", "7,430", "74,307", "1,000,000"]
        );
        assert_eq!(["743", "-66875", "-743", "1234567.50"].map(grouped), ["743", "-66,875", "-743", "1,234,567.50"]);
    }
}
