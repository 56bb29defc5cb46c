//! The words of the method, explained in a sentence or two each.

use crate::language::Key;

/// Of each word a message: the word, a colon, what it means.
const WORDS: [Key; 25] = [
    Key("lesson-word-boundary-loop"),
    Key("lesson-word-calibre"),
    Key("lesson-word-chebyshev-polynomials"),
    Key("lesson-word-complex-vertex"),
    Key("lesson-word-corner"),
    Key("lesson-word-decimation"),
    Key("lesson-word-deviation"),
    Key("lesson-word-eigenvalue-k"),
    Key("lesson-word-feature-edge"),
    Key("lesson-word-flip"),
    Key("lesson-word-gain"),
    Key("lesson-word-half-edge-collapse"),
    Key("lesson-word-interior-edge-vertex"),
    Key("lesson-word-level"),
    Key("lesson-word-link-condition"),
    Key("lesson-word-marching-cubes"),
    Key("lesson-word-pass-band"),
    Key("lesson-word-progressive-mesh"),
    Key("lesson-word-quadric"),
    Key("lesson-word-reduction-rate"),
    Key("lesson-word-simple-vertex"),
    Key("lesson-word-surface-nets"),
    Key("lesson-word-topology"),
    Key("lesson-word-wavelength"),
    Key("lesson-word-window"),
];

/// The words and what they mean, in the order of the alphabet.
pub(in crate::app) fn glossary() -> Vec<(String, String)> {
    let entry = |key: Key| {
        let text = key.say();
        let (word, meaning) = text.split_once(": ")?;
        Some((word.to_owned(), meaning.to_owned()))
    };
    let mut words: Vec<(String, String)> = WORDS.into_iter().filter_map(entry).collect();
    words.sort_by_cached_key(|(word, _)| place(word));
    words
}

/// Where a word stands in the alphabet: accents and capitals change nothing.
fn place(word: &str) -> String {
    let plain = |letter| match letter {
        'à' | 'â' | 'ä' => 'a',
        'ç' => 'c',
        'é' | 'è' | 'ê' | 'ë' => 'e',
        'î' | 'ï' => 'i',
        'ô' | 'ö' => 'o',
        'ù' | 'û' | 'ü' => 'u',
        other => other,
    };
    word.to_lowercase().chars().map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Language, built_in, speak};

    #[test]
    fn every_line_is_a_word_and_the_words_are_in_order() {
        let words: Vec<String> = glossary().into_iter().map(|(word, _)| word.to_lowercase()).collect();
        assert_eq!(words.len(), WORDS.len());
        assert!(words.is_sorted() && words.len() > 20);
    }

    #[test]
    fn the_words_are_in_the_order_of_their_language() {
        for language in Language::ALL {
            speak(language, built_in(language).unwrap());
            let words = glossary();
            assert_eq!(words.len(), WORDS.len(), "{language:?}");
            assert!(words.is_sorted_by_key(|(word, _)| place(word)), "{words:?}");
        }
        speak(Language::English, &[]);
        assert_eq!([place("Größe"), place("Écart")], ["große", "ecart"]);
    }
}
