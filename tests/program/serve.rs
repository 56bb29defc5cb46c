//! Another program holds the wire: `lumen trial --serve`.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

use crate::program::lumen;

/// A trial whose wire is held.
struct Held {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

impl Held {
    /// It, and what it says first.
    fn new(arguments: &[&str]) -> (Self, Value) {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lumen"))
            .args(["trial", "sample:aorta", "--triangles", "20000", "--serve"])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (to, from) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
        let mut held = Self { child, to, from };
        let first = held.hear();
        (held, first)
    }

    fn hear(&mut self) -> Value {
        let mut line = String::new();
        self.from.read_line(&mut line).unwrap();
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line:?}"))
    }

    fn ask_bytes(&mut self, line: &[u8]) -> Value {
        self.to.write_all(line).unwrap();
        self.to.write_all(b"\n").unwrap();
        self.hear()
    }

    fn ask(&mut self, request: &Value) -> Value {
        self.ask_bytes(request.to_string().as_bytes())
    }

    /// What it says of the wire after so many decisions.
    fn step(&mut self, feed: f64, roll: f64, repeat: u32) -> Value {
        let mut answer = self.ask(&json!({ "step": { "feed_mm_s": feed, "roll_rad_s": roll, "repeat": repeat } }));
        answer["observation"].take()
    }

    /// Ends what it reads.
    fn end(self) {
        let Self { mut child, to, .. } = self;
        drop(to);
        assert!(child.wait().unwrap().success());
    }
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is no number in {value}"))
}

#[test]
fn what_is_asked_for_is_fed_and_rolled() {
    let (mut held, first) = Held::new(&[]);
    assert_eq!(first["trial"]["notice"], "Not for clinical decisions.");
    let inserted = number(&first["observation"], "inserted_mm");
    // 10 mm/s and 1 rad/s for 50 decisions of 0.02 s are 10 mm and 1 rad.
    let there = held.step(10.0, 1.0, 50);
    assert_eq!((number(&there, "time_s"), number(&there, "steps")), (1.0, 500.0));
    assert!((number(&there, "inserted_mm") - inserted - 10.0).abs() < 1e-3, "{there}");
    assert!((number(&there, "roll_rad") - number(&first["observation"], "roll_rad") - 1.0).abs() < 1e-3, "{there}");
    assert!(number(&there, "target_mm") < number(&first["observation"], "target_mm"));
    let back = held.step(-10.0, -1.0, 25);
    assert!((number(&back, "inserted_mm") - inserted - 5.0).abs() < 1e-3, "{back}");
    // Faster than is allowed is as fast as that: 50 mm/s.
    let fast = held.step(1e9, 0.0, 1);
    assert!(number(&fast, "inserted_mm") - number(&back, "inserted_mm") < 50.0 * 0.02 + 1e-3, "{fast}");
    held.end();
}

#[test]
fn nodes_and_contacts_are_told_on_request_alone() {
    let (mut held, first) = Held::new(&[]);
    assert!(first["observation"].get("nodes_mm").is_none());
    held.step(20.0, 0.0, 200);
    let shown = held.ask(&json!({ "observe": { "show": ["nodes", "contacts"] } }))["observation"].take();
    let nodes = shown["nodes_mm"].as_array().unwrap();
    for axis in 0..3 {
        let difference = nodes[0][axis].as_f64().unwrap() - shown["tip_mm"][axis].as_f64().unwrap();
        assert!(difference.abs() < 1e-4, "the first node is the tip");
    }
    let length: f64 = nodes
        .windows(2)
        .map(|pair| {
            (0..3)
                .map(|axis| (pair[0][axis].as_f64().unwrap() - pair[1][axis].as_f64().unwrap()).powi(2))
                .sum::<f64>()
                .sqrt()
        })
        .sum();
    let inserted = number(&shown, "inserted_mm");
    assert!(
        (length / inserted - 1.0).abs() < 0.01,
        "the wire is as long as what is outside: {length} mm, {inserted} mm"
    );
    let contacts = shown["contacts_at"].as_array().unwrap();
    assert!(!contacts.is_empty(), "80 mm of wire in an arch touch the wall");
    let total: f64 = contacts.iter().map(|contact| number(contact, "force_n")).sum();
    assert!((total - number(&shown, "wall_force_n")).abs() < 1e-6 + 1e-3 * total, "{total} N");
    held.end();
}

#[test]
fn the_same_requests_have_the_same_answers() {
    let run = || {
        let (mut held, first) = Held::new(&["--seed", "7"]);
        let mut told = vec![first];
        // A generator of Lehmer's: inputs that nobody chose.
        let mut state: u64 = 48_271;
        for _ in 0..40 {
            let mut random = || {
                state = state * 48_271 % 2_147_483_647;
                state as f64 / 2_147_483_647.0
            };
            let (feed, roll) = (50.0 * random() - 15.0, 12.0 * random() - 6.0);
            told.push(held.step(feed, roll, 5));
        }
        held.end();
        told
    };
    assert_eq!(run(), run());
}

#[test]
fn a_reset_begins_anew() {
    let (mut held, first) = Held::new(&[]);
    held.step(20.0, 0.0, 20);
    assert_eq!(held.ask(&json!({ "reset": {} })), first);
    let varied = held.ask(&json!({ "reset": { "seed": 3 } }));
    assert_ne!(varied["observation"]["tip_mm"], first["observation"]["tip_mm"]);
    // Where the tip is after 30 mm is a place in the lumen.
    let place = held.step(20.0, 0.0, 75)["tip_mm"].clone();
    let led = held.ask(&json!({ "reset": { "target": place, "wire": "workhorse" } }));
    assert_eq!(led["trial"]["wire"], "workhorse");
    assert!(number(&led["trial"], "route_length_mm") < number(&first["trial"], "route_length_mm"));
    let arrived = (0..100).any(|_| held.step(10.0, 0.0, 10)["has_arrived"] == true);
    assert!(arrived, "the wire comes to where one was");
    held.end();
}

#[test]
fn a_line_that_cannot_be_followed_is_told_and_changes_nothing() {
    let (mut held, _) = Held::new(&[]);
    held.step(20.0, 1.0, 10);
    let observe = json!({ "observe": {} });
    let before = held.ask(&observe);
    let lines: [(&[u8], &str); 13] = [
        (b"{", "the line is not understood"),
        (b"[]", "the line is not understood"),
        (b"\xff", "the line is not understood"),
        (b"{\"stepp\":{}}", "unknown variant `stepp`"),
        (b"{\"step\":{\"feed\":1}}", "unknown field `feed`"),
        (b"{\"step\":{\"feed_mm_s\":\"fast\"}}", "the line is not understood"),
        (b"{\"step\":{\"repeat\":0}}", "repeat is 1 to 3000, not 0"),
        (b"{\"step\":{\"repeat\":3001}}", "repeat is 1 to 3000, not 3001"),
        (b"{\"step\":{\"show\":[\"everything\"]}}", "unknown variant `everything`"),
        (b"{\"reset\":{\"wire\":\"rope\"}}", "there is no wire \"rope\""),
        (b"{\"reset\":{\"entry\":[1e9,0,0]}}", "no trial is possible"),
        (b"{\"reset\":{\"target\":[1e9,0,0]}}", "no trial is possible"),
        (b"{\"reset\":{\"direction\":[1,0,0]}}", "a direction is that of an entry, which is missing"),
    ];
    for (line, sentence) in lines {
        let answer = held.ask_bytes(line);
        let error = answer["error"].as_str().unwrap_or_else(|| panic!("{answer}"));
        assert!(error.contains(sentence), "{error}");
        assert_eq!(held.ask(&observe), before, "{error}");
    }
    // Lines without anything have no answer; the next has.
    assert_eq!(held.ask_bytes(b"\r\n  \n{\"observe\":{}}"), before);
    held.end();
}

#[test]
fn what_is_held_by_another_has_no_log() {
    let output = lumen(&["trial", "sample:aorta", "--serve", "--log", "a.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("cannot be used with"));
}
