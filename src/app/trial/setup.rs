//! What a trial is to be: the wire, where it enters and should go, the seed.

use egui::{Button, ComboBox, DragValue, Role, Ui};

use super::action::{Action, Pick};
use crate::app::assist::name;
use crate::app::control::Setting;
use crate::app::row::{remark, row};
use crate::engine::trial::TrialReady;
use crate::trial::setup::{Entry, Setup};
use crate::trial::wire::Wire;

/// The wire's list and, folded up, its numbers. `proposed` is the one that is proposed, once the way is known.
pub(super) fn wire(ui: &mut Ui, setup: &mut Setup, proposed: Option<&Wire>) {
    // Nothing stands for the wire that is proposed.
    let before = (!setup.proposes_wire).then(|| setup.wire.name.clone());
    let mut chosen = before.clone();
    let known = before.as_ref().or(proposed.map(|wire| &wire.name));
    let shown = known.map_or("Proposed".to_owned(), |name| words(name));
    let help =
        "What the wire is made of, one that suits the way unless another is chosen; the numbers are in the fold below";
    row(ui, "Wire", help, |ui| {
        let list = ComboBox::from_id_salt("wire").width(128.0).height(300.0).selected_text(shown);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut chosen, None, "Proposed");
            for preset in Wire::names() {
                ui.selectable_value(&mut chosen, Some(preset.to_owned()), words(preset));
            }
        });
        name(&response.response, Role::ComboBox, "Wire");
    });
    if chosen != before {
        setup.proposes_wire = chosen.is_none();
        let preset = chosen.as_deref().and_then(Wire::preset);
        setup.wire = preset.or_else(|| proposed.cloned()).unwrap_or_default();
    }
    if setup.proposes_wire && proposed.is_none() {
        return;
    }
    let known = setup.wire.clone();
    ui.collapsing("Tip, stiffness, friction", |ui| numbers(ui, &mut setup.wire));
    // What is changed by hand is no longer what is proposed.
    setup.proposes_wire &= setup.wire == known;
}

/// A preset's name in words.
fn words(preset: &str) -> String {
    match preset {
        "floppy" => "0.014 in floppy".to_owned(),
        "workhorse" => "0.014 in workhorse".to_owned(),
        "stiff" => "0.014 in stiff".to_owned(),
        "workhorse-j" => "0.014 in J tip".to_owned(),
        "035-j" => "0.035 in J tip".to_owned(),
        "035-stiff-j" => "0.035 in stiff J".to_owned(),
        "035-angled" => "0.035 in angled, long bend".to_owned(),
        other => other.to_owned(),
    }
}

fn numbers(ui: &mut Ui, wire: &mut Wire) {
    let default = Wire::preset(&wire.name).unwrap_or_default();
    let setting = |name, help, unit, range, default, decimals, logarithmic| Setting {
        name,
        help,
        unit,
        range,
        default,
        decimals,
        logarithmic,
    };
    let bend = "The angle by which the tip is bent before it is let into the vessel";
    setting("Tip angle", bend, "°", 0.0..=200.0, default.bend_degrees, 0, false).show(ui, &mut wire.bend_degrees);
    let length = "Length of the bent tip, from its end";
    setting("Tip length", length, " mm", 1.0..=20.0, default.bend_mm, 1, false).show(ui, &mut wire.bend_mm);
    wire.straight_end_mm = wire.straight_end_mm.min(wire.bend_mm);
    let tip = "Bending stiffness EI at the tip";
    setting("Tip stiffness", tip, " N mm²", 0.01..=20.0, default.tip_ei, 2, true).show(ui, &mut wire.tip_ei);
    let shaft = "Bending stiffness EI of the shaft";
    setting("Shaft stiffness", shaft, " N mm²", 1.0..=1000.0, default.shaft_ei, 0, true).show(ui, &mut wire.shaft_ei);
    let friction =
        "Coefficient of friction while the wire sticks to the wall; while it slides it keeps its part of this";
    let part = default.friction[1] / default.friction[0];
    let mut sticking = wire.friction[0];
    if setting("Friction", friction, "", 0.0..=0.5, default.friction[0], 2, false).show(ui, &mut sticking) {
        wire.friction = [sticking, sticking * part];
    }
}

/// Where it enters and should go, of the places in `ready`, and the seed; `pick` is what the next click on the vessel
/// chooses. Another place than before begins anew.
pub(super) fn places(ui: &mut Ui, ready: &TrialReady, setup: &mut Setup, pick: Option<Pick>, asked: &mut Vec<Action>) {
    let (mut entry, mut target) = (setup.entry, setup.target);
    let chosen = entry.map_or("Proposed".to_owned(), |entry| place(entry.at));
    row(ui, "Entry", "Where the wire comes out of its sheath or guide catheter", |ui| {
        pick_button(ui, pick, Pick::Entry, asked);
        let list = ComboBox::from_id_salt("entry").width(112.0).selected_text(chosen);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut entry, None, "Proposed");
            for (i, other) in ready.entries.iter().enumerate() {
                let label = format!("{}: {}", i + 1, place(other.at));
                ui.selectable_value(&mut entry, Some(*other), label);
            }
        });
        name(&response.response, Role::ComboBox, "Entry");
    });
    let name_of = |at: [f32; 3]| ready.targets.iter().find(|(_, other)| *other == at).map(|(name, _)| name.clone());
    let chosen = target.map_or("Proposed".to_owned(), |at| name_of(at).unwrap_or_else(|| place(at)));
    row(ui, "Target", "Where it should go", |ui| {
        pick_button(ui, pick, Pick::Target, asked);
        let list = ComboBox::from_id_salt("target").width(112.0).selected_text(chosen);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut target, None, "Proposed");
            for (label, at) in &ready.targets {
                ui.selectable_value(&mut target, Some(*at), label);
            }
        });
        name(&response.response, Role::ComboBox, "Target");
    });
    if entry.map(key) != setup.entry.map(key) || target != setup.target {
        asked.push(Action::Restart);
    }
    (setup.entry, setup.target) = (entry, target);
    if let Some(pick) = pick {
        let what = if pick == Pick::Entry { "where the wire enters" } else { "where it should go" };
        remark(ui, &format!("Click the vessel {what}."));
    }
    row(ui, "Seed", "Varies entry, roll and friction a little; 0 varies nothing. Takes effect on restart", |ui| {
        let response = ui.add(DragValue::new(&mut setup.seed).range(0..=9999).update_while_editing(false));
        name(&response, Role::SpinButton, "Seed");
    });
}

fn key(entry: Entry) -> ([f32; 3], [f32; 3]) {
    (entry.at, entry.direction)
}

fn place(at: [f32; 3]) -> String {
    let [x, y, z] = at;
    format!("({x:.0}, {y:.0}, {z:.0}) mm")
}

fn pick_button(ui: &mut Ui, picked: Option<Pick>, pick: Pick, asked: &mut Vec<Action>) {
    let is_on = picked == Some(pick);
    let what = if pick == Pick::Entry { "entry" } else { "target" };
    let response = ui.add(Button::new("Pick").selected(is_on)).on_hover_text("Then click the vessel");
    name(&response, Role::Button, &format!("Pick {what}"));
    if response.clicked() {
        asked.push(Action::Pick((!is_on).then_some(pick)));
    }
}
