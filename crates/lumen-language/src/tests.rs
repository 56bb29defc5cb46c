//! Numbers and tags in each language, and the catalogues: each message is there in all of them, is understood and is said.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use super::*;

#[test]
fn numbers_are_grouped_in_threes() {
    assert_eq!([0, 12, 743, 7_430, 74_307, 1_000_000].map(grouped), ["0", "12", "743", "7,430", "74,307", "1,000,000"]);
    assert_eq!(["743", "-66875", "-743", "1234567.50"].map(grouped), ["743", "-66,875", "-743", "1,234,567.50"]);
    speak(Language::German, &[]);
    assert_eq!((grouped(74_307), decimal(0.01, 3)), ("74.307".to_owned(), "0,010".to_owned()));
    speak(Language::French, &[]);
    assert_eq!(grouped("-1234.5"), "-1\u{a0}234,5");
    assert_eq!(scientific(-0.000_015, 2), "-1,50e-5");
    speak(Language::English, &[]);
    assert_eq!(decimal(-0.125_f32, 3), "-0.125");
}

#[test]
fn a_decimal_comma_is_read_as_a_point_is() {
    for (typed, is_whole, meant) in [
        ("0.010", false, Some(0.01)),
        ("0,010", false, Some(0.01)),
        ("0,010", true, Some(0.01)),
        ("1,5", true, Some(1.5)),
        ("12,5 ", false, Some(12.5)),
        ("74,307", true, Some(74_307.0)),
        ("74.307", true, Some(74_307.0)),
        ("74,307", false, Some(74.307)),
        ("1,234,567", false, Some(1_234_567.0)),
        ("1.234.567", true, Some(1_234_567.0)),
        ("1,234.5", false, Some(1_234.5)),
        ("1.234,5", false, Some(1_234.5)),
        ("1 234,5", false, Some(1_234.5)),
        ("\u{2212}3,25", false, Some(-3.25)),
        ("-.5", false, Some(-0.5)),
        ("1e-3", false, Some(0.001)),
        ("", false, None),
        ("mm", false, None),
        ("inf", false, None),
        ("1,2.3,4", false, None),
    ] {
        assert_eq!(parse(typed, is_whole), meant, "{typed:?}, whole: {is_whole}");
    }
}

#[test]
fn a_tag_or_a_locale_names_its_language() {
    for (tag, language) in [
        ("de", Some(Language::German)),
        ("de-AT", Some(Language::German)),
        ("fr_FR.UTF-8", Some(Language::French)),
        ("EN-us", Some(Language::English)),
        ("ja", None),
        ("C", None),
        ("", None),
    ] {
        assert_eq!(Language::of_tag(tag), language, "{tag}");
    }
}

#[test]
fn what_a_language_lacks_is_said_in_english() {
    speak(
        Language::German,
        &["language-test = { $count ->\n    [one] ein Dreieck\n   *[other] { $count } Dreiecke\n}"],
    );
    assert_eq!(
        [1, 2, 74_307].map(|count| say!("language-test", count = count)),
        ["ein Dreieck", "2 Dreiecke", "74.307 Dreiecke"]
    );
    assert_eq!(Key("about-not-clinical").say(), "Not for clinical decisions");
    speak(Language::English, &[]);
}

/// A message of a file: its name, its words, and what is put into it.
struct Found {
    words: String,
    places: BTreeSet<String>,
}

/// The messages of a language, by their files and names.
fn found(tag: &str) -> BTreeMap<(String, String), Found> {
    let mut all = BTreeMap::new();
    for file in std::fs::read_dir(root().join("locales").join(tag)).unwrap().map(|entry| entry.unwrap().path()) {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        let mut last = None;
        for line in std::fs::read_to_string(&file).unwrap().lines() {
            let key = line.split_once('=').map(|(key, _)| key.trim_end());
            if let Some(key) = key.filter(|_| line.starts_with(|c: char| c.is_ascii_lowercase())) {
                let of = (name.clone(), key.to_owned());
                let found = Found { words: String::new(), places: BTreeSet::new() };
                assert!(all.insert(of.clone(), found).is_none(), "{tag}/{name}: {key} stands there twice");
                last = Some(of);
            } else if !line.starts_with([' ', '}']) && !line.is_empty() {
                assert!(line.starts_with('#'), "{tag}/{name}: {line}");
                last = None;
            }
            let Some(found) = last.as_ref().and_then(|of| all.get_mut(of)) else { continue };
            found.words += line;
            found.words.push('\n');
            found.places.extend(line.split('$').skip(1).map(|rest| {
                rest.chars().take_while(|&c| c.is_ascii_alphanumeric() || c == '_' || c == '-').collect::<String>()
            }));
        }
    }
    all
}

/// The messages that the source says, each with what it puts in: `None` for those that a table names.
fn said() -> Vec<(String, Option<BTreeSet<String>>, String)> {
    let mut all = Vec::new();
    let mut folders = ["src", "web", "crates"].map(|folder| workspace().join(folder)).to_vec();
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let is_own = path.to_string_lossy().contains("language");
            if path.extension().is_none_or(|ending| ending != "rs") || is_own {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let place = path.strip_prefix(workspace()).unwrap().display().to_string();
            for (opening, takes) in [("say!(", true), ("Key(", false)] {
                for (_, rest) in text.match_indices(opening).map(|(at, _)| text[at..].split_at(opening.len())) {
                    let Some(rest) = rest.trim_start().strip_prefix('"') else { continue };
                    let Some((name, rest)) = rest.split_once('"') else { continue };
                    all.push((name.to_owned(), takes.then(|| given(rest)), place.clone()));
                }
            }
        }
    }
    all
}

/// The messages that the rows of the table of settings name.
fn of_settings() -> Vec<String> {
    let mut all = Vec::new();
    for file in std::fs::read_dir(workspace().join("crates/lumen-pipeline/src/settings")).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
        for field in ["label: \"", "help: \"", "said: \""] {
            let names = text.split(field).skip(1).filter_map(|rest| rest.split('"').next());
            // The help of the command line is a sentence.
            all.extend(names.filter(|name| !name.is_empty() && !name.contains(' ')).map(str::to_owned));
        }
    }
    all
}

/// The names of what is put in: those before a `=` that stands between no brackets of its own.
fn given(rest: &str) -> BTreeSet<String> {
    let (mut depth, mut word, mut names, mut in_text) = (0, String::new(), BTreeSet::new(), false);
    let mut before = ' ';
    for (i, c) in rest.char_indices() {
        let next = rest[i + c.len_utf8()..].chars().next().unwrap_or(' ');
        match c {
            '"' if before != '\\' => in_text = !in_text,
            _ if in_text => {}
            '(' | '[' | '{' => depth += 1,
            ')' if depth == 0 => break,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => word.clear(),
            '=' if depth == 0 && next != '=' && !"=<>!".contains(before) && next != '>' => {
                names.insert(std::mem::take(&mut word).trim().to_owned());
            }
            _ if depth == 0 => word.push(c),
            _ => {}
        }
        before = c;
    }
    names
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of the whole workspace, whose programs say the messages.
fn workspace() -> PathBuf {
    root().ancestors().nth(2).unwrap().to_path_buf()
}

#[test]
fn every_language_has_every_message_with_the_same_places() {
    let english = found("en");
    for tag in ["de", "fr"] {
        let mut other = found(tag);
        assert!(other.len() > 800, "{} messages", other.len());
        // What only they have stands in English in the libraries: `src/translations.rs` of the root crate compares those.
        other.retain(|of, _| english.contains_key(of));
        let missing: Vec<_> = english.keys().filter(|of| !other.contains_key(of)).collect();
        assert_eq!(missing, Vec::<&(String, String)>::new(), "{tag}");
        for (of, found) in &other {
            assert_eq!(found.places, english[of].places, "{tag}: {of:?}");
        }
        // Some words are the same in two languages; most are not.
        let same = other.iter().filter(|(of, found)| found.words == english[of].words).count();
        assert!(same * 10 < other.len(), "{tag}: {same} of {} messages are the English ones", other.len());
    }
    for (file, name) in english.keys() {
        let of = file.trim_end_matches(".ftl");
        assert!(name == "about-not-clinical" || name.starts_with(&format!("{of}-")), "{file}: {name}");
    }
}

#[test]
fn every_message_is_understood() {
    for language in Language::ALL {
        for text in built_in(language).unwrap() {
            let resource = fluent_bundle::FluentResource::try_new((*text).to_owned());
            assert!(resource.is_ok(), "{language:?}: {:?}", resource.err().map(|(_, faults)| faults));
        }
        speak(language, built_in(language).unwrap());
        for ((file, name), found) in found(language.tag()) {
            // Every plural is one of a number.
            let mut message = Message::new(name.clone().leak());
            for place in &found.places {
                message.put(place.clone().leak(), Value::Number(2.0));
            }
            let text = message.say();
            assert!(!text.is_empty() && text != name, "{language:?}, {file}: {name}");
        }
        speak(Language::English, &[]);
    }
}

#[test]
fn every_message_that_is_said_is_there_and_every_one_that_is_there_is_said() {
    let english: BTreeMap<String, BTreeSet<String>> =
        found("en").into_iter().map(|((_, name), found)| (name, found.places)).collect();
    let said = said();
    for (name, places, file) in &said {
        let there = english.get(name);
        assert!(there.is_some(), "{file}: there is no {name}");
        assert_eq!(there, places.as_ref().or(Some(&BTreeSet::new())), "{file}: what is put into {name}");
    }
    let of_settings = of_settings();
    assert!(of_settings.len() > 40, "{of_settings:?}");
    for name in &of_settings {
        let places = english.get(name);
        assert!(places.is_some_and(|places| places.iter().all(|place| place == "value")), "{name}: {places:?}");
    }
    let names: BTreeSet<&String> = said.iter().map(|(name, ..)| name).chain(&of_settings).collect();
    let unsaid: Vec<&String> = english.keys().filter(|name| !names.contains(name)).collect();
    assert_eq!(unsaid, Vec::<&String>::new(), "nobody says these");
}

/// Thresholds and sizes that are never one.
const MANY: [&str; 6] =
    ["compare-figure-legend", "compare-slow", "record-pixels", "views-large", "panel-array-components", "panel-pieces"];

#[test]
fn one_of_what_is_counted_is_singular() {
    let plurals =
        ["triangles", "pieces", "vertices", "edges", "labels", "iterations", "places", "neighbours", "passes"];
    let german =
        ["Dreiecke", "Dreiecken", "Stücke", "Stücken", "Eckpunkte", "Kanten", "Labels", "Iterationen", "Stellen"];
    let french =
        ["triangles", "morceaux", "sommets", "arêtes", "étiquettes", "itérations", "endroits", "voisins", "passes"];
    let of_language = [(Language::English, plurals), (Language::German, german), (Language::French, french)];
    for (language, plurals) in of_language {
        speak(language, built_in(language).unwrap());
        let own: Vec<_> =
            found("en").into_keys().map(|(_, name)| name).filter(|name| !MANY.contains(&&**name)).collect();
        for ((_, name), message) in found(language.tag()).into_iter().filter(|((_, name), _)| own.contains(name)) {
            for on in ["vertices", "triangles"] {
                let mut said = Message::new(name.clone().leak());
                for place in &message.places {
                    let value = if place == "on" { Value::Text(on.into()) } else { Value::Number(1.0) };
                    said.put(place.clone().leak(), value);
                }
                let text = said.say();
                let words: Vec<&str> = text.split([' ', ',', '.', ':', ';', '\u{a0}']).collect();
                let wrong = words.windows(2).find(|pair| pair[0] == "1" && plurals.contains(&pair[1]));
                assert_eq!(wrong, None, "{language:?}, {name}: {text}");
            }
        }
    }
    speak(Language::English, &[]);
}

#[test]
fn no_tooltip_breaks_a_line_between_a_number_and_its_unit() {
    for language in Language::ALL {
        for ((file, name), found) in found(language.tag()).into_iter().filter(|((_, name), _)| name.ends_with("-help"))
        {
            let words: Vec<&str> = found.words.split(' ').collect();
            let is_number = |word: &str| word.ends_with(|c: char| c.is_ascii_digit() || c == '}');
            let is_unit = |word: &str| {
                ["mm", "cm", "%", "MB", "GB", "HU", "N", "ms"]
                    .contains(&word.trim_end_matches(['.', ',', ';', ':', '\n']))
            };
            let broken = words.windows(2).find(|pair| is_number(pair[0]) && is_unit(pair[1]));
            assert_eq!(broken, None, "{language:?}, {file}: {name}");
        }
    }
}
