//! The rows of the panel: the head of a step, a control with its label, a number, a remark.

use egui::collapsing_header::{CollapsingState, paint_default_icon};
use egui::{
    Align, CollapsingHeader, Context, Id, Label, Layout, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, vec2,
};

use super::assist::{heading, name};
use super::explain::explain;
use super::theme;
use crate::say;

/// Room that a column leaves at its right for the scroll bar, in points.
const SCROLL_BAR: f32 = 8.0;

/// A column that scrolls.
pub(super) fn scrolled<R>(ui: &mut Ui, show: impl FnOnce(&mut Ui) -> R) -> R {
    let column = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // Room for the scroll bar beside what stands at the right.
        ui.set_max_width(ui.available_width() - SCROLL_BAR);
        close(ui);
        show(ui)
    });
    column.inner
}

/// What stands above a column that scrolls, as wide as the column; says how high it is, in points.
pub(super) fn docked(ui: &mut Ui, show: impl FnOnce(&mut Ui)) -> f32 {
    let shown = ui.scope(|ui| {
        ui.set_max_width(ui.available_width() - SCROLL_BAR);
        close(ui);
        show(ui);
    });
    shown.response.rect.height()
}

/// Rows stand close to one another.
fn close(ui: &mut Ui) {
    ui.spacing_mut().item_spacing.y = 3.0;
}

/// A step of the method that folds.
pub(super) struct Fold<'a> {
    /// Its number.
    pub(super) number: u32,
    /// Its name.
    pub(super) title: &'a str,
    /// What it does.
    pub(super) what: &'a str,
    /// What there is to say of it while it is folded.
    pub(super) summary: RichText,
    /// Whether it is unfolded at first.
    pub(super) is_open: bool,
}

impl Fold<'_> {
    /// Shows the head, and what is in it while it is unfolded.
    pub(super) fn show(self, ui: &mut Ui, body: impl FnOnce(&mut Ui)) {
        if self.number > 1 {
            ui.separator();
        }
        let id = ui.make_persistent_id("fold");
        let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, self.is_open);
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), ui.spacing().interact_size.y), Sense::click());
        if response.clicked() {
            state.toggle(ui);
        }
        let asked = Part::ALL.into_iter().filter(|part| part.step() == self.number && part.is_asked(ui));
        let asked: Vec<Part> = asked.collect();
        if !asked.is_empty() {
            state.set_open(true);
        }
        name(&response, Role::DisclosureTriangle, self.title);
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_expanded(state.is_open()));
        let indent = ui.spacing().indent;
        let icon = Rect::from_center_size(rect.left_center() + vec2(indent / 2.0, 0.0), Vec2::splat(10.0));
        paint_default_icon(ui, state.openness(ui.ctx()), &response.clone().with_new_rect(icon));
        let inside = UiBuilder::new().max_rect(rect.with_min_x(rect.left() + indent));
        ui.scope_builder(inside.layout(Layout::left_to_right(Align::Center)), |ui| {
            number_and_title(ui, self.number, self.title);
            if !state.is_open() {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.add(Label::new(self.summary.small()).truncate());
                });
            }
        });
        if response.has_focus() {
            let ring = Stroke::new(2.0, ui.visuals().hyperlink_color);
            ui.painter().rect_stroke(rect, 4.0, ring, StrokeKind::Inside);
        }
        state.show_body_unindented(ui, |ui| {
            wrapped(ui, self.what, |text| text.small().weak());
            body(ui);
            // Whether it was there or not: what a filter of no iterations lets through is not shown.
            ui.data_mut(|data| asked.into_iter().for_each(|part| data.remove::<bool>(part.id())));
        });
    }
}

/// A part of a step that is folded at first, and that a lesson may talk about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// What the filter lets through.
    Response,
    /// The error against the number of triangles.
    Error,
    /// The step for a solver, all of it.
    Solver,
}

impl Part {
    /// The number of the step that it is in.
    fn step(self) -> u32 {
        match self {
            Self::Response => 2,
            Self::Error => 3,
            Self::Solver => 5,
        }
    }

    const ALL: [Self; 3] = [Self::Response, Self::Error, Self::Solver];

    fn id(self) -> Id {
        Id::unique(("part to be unfolded", self.salt()))
    }

    /// Lets it be unfolded, with its step, and scrolled to when it is next shown.
    pub(super) fn unfold(self, ctx: &Context) {
        ctx.data_mut(|data| data.insert_temp(self.id(), true));
    }

    /// Unfolds nothing more.
    pub(super) fn forget(ctx: &Context) {
        ctx.data_mut(|data| Self::ALL.into_iter().for_each(|part| data.remove::<bool>(part.id())));
    }

    fn is_asked(self, ui: &Ui) -> bool {
        ui.data(|data| data.get_temp(self.id())).unwrap_or(false)
    }

    /// Shows it: its head, and what is in it while it is unfolded.
    pub(super) fn show(self, ui: &mut Ui, title: String, body: impl FnOnce(&mut Ui)) -> Response {
        let is_asked = self.is_asked(ui);
        let header = CollapsingHeader::new(title).id_salt(self.salt()).open(is_asked.then_some(true));
        let head = header.show_unindented(ui, body).header_response;
        if is_asked {
            head.scroll_to_me(Some(Align::Center));
        }
        head
    }

    fn salt(self) -> &'static str {
        match self {
            Self::Response => "Response",
            Self::Error => "Error against triangles",
            Self::Solver => "For a solver",
        }
    }
}

/// What experts alone change of the step `title`, folded at first.
pub(super) fn advanced(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    let words = say!("panel-advanced");
    let head = CollapsingHeader::new(&words).id_salt("advanced").show_unindented(ui, body);
    // Each step has one.
    name(&head.header_response, Role::DisclosureTriangle, &say!("panel-advanced-of", step = title));
    head.header_response.on_hover_text(say!("panel-advanced-help"));
}

/// The paper's equations of the step `title`, folded at first.
pub(super) fn formulas(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    let head = CollapsingHeader::new(say!("panel-equations")).id_salt("equations").show_unindented(ui, body);
    // Two steps have some.
    name(&head.header_response, Role::DisclosureTriangle, &say!("panel-equations-of", step = title));
    head.header_response.on_hover_text(say!("panel-equations-help"));
}

/// The number and the name of a step.
pub(super) fn title(ui: &mut Ui, number: u32, title: &str) {
    ui.horizontal(|ui| number_and_title(ui, number, title));
}

fn number_and_title(ui: &mut Ui, number: u32, title: &str) {
    ui.label(RichText::new(number.to_string()).heading().color(ui.visuals().hyperlink_color));
    heading(ui, title);
}

/// The head of a step of the method: its number and name, and what it does.
pub(super) fn step(ui: &mut Ui, number: u32, name: &str, what: &str) {
    if number > 1 {
        ui.separator();
    }
    title(ui, number, name);
    wrapped(ui, what, |text| text.small().weak());
}

/// What on the left, the control on the right.
pub(super) fn row(ui: &mut Ui, what: &str, help: &str, control: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        explain(ui.label(what), help);
        ui.with_layout(Layout::right_to_left(Align::Center), control);
    });
}

/// A line of the numbers: what it is on the left, how much on the right.
pub(super) fn number(ui: &mut Ui, what: &str, how_much: &str, help: &str) {
    let before = std::mem::replace(&mut ui.spacing_mut().interact_size.y, 18.0);
    let row = ui.horizontal(|ui| {
        ui.label(RichText::new(what).weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(how_much));
    });
    if theme::suits_finger(ui.ctx()) {
        // What follows may be for a finger.
        ui.spacing_mut().interact_size.y = before;
    }
    explain(row.response, help);
}

/// A remark in small letters.
pub(super) fn remark(ui: &mut Ui, text: &str) {
    wrapped(ui, text, RichText::small);
}

/// A remark on something that is wrong.
pub(super) fn warning(ui: &mut Ui, text: &str) {
    let colour = ui.visuals().error_fg_color;
    wrapped(ui, text, |text| text.small().color(colour));
}

/// A text in as many lines as it needs, none of which ends between a number and its unit.
pub(super) fn wrapped(ui: &mut Ui, text: &str, look: impl FnOnce(RichText) -> RichText) {
    let response = ui.add(Label::new(look(RichText::new(unbroken(text)))).wrap());
    // As it is found and searched for.
    name(&response, Role::Label, text);
}

/// The name of a file in a bar, which leaves room for what stands behind it.
pub(super) fn name_of_file(ui: &mut Ui, name: &str) {
    ui.scope(|ui| {
        ui.set_max_width(0.4 * ui.available_width());
        ui.add(Label::new(RichText::new(name).weak()).truncate());
    });
}

/// Units that stand behind numbers.
const UNITS: [&str; 21] = [
    "%", "GB", "Go", "HU", "MB", "Mo", "N", "cm", "fps", "kB", "ko", "m", "mN", "min", "mm", "mm/s", "mm²", "ms", "s",
    "°", "µm",
];

/// A text with a no-break space between each number and its unit.
pub(super) fn unbroken(text: &str) -> String {
    let mut unbroken = String::with_capacity(text.len() + 8);
    for (i, word) in text.split(' ').enumerate() {
        if i > 0 {
            let unit = word.trim_end_matches(['.', ',', ':', ';', ')', '?', '!']);
            let is_unit = UNITS.contains(&unit) && unbroken.ends_with(|c: char| c.is_ascii_digit());
            unbroken.push(if is_unit { '\u{a0}' } else { ' ' });
        }
        unbroken += word;
    }
    unbroken
}

#[cfg(test)]
mod tests {
    use super::unbroken;

    #[test]
    fn a_number_keeps_its_unit() {
        assert_eq!(unbroken("A vessel of 2.8 mm, at 90 % of it."), "A vessel of 2.8\u{a0}mm, at 90\u{a0}% of it.");
        assert_eq!(unbroken("1 to 2 in 3 pieces (4 MB)"), "1 to 2 in 3 pieces (4\u{a0}MB)");
        assert_eq!(unbroken("  in mm  "), "  in mm  ");
    }
}
