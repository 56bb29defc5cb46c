//! What stands in a file's header can be a patient's name: it goes nowhere.

use crate::program::{Folder, lumen, succeed};

const NAME: &str = "DOE^JANE 1950-01-02 PID4711";

/// A vessel in a format, with the name where the format has room for words.
fn named(folder: &Folder, ending: &str) -> String {
    let path = folder.file(&format!("vessel.{ending}"));
    succeed(&["phantom", "aorta", "--triangles", "4000", "-o", &path]);
    let mut bytes = std::fs::read(&path).unwrap();
    let mut insert_before = |what: &[u8], words: &str| {
        let at = bytes.windows(what.len()).position(|part| part == what).unwrap();
        bytes.splice(at..at, words.bytes());
    };
    match ending {
        "stl" => bytes[..NAME.len()].copy_from_slice(NAME.as_bytes()),
        "ply" => insert_before(b"element ", &format!("comment {NAME}\nobj_info {NAME}\n")),
        "obj" => insert_before(b"v ", &format!("# {NAME}\no {NAME}\ng {NAME}\n")),
        "vtk" => insert_before(b"Surface", NAME),
        _ => insert_before(b"<PolyData", &format!("<!-- {NAME} -->")),
    }
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn words_of_a_header_are_in_no_output() {
    let folder = Folder::new("privacy");
    let holds = |bytes: &[u8]| {
        [NAME, "DOE^JANE", "PID4711"].iter().any(|name| bytes.windows(name.len()).any(|part| part == name.as_bytes()))
    };
    for ending in ["stl", "ply", "obj", "vtk", "vtp"] {
        let input = named(&folder, ending);
        assert!(holds(&std::fs::read(&input).unwrap()), "{ending}: the test has put it in");
        let out = folder.file(&format!("out-{ending}/"));
        let settings = folder.file(&format!("settings-{ending}.json"));
        let commands: [&[&str]; 3] = [
            &["optimise", &input, "-o", &out, "--format", ending, "--save-settings", &settings],
            &["inspect", &input, "--json"],
            &["inspect", &input],
        ];
        for command in commands {
            let output = lumen(command);
            assert!(output.status.success(), "{ending}: {}", String::from_utf8_lossy(&output.stderr));
            assert!(!holds(&output.stdout) && !holds(&output.stderr), "{ending}: {command:?}");
        }
        let written = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().path());
        for path in written.chain([settings.into()]) {
            assert!(!holds(&std::fs::read(&path).unwrap()), "{}", path.display());
        }
    }
}
