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

/// What docs/privacy.md says of the exceptions: the names of arrays are shown, and of a word that cannot be read the first
/// twenty characters.
#[test]
fn what_is_quoted_of_a_file_is_what_the_documents_say() {
    let folder = Folder::new("privacy-quoted");
    let named = folder.file("named.ply");
    let head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property float DOE^JANE\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
    let body = "0 0 0 1\n30 0 0 2\n0 30 0 3\n0 0 30 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    std::fs::write(&named, [head, body].concat()).unwrap();
    assert!(succeed(&["inspect", &named]).contains("array DOE^JANE"));
    let broken = folder.file("broken.obj");
    std::fs::write(&broken, "v 0 0 0\nv 1 0 0\nv 0 DOE^JANE^1950-01-02^PID4711 0\nf 1 2 3\n").unwrap();
    let output = lumen(&["inspect", &broken]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && error.contains("\"DOE^JANE^1950-01-02^...\""), "{error}");
    assert!(!error.contains("PID4711"), "{error}");
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
