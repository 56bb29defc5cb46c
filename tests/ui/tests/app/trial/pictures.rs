//! Pictures of the trial, to look at.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::phantom::Sample;
use lumen_ui_tests::told::{App, DESKTOP, PHONE, as_the_paper, open_coronary, press, start, wait};
use lumen_ui_tests::{app, seen, settle};

use super::ADAPT;

/// Leaves pictures to look at in the target folder's `tmp`: all of them with `cargo xtask test --long`, else the phone's.
#[test]
fn pictures_of_the_trial() {
    let phone = [(PHONE, "phone", Sample::Aorta)].into_iter();
    let desktop = [Sample::Aorta, Sample::Coronary].map(|sample| (DESKTOP, "desktop", sample)).into_iter();
    for (size, name, sample) in phone.chain(desktop.filter(|_| lumen_test_support::is_long())) {
        let (mut harness, memory) = seen(|| app(size));
        settle(&mut harness);
        if sample == Sample::Coronary {
            open_coronary(&mut harness);
            as_the_paper(&mut harness);
        }
        memory.borrow_mut().trial_runs = true;
        start(&mut harness);
        harness.run_steps(5);
        if sample == Sample::Coronary {
            save(&mut harness, &format!("trial-{name}-{sample}-refused"));
            press(&mut harness, ADAPT);
            wait(&mut harness, |harness| harness.state().trial().session().is_some());
        }
        press(&mut harness, "Autopilot");
        harness.run_steps(600);
        save(&mut harness, &format!("trial-{name}-{sample}-on"));
        harness.key_press(Key::C);
        harness.key_press(Key::Num4);
        harness.run_steps(8);
        save(&mut harness, &format!("trial-{name}-{sample}-contrast"));
        harness.key_press(Key::F);
        harness.run_steps(8);
        save(&mut harness, &format!("trial-{name}-{sample}-large"));
        harness.key_press(Key::F);
        harness.run_steps(8);
        harness.get_by_role_and_label(Role::CheckBox, "Roadmap").scroll_to_me();
        harness.run_steps(12);
        harness.get_by_role_and_label(Role::CheckBox, "Roadmap").click();
        harness.ctx.set_theme(egui::Theme::Light);
        harness.run_steps(60);
        save(&mut harness, &format!("trial-{name}-{sample}-roadmap"));
        press(&mut harness, "Compare with the unreduced surface");
        harness.run_steps(5);
        save(&mut harness, &format!("trial-{name}-{sample}-comparing"));
        wait(&mut harness, |harness| !harness.state().trial().is_busy());
        harness.run_steps(5);
        save(&mut harness, &format!("trial-{name}-{sample}-compared"));
        press(&mut harness, "Tables III and IV");
        harness.run_steps(60);
        save(&mut harness, &format!("trial-{name}-{sample}-tables"));
    }
}

fn save(harness: &mut App, name: &str) {
    let picture = harness.render().unwrap();
    let colours: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 200, "{}", colours.len());
    crate::save(name, [picture.width(), picture.height()], picture.as_raw());
}
