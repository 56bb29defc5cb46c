//! German and French have every message of the libraries, with the same placeables.

use std::collections::{BTreeMap, BTreeSet};

use crate::language::{Language, built_in, speak, tell};
use lumen_message::Signature;

/// The messages of every crate that has some.
const ALL: &[&[&[Signature]]] = &[
    lumen_haptics::MESSAGES,
    lumen_io::MESSAGES,
    lumen_mesh::MESSAGES,
    lumen_pipeline::MESSAGES,
    lumen_prepare::MESSAGES,
    lumen_transfer::MESSAGES,
    lumen_trial::MESSAGES,
    lumen_vessel::MESSAGES,
    lumen_volume::MESSAGES,
];

/// The placeables of each message of a language.
fn placeables(language: Language) -> BTreeMap<String, BTreeSet<String>> {
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut last = String::new();
    for line in built_in(language).unwrap().iter().flat_map(|text| text.lines()) {
        if let Some((id, _)) = line.split_once(" =").filter(|_| line.starts_with(|c: char| c.is_ascii_lowercase())) {
            id.clone_into(&mut last);
            all.entry(last.clone()).or_default();
        } else if !line.starts_with([' ', '}']) {
            last.clear();
        }
        let names = line
            .split('$')
            .skip(1)
            .map(|rest| rest.chars().take_while(|&c| c.is_ascii_alphanumeric() || c == '_').collect::<String>());
        if let Some(found) = all.get_mut(&last) {
            found.extend(names);
        }
    }
    all
}

#[test]
fn german_and_french_have_every_message_of_the_libraries() {
    let english = placeables(Language::English);
    let [german, french] = [Language::German, Language::French].map(placeables);
    for (id, found) in &german {
        // A number that one of them leaves out is lost to its readers.
        assert_eq!(french.get(id), Some(found), "{id}");
    }
    for language in [Language::German, Language::French] {
        let theirs = placeables(language);
        for &(id, fields) in ALL.iter().copied().flatten().copied().flatten() {
            let Some(found) = theirs.get(id) else { panic!("{language:?} lacks {id}") };
            let known: BTreeSet<String> = fields.iter().map(|&field| field.to_owned()).collect();
            assert!(found.is_subset(&known), "{language:?}, {id}: {found:?} of {known:?}");
            assert!(!english.contains_key(id), "{id} stands in the code: the English catalogue has it twice");
        }
        let known: BTreeSet<&str> = ALL.iter().copied().flatten().copied().flatten().map(|&(id, _)| id).collect();
        let of_nobody: Vec<_> =
            theirs.keys().filter(|id| !english.contains_key(*id) && !known.contains(&***id)).collect();
        assert_eq!(of_nobody, Vec::<&String>::new(), "{language:?}: nobody says these");
    }
}

#[test]
fn what_was_mended_is_said_in_the_language_of_the_moment() {
    use crate::io::Warning;

    let warnings = [Warning::Degenerate { count: 1 }, Warning::Reoriented { count: 1 }];
    speak(Language::German, built_in(Language::German).unwrap());
    let german = warnings.each_ref().map(|warning| tell(warning));
    speak(Language::English, &[]);
    assert_eq!(
        german,
        ["1 Dreieck mit wiederholtem Eckpunkt verworfen.", "1 Dreieck umgedreht, damit es zu seinen Nachbarn passt."]
    );
}

#[test]
fn vessels_and_places_are_called_in_the_language_of_the_moment() {
    use crate::trial::route::PlaceName;
    use crate::vessel::summary::{fixtures, summary};

    let found = summary(&fixtures::certificate(&[Some(2.5), Some(-9.04), None, Some(1.0)]));
    let entry = PlaceName::Entry { branch: 2, diameter_mm: 9.04 }.label();
    speak(Language::German, built_in(Language::German).unwrap());
    let (found, entry) = (tell(&found), tell(&entry));
    speak(Language::English, &[]);
    assert!(found.contains("2 von 3") && found.contains("Ast 2: -9,0 %") && found.contains("Messung"), "{found}");
    assert_eq!(entry, "Ast 3, 9,0 mm");
}
