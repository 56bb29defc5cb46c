//! Letters of Helvetica, which every reader of PDF has: their numbers (WinAnsiEncoding) and widths (Adobe's font metrics,
//! in thousandths of the size).

/// Widths from the space to the tilde.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833,
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556,
    556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334,
    260, 334, 584,
];
/// Widths of letters with accents, from À to ÿ.
const ACCENTED: [u16; 64] = [
    667, 667, 667, 667, 667, 667, 1000, 722, 667, 667, 667, 667, 278, 278, 278, 278, 722, 722, 778, 778, 778, 778, 778,
    584, 778, 722, 722, 722, 722, 667, 667, 611, 556, 556, 556, 556, 556, 556, 889, 500, 556, 556, 556, 556, 278, 278,
    278, 278, 556, 556, 556, 556, 556, 556, 556, 584, 611, 556, 556, 556, 556, 500, 556, 500,
];
/// Of any other letter: few are wider.
const OTHER: u16 = 667;
/// Bold letters are at most so much wider.
const BOLD: f32 = 1.1;

/// A text in the encoding of the fonts; letters that they lack become question marks.
pub(super) fn encoded(text: &str) -> Vec<u8> {
    let number = |letter: char| match letter {
        ' '..='~' | '\u{a0}'..='\u{ff}' => letter as u8,
        '–' | '−' => 0x96,
        '—' => 0x97,
        '‘' => 0x91,
        '’' => 0x92,
        '“' => 0x93,
        '”' => 0x94,
        '‚' => 0x82,
        '„' => 0x84,
        '‹' => 0x8b,
        '›' => 0x9b,
        'Œ' => 0x8c,
        'œ' => 0x9c,
        '•' => 0x95,
        '…' => 0x85,
        '€' => 0x80,
        letter if letter.is_whitespace() => b' ',
        _ => b'?',
    };
    text.chars().map(number).collect()
}

/// The width of an encoded text, in points.
pub(super) fn width(text: &[u8], size: f32, is_bold: bool) -> f32 {
    let of = |&letter: &u8| match letter {
        b' '..=b'~' => WIDTHS[usize::from(letter - b' ')],
        // A space that no line is broken at, and quotation marks.
        0xa0 => WIDTHS[0],
        0xab | 0xbb => 556,
        0xc0.. => ACCENTED[usize::from(letter - 0xc0)],
        _ => OTHER,
    };
    let sum: u32 = text.iter().map(|letter| u32::from(of(letter))).sum();
    sum as f32 / 1000.0 * size * if is_bold { BOLD } else { 1.0 }
}

/// A text in lines no wider than `room` points: its own lines, broken at spaces, and within a word where that alone is wider.
pub(super) fn lines(text: &str, size: f32, room: f32) -> Vec<Vec<u8>> {
    text.split('\n').flat_map(|line| broken(line, size, room)).collect()
}

/// A line of a text, likewise.
fn broken(text: &str, size: f32, room: f32) -> Vec<Vec<u8>> {
    let mut lines: Vec<Vec<u8>> = Vec::new();
    let mut line: Vec<u8> = Vec::new();
    for word in encoded(text).split(|&letter| letter == b' ') {
        let longer = if line.is_empty() { word.to_vec() } else { [&line, &b" "[..], word].concat() };
        if width(&longer, size, false) <= room {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for &letter in word {
            line.push(letter);
            if width(&line, size, false) > room && line.len() > 1 {
                line.pop();
                lines.push(std::mem::replace(&mut line, vec![letter]));
            }
        }
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_hold_all_letters_and_are_no_wider_than_asked() {
        let text = "A verdict of some words and 0123456789abcdef0123456789abcdef0123456789abcdef without a space.";
        let found = lines(text, 8.0, 90.0);
        assert!(found.len() > 3 && found.iter().all(|line| width(line, 8.0, false) <= 90.0));
        let letters = |text: &[u8]| text.iter().filter(|&&letter| letter != b' ').count();
        assert_eq!(found.iter().map(|line| letters(line)).sum::<usize>(), letters(text.as_bytes()));
    }

    #[test]
    fn a_text_of_several_lines_keeps_them_and_what_is_empty_between() {
        assert_eq!(lines("one two\n\nthree", 8.0, 90.0), [&b"one two"[..], b"", b"three"]);
    }

    #[test]
    fn german_and_french_letters_have_their_numbers_and_widths() {
        assert_eq!(
            encoded("ß ü é œ « » „ “ – ° ± ×").split(|&letter| letter == b' ').collect::<Vec<_>>().concat(),
            [0xdf, 0xfc, 0xe9, 0x9c, 0xab, 0xbb, 0x84, 0x93, 0x96, 0xb0, 0xb1, 0xd7]
        );
        for (with, without) in [("Öffnung", "Offnung"), ("géométrie", "geometrie"), ("à\u{a0}la", "a la")] {
            assert_eq!(width(&encoded(with), 8.0, false).to_bits(), width(&encoded(without), 8.0, false).to_bits());
        }
    }

    #[test]
    fn letters_that_the_font_lacks_are_question_marks() {
        assert_eq!(encoded("a–\u{e9}血\n"), [b'a', 0x96, 0xe9, b'?', b' ']);
    }
}
