//! The controls of measuring: the tools, the clip plane, and the measures by their names.

use egui::{Button, Color32, ComboBox, RichText, Role, TextEdit, TextStyle, Ui, vec2};

use super::clip::{Across, Clip, branches};
use super::{Action as Asked, Measuring, Tool};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::control::Setting;
use crate::app::document::Document;
use crate::app::icon::{self, Icon};
use crate::app::mode::Now;
use crate::app::row::{remark, row, warning, wrapped};
use crate::app::state::State;
use crate::app::theme;
use crate::language::Key;
use crate::mesh::Vec3;
use crate::render::Camera;
use crate::say;
use crate::sharing::measures::Measure;

/// Height of what is seen of a measure that is looked at, in its own size, and at least in mm.
const SEEN: f32 = 4.0;
const MIN_SEEN_MM: f32 = 12.0;

/// Shows the controls; on a phone they take the place of the panel.
pub(super) fn show(ui: &mut Ui, measuring: &Measuring, now: Now<'_>, asked: &mut Vec<Action>) {
    let Now { state, camera, is_narrow, .. } = now;
    ui.spacing_mut().item_spacing.y = 4.0;
    let mut ask = |what: Asked| asked.push(Action::Measure(what));
    ui.horizontal(|ui| {
        ui.label(RichText::new(say!("measure-title")).heading());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let close = if is_narrow { say!("measure-back") } else { say!("measure-close") };
            if ui.button(close).on_hover_text(say!("measure-close-help")).clicked() {
                ask(Asked::Toggle);
            }
        });
    });
    let Some(document) = state.document.as_ref().filter(|document| document.shown.is_some()) else {
        remark(ui, &say!("measure-no-surface"));
        return;
    };
    tools(ui, measuring, &mut ask);
    ui.separator();
    clip_plane(ui, measuring, state, camera, document, &mut ask);
    ui.separator();
    list(ui, measuring, state, asked);
}

fn tools(ui: &mut Ui, measuring: &Measuring, ask: &mut impl FnMut(Asked)) {
    ui.horizontal_wrapped(|ui| {
        for tool in Tool::ALL {
            let is_taken = measuring.tool == Some(tool);
            let button = Button::new(tool.label().say()).selected(is_taken).min_size(vec2(0.0, 32.0));
            if ui.add(button).on_hover_text(tool.help().say()).clicked() {
                ask(Asked::Take((!is_taken).then_some(tool)));
            }
        }
    });
    match (&measuring.why, measuring.tool) {
        (Some(why), _) => warning(ui, why),
        (None, Some(tool)) => {
            let [click, tap] = tool.hint(measuring.begun.len());
            let hint = theme::by_hand(ui.ctx(), click, tap).say();
            // A finger has no keys.
            let told =
                if theme::suits_finger(ui.ctx()) { format!("{hint}.") } else { say!("measure-hint", hint = hint) };
            remark(ui, &told);
        }
        (None, None) => {
            remark(ui, &theme::by_hand(ui.ctx(), Key("measure-choose"), Key("measure-choose-touch")).say());
        }
    }
}

fn clip_plane(
    ui: &mut Ui,
    measuring: &Measuring,
    state: &State,
    camera: &Camera,
    document: &Document,
    ask: &mut impl FnMut(Asked),
) {
    let keep = state.settings.keep;
    let mut is_on = measuring.clip.is_some();
    if ui.checkbox(&mut is_on, say!("measure-clip")).on_hover_text(say!("measure-clip-help")).changed() {
        ask(Asked::Clip(is_on.then(|| Clip::middle(Across::Axis(2), document, keep))));
    }
    let Some(clip) = measuring.clip else { return };
    let mut across = clip.across;
    row(ui, &say!("measure-square-to"), &say!("measure-square-to-help"), |ui| {
        let list = ComboBox::from_id_salt("across").width(140.0).selected_text(across.label(document));
        let response = list.show_ui(ui, |ui| {
            let sight = Across::Direction(camera.rotation * Vec3::Z);
            let ways = (0..3).map(Across::Axis).chain([sight]);
            let of = branches(document).iter().filter(|branch| !branch.at_mm.is_empty());
            for way in ways.chain(of.map(|branch| Across::Branch(branch.number))) {
                ui.selectable_value(&mut across, way, way.label(document));
            }
        });
        name(&response.response, Role::ComboBox, &say!("measure-square-to"));
    });
    if across != clip.across {
        return ask(Asked::Clip(Some(Clip::middle(across, document, keep))));
    }
    let Some(placed) = clip.place(document, keep) else {
        return warning(ui, &say!("measure-lost-centreline"));
    };
    let [low, high] = placed.range_mm.map(f64::from);
    let mut at_mm = f64::from(clip.at_mm);
    let position = Setting {
        name: &say!("measure-position"),
        help: &say!("measure-position-help"),
        unit: " mm",
        range: low..=high,
        default: f64::midpoint(low, high),
        auto: None,
        decimals: 1,
        logarithmic: false,
    };
    if position.show(ui, &mut at_mm) {
        ask(Asked::Clip(Some(Clip { at_mm: at_mm as f32, ..clip })));
    }
    if ui.button(say!("measure-flip")).on_hover_text(say!("measure-flip-help")).clicked() {
        ask(Asked::Clip(Some(Clip { is_flipped: !clip.is_flipped, ..clip })));
    }
}

fn list(ui: &mut Ui, measuring: &Measuring, state: &State, asked: &mut Vec<Action>) {
    let mut marks = measuring.marks;
    let count = state.measures.len();
    ui.horizontal(|ui| {
        let title = if count == 0 { say!("measure-none") } else { say!("measure-measures") };
        ui.label(RichText::new(title).strong());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let marked = ui.checkbox(&mut marks, say!("measure-in-views")).on_hover_text(say!("measure-in-views-help"));
            if marked.changed() {
                asked.push(Action::Measure(Asked::Mark(marks)));
            }
        });
    });
    if count == 0 {
        remark(ui, &say!("measure-kept"));
    }
    for (i, measure) in state.measures.iter().enumerate() {
        ui.push_id(i, |ui| one(ui, i, measure, measuring.chosen == Some(i), asked));
    }
}

fn one(ui: &mut Ui, i: usize, measure: &Measure, is_chosen: bool, asked: &mut Vec<Action>) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        // Beside two buttons, one of them a word of 34 points in English.
        let (show, font) = (say!("measure-show"), TextStyle::Button.resolve(ui.style()));
        let word = ui.painter().layout_no_wrap(show.clone(), font, Color32::PLACEHOLDER).size().x.max(34.0);
        let room =
            ui.available_width() - 16.0 - word - 2.0 * ui.spacing().button_padding.x - theme::row(ui.ctx(), 20.0);
        let mut text = measure.name.clone();
        let field = ui.add(TextEdit::singleline(&mut text).desired_width(room.max(60.0)).char_limit(60));
        let field = field.on_hover_text(say!("measure-name-help"));
        name(&field, Role::TextInput, &say!("measure-name-of", number = i + 1));
        if field.changed() {
            asked.push(Action::Measure(Asked::Rename(i, text)));
        }
        let look = ui.add(Button::new(show).selected(is_chosen));
        let look = look.on_hover_text(say!("measure-show-help"));
        name(&look, Role::Button, &say!("measure-show-named", name = &measure.name));
        if look.clicked() {
            let (at, reach) = measure.extent();
            let height_mm = (SEEN * reach).max(MIN_SEEN_MM);
            asked.push(Action::Measure(Asked::Look(i)));
            asked.push(Action::LookAt { at_mm: at.into(), height_mm });
        }
        let label = say!("measure-delete-named", name = &measure.name);
        if icon::button(ui, Icon::Close, true, &label, &say!("measure-delete")).clicked() {
            asked.push(Action::Measure(Asked::Delete(i)));
        }
    });
    wrapped(ui, &measure.value(), |text| text);
    wrapped(ui, &measure.made(), |text| text.small().weak());
}
