//! The verdict as it is shown: a strip above the views, of the same height whatever it says.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align, Color32, Context, FontSelection, Id, Layout, RichText, Role, Shape, Stroke, Ui, Vec2, pos2, vec2};

use super::findings::{look, take, verdict};
use crate::app::action::Action;
use crate::app::assist::name;
use crate::app::explain::explain;
use crate::app::menus::card;
use crate::app::options::{Colours, ViewOptions};
use crate::app::row::wrapped;
use crate::app::state::State;
use crate::app::theme;
use crate::app::vessels;
use crate::language::tell;
use crate::pipeline::settings::Settings;
use crate::pipeline::verdict::{Finding, FindingKind, Head, HeadText, Verdict};
use crate::say;
use crate::vessel::certificate::ENOUGH_PERCENT;

/// What findings are of: the number of the surface, and the settings.
type Of = (u64, Settings);

/// Opens the vessels with what is not measured.
const SHOW_UNMEASURED: Action = Action::Vessels(vessels::Action::ShowUnmeasured);

/// Width of the list of what was found, in points.
const WIDEST: f32 = 320.0;

/// Height of a line where a mouse points, in points.
const LINE: f32 = 24.0;

/// Where the strip stands.
#[derive(Clone, Copy)]
pub(in crate::app) struct Strip {
    /// In the window of a phone: the sentence has a line of its own.
    pub(in crate::app) is_narrow: bool,
    /// In a part of another page, which has no panels to open: it goes to the place alone.
    pub(in crate::app) is_part: bool,
    /// In a low part: the sentence has what is left of the line, however narrow.
    pub(in crate::app) is_low: bool,
}

impl Strip {
    /// Whether the sentence has a line of its own.
    fn has_two_lines(self) -> bool {
        self.is_narrow && !self.is_low
    }

    /// Its height, in points.
    pub(in crate::app) fn height(self, ctx: &Context) -> f32 {
        theme::row(ctx, LINE) + if self.has_two_lines() { LINE } else { 0.0 }
    }
}

/// Shows the verdict on what is shown, and says what is asked for there.
pub(in crate::app) fn show(ui: &mut Ui, state: &State, options: ViewOptions, strip: Strip, asked: &mut Vec<Action>) {
    let Strip { is_narrow, is_part, is_low } = strip;
    let Some(document) = &state.document else { return };
    let verdict = verdict(state, document);
    let first = verdict.findings.first().filter(|finding| finding.is_grave);
    let coverage = match verdict.head_text() {
        HeadText::Covered { coverage, .. } => Some(tell(&coverage)),
        HeadText::Alone(_) => None,
    };
    let text = match (first, &verdict.calibre) {
        (Some(finding), _) => tell(&finding.what),
        (None, Some(calibre)) => tell(calibre),
        (None, None) if state.is_deciding() && state.has_level() => say!("verdict-auto-follows"),
        (None, None) if state.is_measuring() => say!("verdict-follows"),
        (None, None) => say!("verdict-stopped"),
    };
    let text = if state.shows_sample() { say!("verdict-sample", text = text) } else { text };
    // Where the sentence is cut off, how much is measured comes first.
    let is_short = is_narrow || is_low;
    let text = coverage.as_ref().filter(|_| is_short).map_or_else(|| text.clone(), |part| format!("{part}. {text}"));
    ui.spacing_mut().item_spacing.y = 0.0;
    let line = theme::row(ui.ctx(), LINE);
    ui.spacing_mut().interact_size.y = line;
    ui.allocate_ui_with_layout(vec2(ui.available_width(), line), Layout::left_to_right(Align::Center), |ui| {
        mark(ui, verdict.head);
        ui.label(RichText::new(tell(&verdict.head)).strong());
        if let Some(coverage) = coverage.as_ref().filter(|_| !is_short) {
            let link = egui::Button::new(RichText::new(coverage).color(ui.visuals().hyperlink_color)).frame(false);
            if is_part {
                ui.label(coverage);
            } else if ui
                .add(link)
                .on_hover_text(say!("verdict-show-unmeasured-help", percent = ENOUGH_PERCENT))
                .clicked()
            {
                asked.push(SHOW_UNMEASURED);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if is_part {
                first.into_iter().for_each(|finding| go(ui, state, finding, asked));
            } else {
                buttons(
                    ui,
                    state,
                    (&verdict, (document.revision.document, state.settings.clone())),
                    first,
                    is_narrow,
                    asked,
                );
            }
            if !strip.has_two_lines() {
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| sentence(ui, &text));
            }
        });
    });
    // What is not measured has a colour of its own.
    if asked.contains(&SHOW_UNMEASURED) && options.colours != Colours::Calibre {
        asked.push(Action::Show(ViewOptions { colours: Colours::Calibre, ..options }));
    }
    if strip.has_two_lines() {
        sentence(ui, &text);
    }
}

/// From right to left. In a narrow window there is room for the place alone: what may help is in the list, beside the whole
/// of the sentence.
fn buttons(
    ui: &mut Ui,
    state: &State,
    (verdict, of): (&Verdict, Of),
    first: Option<&Finding>,
    is_narrow: bool,
    asked: &mut Vec<Action>,
) {
    let count = verdict.findings.len();
    let words = match first {
        Some(_) if is_narrow => say!("verdict-what-to-do"),
        Some(_) => say!("verdict-findings"),
        None => say!("verdict-notes", count = count),
    };
    if count > 0 {
        let id = Id::unique("findings");
        card(ui, id, &words, WIDEST, &mut |ui, opens| {
            // As they were when it opened, for as long as they are of this surface and these settings: a button does not move
            // under the pointer.
            let kept = ui.data(|data| data.get_temp::<(Of, Arc<Verdict>)>(id));
            let kept = kept.filter(|(kept_of, _)| !opens && *kept_of == of);
            let kept = kept.map_or_else(|| Arc::new(verdict.clone()), |(_, kept)| kept);
            ui.data_mut(|data| data.insert_temp(id, (of.clone(), kept.clone())));
            let before = asked.len();
            if kept.head == Head::KeptWhereMeasured {
                wrapped(ui, &say!("verdict-enough", percent = ENOUGH_PERCENT), |text| text.small().weak());
                if is_narrow {
                    unmeasured(ui, asked);
                }
                ui.separator();
            }
            list(ui, state, &kept.findings, asked);
            if asked.len() > before {
                ui.close();
            }
        });
    }
    match first {
        Some(finding) if is_narrow => go(ui, state, finding, asked),
        Some(finding) => act(ui, state, finding, asked),
        // Beside the list a phone has no room for it.
        None if verdict.head == Head::KeptWhereMeasured && is_narrow && count > 0 => {}
        None if verdict.head == Head::KeptWhereMeasured => unmeasured(ui, asked),
        None => {
            let vessels = ui.add_enabled(verdict.calibre.is_some(), egui::Button::new(say!("verdict-show-vessels")));
            if vessels.on_hover_text(say!("verdict-show-vessels-help")).clicked() {
                asked.push(Action::Vessels(vessels::action::Action::Toggle));
            }
        }
    }
}

/// The way to what is not measured.
fn unmeasured(ui: &mut Ui, asked: &mut Vec<Action>) {
    let show = ui.button(say!("verdict-show-unmeasured"));
    if show.on_hover_text(say!("verdict-show-unmeasured-help", percent = ENOUGH_PERCENT)).clicked() {
        asked.push(SHOW_UNMEASURED);
    }
}

/// All that was found and what can be done about it, what is grave apart from the rest.
fn list(ui: &mut Ui, state: &State, findings: &[Finding], asked: &mut Vec<Action>) {
    let grave = findings.iter().filter(|finding| finding.is_grave).count();
    let parts = [(say!("verdict-list-grave"), &findings[..grave]), (say!("verdict-list-notes"), &findings[grave..])];
    ui.spacing_mut().item_spacing.y = theme::GRID;
    for (i, (title, part)) in parts.iter().filter(|(_, part)| !part.is_empty()).enumerate() {
        if i > 0 {
            ui.separator();
        }
        if (1..findings.len()).contains(&grave) {
            ui.label(RichText::new(title).small().weak());
        }
        for finding in *part {
            wrapped(ui, &tell(&finding.what), |text| text);
            let leads = finding.place.is_some() || matches!(finding.what, FindingKind::LeftOut { .. });
            if leads || !finding.remedies.is_empty() {
                ui.horizontal_wrapped(|ui| act(ui, state, finding, asked));
            }
        }
    }
}

/// What can be done about a finding.
fn act(ui: &mut Ui, state: &State, finding: &Finding, asked: &mut Vec<Action>) {
    go(ui, state, finding, asked);
    for remedy in &finding.remedies {
        if ui.button(tell(&remedy.label)).on_hover_text(say!("verdict-remedy-help")).clicked() {
            asked.push(take(remedy));
        }
    }
    if let FindingKind::LeftOut { .. } = finding.what
        && ui.button(say!("verdict-choose-pieces")).on_hover_text(say!("verdict-choose-pieces-help")).clicked()
    {
        asked.push(Action::ChoosePieces);
    }
}

/// The way to its place, where it has one.
fn go(ui: &mut Ui, state: &State, finding: &Finding, asked: &mut Vec<Action>) {
    if let Some(place) = look(state, finding)
        && ui.button(say!("verdict-show-place")).on_hover_text(say!("verdict-show-place-help")).clicked()
    {
        asked.push(place);
    }
}

/// A sentence in as much of a line as there is; whole under the pointer and for assistive tools.
fn sentence(ui: &mut Ui, text: &str) {
    let font = FontSelection::from(egui::TextStyle::Body).resolve(ui.style());
    let colour = ui.visuals().text_color();
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, ui.available_width());
    job.wrap = TextWrapping { max_rows: 1, break_anywhere: true, ..job.wrap };
    let galley = ui.painter().layout_job(job);
    let size = vec2(ui.available_width(), LINE);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let is_cut = galley.elided;
    ui.painter().galley(pos2(rect.left(), rect.center().y - galley.size().y / 2.0), galley, colour);
    name(&response, Role::Label, text);
    if is_cut {
        explain(response, text);
    }
}

/// A tick, an exclamation mark, a disc half full where too little is measured to say, or an empty ring while nothing is known:
/// shape and colour say the same.
fn mark(ui: &mut Ui, head: Head) {
    let (rect, _) = ui.allocate_exact_size(vec2(18.0, 18.0), egui::Sense::hover());
    let (middle, painter, visuals) = (rect.center(), ui.painter(), ui.visuals());
    match head {
        Head::Safe => {
            painter.circle_filled(middle, 8.0, visuals.hyperlink_color);
            let tick = [pos2(-3.8, 0.2), pos2(-1.2, 2.8), pos2(3.8, -2.6)].map(|p| middle + p.to_vec2());
            painter.add(Shape::line(tick.to_vec(), Stroke::new(2.0, visuals.selection.stroke.color)));
        }
        Head::ToLookAt { .. } => {
            let on = visuals.panel_fill;
            painter.circle_filled(middle, 8.0, visuals.error_fg_color);
            painter.line_segment([middle + vec2(0.0, -4.2), middle + vec2(0.0, 1.0)], Stroke::new(2.0, on));
            painter.circle(middle + vec2(0.0, 4.0), 1.2, on, Stroke::new(0.0, Color32::TRANSPARENT));
        }
        Head::KeptWhereMeasured | Head::NoneMeasured => {
            let colour = visuals.warn_fg_color;
            painter.circle_stroke(middle, 7.25, Stroke::new(1.5, colour));
            if head == Head::KeptWhereMeasured {
                let half = (0..=16).map(|i| middle + 7.25 * Vec2::angled(std::f32::consts::PI * i as f32 / 16.0));
                painter.add(Shape::convex_polygon(half.collect(), colour, Stroke::NONE));
            }
        }
        Head::NotMeasured | Head::Coming => {
            painter.circle_stroke(middle, 7.0, Stroke::new(1.5, visuals.weak_text_color()));
        }
    }
}
