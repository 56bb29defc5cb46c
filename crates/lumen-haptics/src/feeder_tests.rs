//! The open feeder's descriptor, read by others.

use crate::descriptor::parse;
use crate::feeder::{DESCRIPTOR, HALF_WAY, id};
use crate::fixtures::{chromium, peer};
use crate::model::{Kind, Report};
use crate::usage::desktop;
use crate::webhid;

#[test]
fn it_says_what_the_firmware_sends_and_takes() {
    let model = parse(DESCRIPTOR).unwrap();
    let bytes = |kind, id| model.report(kind, id).map_or(0, Report::bytes);
    assert_eq!([1, 2].map(|id| bytes(Kind::Input, id)), [5, 1]);
    assert_eq!([1, 2, 3, 4, 5, 6, 7].map(|id| bytes(Kind::Output, id)), [9, 14, 3, 3, 1, 1, 1]);
    assert_eq!([0x11, 0x12, 0x13].map(|id| bytes(Kind::Feature, id)), [3, 4, 4]);
    let state = model.report(Kind::Input, id::STATE).unwrap();
    let feed = state.find(desktop::X).unwrap().field;
    assert_eq!((feed.to_physical(32767), feed.unit_exponent), (50.0, -1));
    let roll = state.find(desktop::RX).unwrap().field;
    assert!((roll.to_physical(32767) * 1e-2 - HALF_WAY[1]).abs() < 0.01);
}

#[test]
fn others_read_it_the_same() {
    let model = parse(DESCRIPTOR).unwrap();
    assert_eq!(webhid::model(&chromium(DESCRIPTOR)).unwrap(), model);
    assert_eq!(peer(DESCRIPTOR), crate::fixtures::elements(&model));
}

/// The device that the browser's tests put into the page (tests/browser/fake-hid.js) has this file.
#[test]
fn the_browser_s_tests_have_what_chromium_tells_of_it() {
    let file: serde_json::Value = serde_json::from_str(include_str!("../fixtures/feeder-collections.json")).unwrap();
    let told = serde_json::to_value(chromium(DESCRIPTOR)).unwrap();
    assert!(file == told, "it should be:\n{told}");
}
