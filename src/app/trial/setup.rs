//! What a trial is to be: the wire, where it enters and should go, the seed.

use std::ops::RangeInclusive;

use egui::{Button, CollapsingHeader, ComboBox, DragValue, Role, Ui, Vec2};

use super::action::{Action, Pick};
use crate::app::assist::name;
use crate::app::control::{Setting, reads_comma};
use crate::app::row::{remark, row};
use crate::app::theme;
use crate::engine::trial::TrialReady;
use crate::language::{Key, tell};
use crate::mesh::Vec3;
use crate::say;
use crate::trial::setup::{Entry, Setup};
use crate::trial::wire::Wire;

/// The wire's list and, folded up, its numbers. `proposed` is the one that is proposed, once the way is known.
pub(super) fn wire(ui: &mut Ui, setup: &mut Setup, proposed: Option<&Wire>) {
    // Nothing stands for the wire that is proposed.
    let before = (!setup.proposes_wire).then(|| setup.wire.name.clone());
    let mut chosen = before.clone();
    let known = before.as_ref().or(proposed.map(|wire| &wire.name));
    let shown = known.map_or(say!("trial-proposed"), |name| words(name));
    let label = say!("trial-wire");
    row(ui, &label, &say!("trial-wire-help"), |ui| {
        let list = ComboBox::from_id_salt("wire").width(128.0).height(300.0).selected_text(shown);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut chosen, None, say!("trial-proposed"));
            for preset in Wire::names() {
                ui.selectable_value(&mut chosen, Some(preset.to_owned()), words(preset));
            }
        });
        name(&response.response, Role::ComboBox, &label);
    });
    if chosen != before {
        setup.proposes_wire = chosen.is_none();
        setup.next_wires.clear();
        let preset = chosen.as_deref().and_then(Wire::preset);
        setup.wire = preset.or_else(|| proposed.cloned()).unwrap_or_default();
    }
    if setup.proposes_wire && proposed.is_none() {
        return;
    }
    let known = setup.wire.clone();
    let fold = CollapsingHeader::new(say!("trial-wire-numbers")).id_salt("wire numbers");
    fold.show(ui, |ui| numbers(ui, &mut setup.wire));
    // What is changed by hand is no longer what is proposed.
    if setup.wire != known {
        setup.proposes_wire = false;
        setup.next_wires.clear();
    }
}

/// A preset's name in words.
pub(super) fn words(preset: &str) -> String {
    match preset {
        "floppy" => say!("trial-wire-floppy"),
        "workhorse" => say!("trial-wire-workhorse"),
        "stiff" => say!("trial-wire-stiff"),
        "workhorse-j" => say!("trial-wire-workhorse-j"),
        "035-j" => say!("trial-wire-035-j"),
        "035-stiff-j" => say!("trial-wire-035-stiff-j"),
        "035-angled-20" => say!("trial-wire-035-angled-20"),
        "035-curve" => say!("trial-wire-035-curve"),
        "035-angled" => say!("trial-wire-035-angled"),
        other => other.to_owned(),
    }
}

fn numbers(ui: &mut Ui, wire: &mut Wire) {
    let default = Wire::preset(&wire.name).unwrap_or_default();
    let words = [say!("trial-tip-angle"), say!("trial-tip-angle-help")];
    setting(&words, "°", 0.0..=200.0, default.bend_degrees, 0, false).show(ui, &mut wire.bend_degrees);
    let words = [say!("trial-tip-length"), say!("trial-tip-length-help")];
    setting(&words, " mm", 1.0..=40.0, default.bend_mm, 1, false).show(ui, &mut wire.bend_mm);
    wire.straight_end_mm = wire.straight_end_mm.min(wire.bend_mm);
    let words = [say!("trial-tip-stiffness"), say!("trial-tip-stiffness-help")];
    setting(&words, " N mm²", 0.01..=20.0, default.tip_ei, 2, true).show(ui, &mut wire.tip_ei);
    let words = [say!("trial-shaft-stiffness"), say!("trial-shaft-stiffness-help")];
    setting(&words, " N mm²", 1.0..=1000.0, default.shaft_ei, 0, true).show(ui, &mut wire.shaft_ei);
    let words = [say!("trial-friction"), say!("trial-friction-help")];
    let part = default.friction[1] / default.friction[0];
    let mut sticking = wire.friction[0];
    if setting(&words, "", 0.0..=0.5, default.friction[0], 2, false).show(ui, &mut sticking) {
        wire.friction = [sticking, sticking * part];
    }
}

/// A number of the wire: its name and what it does, its unit, what can be set, and the preset's.
fn setting<'a>(
    [name, help]: &'a [String; 2],
    unit: &'a str,
    range: RangeInclusive<f64>,
    default: f64,
    decimals: usize,
    logarithmic: bool,
) -> Setting<'a> {
    Setting { name, help, unit, range, default, auto: None, decimals, logarithmic }
}

/// Where it enters and should go, of the places in `ready`, and the seed; `pick` is what the next click on the vessel
/// chooses. Another place than before begins anew.
pub(super) fn places(ui: &mut Ui, ready: &TrialReady, setup: &mut Setup, pick: Option<Pick>, asked: &mut Vec<Action>) {
    let (mut entry, mut target) = (setup.entry, setup.target);
    let name_of = |at: Entry| ready.entries.iter().find(|(_, other)| key(*other) == key(at)).map(|(name, _)| name);
    let called = |at: Entry| name_of(at).map_or_else(|| place(at.at), |name| tell(&name.label()));
    let chosen = entry.map_or(say!("trial-proposed"), called);
    let label = say!("trial-entry");
    row(ui, &label, &say!("trial-entry-help"), |ui| {
        pick_button(ui, pick, Pick::Entry, asked);
        let list = ComboBox::from_id_salt("entry").width(112.0).selected_text(chosen);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut entry, None, say!("trial-proposed"));
            for (name, other) in &ready.entries {
                ui.selectable_value(&mut entry, Some(*other), tell(&name.label()));
            }
        });
        name(&response.response, Role::ComboBox, &label);
    });
    let name_of = |at: [f32; 3]| ready.targets.iter().find(|(_, other)| *other == at).map(|(name, _)| name);
    let called = |at: [f32; 3]| name_of(at).map_or_else(|| place(at), |name| tell(&name.label()));
    let chosen = target.map_or(say!("trial-proposed"), called);
    let label = say!("trial-target");
    row(ui, &label, &say!("trial-target-help"), |ui| {
        pick_button(ui, pick, Pick::Target, asked);
        let list = ComboBox::from_id_salt("target").width(112.0).selected_text(chosen);
        let response = list.show_ui(ui, |ui| {
            ui.selectable_value(&mut target, None, say!("trial-proposed"));
            for (name, at) in &ready.targets {
                ui.selectable_value(&mut target, Some(*at), tell(&name.label()));
            }
        });
        name(&response.response, Role::ComboBox, &label);
    });
    let other_way = swapped(ready, entry, target);
    row(ui, &say!("trial-direction"), &say!("trial-direction-help"), |ui| {
        let swap = ui.add_enabled(other_way.is_some(), Button::new(say!("trial-swap")));
        let swap = swap.on_hover_text(say!("trial-swap-help"));
        if swap.on_disabled_hover_text(say!("trial-swap-refused")).clicked() {
            (entry, target) = other_way.map_or((entry, target), |(entry, target)| (Some(entry), Some(target)));
        }
    });
    if entry.map(key) != setup.entry.map(key) || target != setup.target {
        asked.push(Action::Restart);
    }
    (setup.entry, setup.target) = (entry, target);
    if let Some(pick) = pick {
        let (by_mouse, by_finger) = match pick {
            Pick::Entry => (Key("trial-click-entry"), Key("trial-click-entry-touch")),
            Pick::Target => (Key("trial-click-target"), Key("trial-click-target-touch")),
        };
        remark(ui, &theme::by_hand(ui.ctx(), by_mouse, by_finger).say());
    }
    let label = say!("trial-seed");
    row(ui, &label, &say!("trial-seed-help"), |ui| {
        let field = reads_comma(DragValue::new(&mut setup.seed), true).range(0..=9999).update_while_editing(false);
        let response = ui.add(field);
        name(&response, Role::SpinButton, &label);
    });
}

/// An entry where the target is, if a wire could come in there, and a target where it came in.
fn swapped(ready: &TrialReady, entry: Option<Entry>, target: Option<[f32; 3]>) -> Option<(Entry, [f32; 3])> {
    /// Targets and entries of one end lie no farther apart than this, in mm.
    const SAME: f32 = 5.0;
    let from = entry.or(ready.setup.entry)?;
    let to = Vec3::from(target.or(ready.setup.target)?);
    let distance = |entry: &Entry| Vec3::from(entry.at).distance(to);
    let there = ready.entries.iter().map(|(_, entry)| *entry).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(&there) <= SAME).then_some((there, from.at))
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
    let what = match pick {
        Pick::Entry => say!("trial-pick-entry"),
        Pick::Target => say!("trial-pick-target"),
    };
    let least = Vec2::splat(theme::row(ui.ctx(), 0.0));
    let button = Button::new(say!("trial-pick")).selected(is_on).min_size(least);
    let response = ui.add(button).on_hover_text(say!("trial-pick-help"));
    name(&response, Role::Button, &what);
    if response.clicked() {
        asked.push(Action::Pick((!is_on).then_some(pick)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::route::PlaceName;
    use crate::trial::setup::Setup;

    #[test]
    fn entry_and_target_change_places_where_a_wire_could_come_in() {
        let entry = |z: f32| Entry { at: [0.0, 0.0, z], direction: [0.0, 0.0, if z > 50.0 { -1.0 } else { 1.0 }] };
        let named = |z: f32| (PlaceName::Own, entry(z));
        let setup = Setup { entry: Some(entry(3.0)), target: Some([0.0, 1.0, 98.0]), ..Setup::default() };
        let ready = TrialReady { setup, entries: vec![named(3.0), named(97.0)], ..TrialReady::default() };
        assert_eq!(swapped(&ready, None, None), Some((entry(97.0), [0.0, 0.0, 3.0])));
        assert_eq!(swapped(&ready, None, Some([30.0, 0.0, 50.0])), None, "no vessel ends there");
    }
}
