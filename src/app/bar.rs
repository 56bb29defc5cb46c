//! The bars: files and help above, what is going on below.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{
    Button, Color32, Galley, Rect, Response, RichText, Role, TextStyle, TextWrapMode, Ui, WidgetInfo, WidgetText, pos2,
    vec2,
};

use super::action::Action;
use super::assist::name;
use super::axes;
use super::control::progress;
use super::explain::explain;
use super::icon::{self, Icon};
use super::menus::{icon_menu, long_menu, menu};
use super::mode::{Entry, Group, Mode};
use super::notices::{Kind, Notice};
use super::options::{Colours, ViewOptions};
use super::row::{self, unbroken};
use super::sides::side_label;
use super::state::State;
use super::views::Views;
use super::{deviation, lesson, record, reference, spoken, theme, verdict, vessels};
use crate::io::{Axes, Format, Unit};
use crate::language::{Key, Language, tell};
use crate::phantom::Sample;
use crate::render::StandardView;
use crate::say;

/// What else is shown.
#[derive(Clone, Copy)]
pub(super) struct Shown<'a> {
    /// What has the window.
    pub(super) mode: Mode,
    /// What modes and panels have in the bar.
    pub(super) entries: &'a [Entry],
    /// Someone presents.
    pub(super) is_presenting: bool,
    /// Whether surfaces are kept on this device, where they can be.
    pub(super) keeps_surface: Option<bool>,
    /// Links can be made here.
    pub(super) has_links: bool,
    /// The language that was chosen; `None` for that of the system.
    pub(super) language: Option<Language>,
    /// What is chosen for reports and pictures.
    pub(super) record: record::Chosen,
    /// Whether videos can be made.
    pub(super) has_video: bool,
}

impl Shown<'_> {
    /// The entries of a group.
    fn of(&self, group: Group) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.group == group)
    }
}

/// How much of the bar has a place of its own. What has none is in the menu.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Room {
    /// The three buttons of files.
    Files,
    /// The units of files, too.
    Units,
    /// Undo and redo, and the tabs behind the name of the one that is open.
    Tab,
    /// Each tab.
    Tabs,
    /// What belongs to the views.
    All,
    /// The program's name.
    Name,
}

impl Room {
    /// That of a bar as wide as what is left of this one, by the words of the language that is spoken.
    fn of(ui: &Ui, shown: Shown<'_>) -> Self {
        let spacing = ui.spacing();
        let between = spacing.item_spacing.x;
        let words = |text: String, style: TextStyle, around: f32| {
            let galley = WidgetText::from(text).into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, style);
            (galley.size().x + around).max(spacing.interact_size.x) + between
        };
        let button = |text: String| words(text, TextStyle::Button, 2.0 * spacing.button_padding.x);
        let icons = |count: usize| count as f32 * (spacing.interact_size.y + between);
        let line = RULE + between;
        let files: f32 = [say!("app-open"), say!("app-sample"), say!("app-save")].map(button).iter().sum();
        let units = files + theme::row(ui.ctx(), UNITS) + between;
        let tab = |entry: &Entry| button(entry.label.say());
        let longest = shown.of(Group::Tabs).map(tab).fold(0.0, f32::max) + TRIANGLE;
        let history = icons(2) + 2.0 * line;
        let tabs = units + history + shown.of(Group::Tabs).map(tab).sum::<f32>() + button(say!("app-learn")) + TRIANGLE;
        let all = tabs + line + icons(VIEW_ICONS);
        let needed = [
            (Self::Name, all + words("Lumen".to_owned(), TextStyle::Heading, between)),
            (Self::All, all),
            (Self::Tabs, tabs + icons(1)),
            (Self::Tab, units + history + longest + icons(1)),
            (Self::Units, units + icons(1)),
        ];
        let width = ui.available_width();
        needed.into_iter().find(|&(_, needed)| needed <= width).map_or(Self::Files, |(room, _)| room)
    }
}

/// Width of a line between two groups, in points.
const RULE: f32 = 6.0;
/// Width of the button of the units where a mouse points, in points.
const UNITS: f32 = 20.0;
/// Width of the triangle of a tab that opens a menu, in points.
const TRIANGLE: f32 = 16.0;
/// How many icons belong to the views.
const VIEW_ICONS: usize = 6;

/// The bar above: files, the tabs of the modes, and what belongs to the views.
pub(super) fn top(ui: &mut Ui, state: &State, views: &Views, shown: Shown<'_>, asked: &mut Vec<Action>) {
    let mut ask = |wanted: bool, what: Action| {
        if wanted {
            asked.push(what);
        }
    };
    let can_compare = state.document.is_some() && !matches!(shown.mode, Mode::Trial | Mode::Scan);
    ui.horizontal_centered(|ui| {
        let room = Room::of(ui, shown);
        if room == Room::Name {
            ui.label(RichText::new("Lumen").heading().strong());
            ui.add_space(ui.spacing().item_spacing.x);
        }
        ask(ui.button(say!("app-open")).on_hover_text(say!("app-open-help")).clicked(), Action::Open);
        if room >= Room::Units {
            icon_menu(ui, Icon::Down, &say!("app-open-in"), &say!("app-open-in-help"), &mut |ui| {
                units(ui, can_compare, &mut ask);
            });
        }
        menu(ui, &say!("app-sample"), &mut |ui| {
            for sample in Sample::ALL {
                ask(ui.button(tell(&sample.label())).clicked(), Action::Sample(sample));
            }
        });
        let has_result = state.document.as_ref().is_some_and(|document| document.shown.is_some());
        ui.add_enabled_ui(has_result, |ui| {
            long_menu(ui, &say!("app-save"), &mut |ui| save(ui, state, shown, &mut ask));
        });
        if room >= Room::Tab {
            let can_undo = state.history.can_undo();
            let (undo, help) = (say!("app-undo"), say!("app-undo-help"));
            ask(icon::button(ui, Icon::Undo, can_undo, &undo, &help).clicked(), Action::Undo);
            let can_redo = state.history.can_redo();
            let (redo, help) = (say!("app-redo"), say!("app-redo-help"));
            ask(icon::button(ui, Icon::Redo, can_redo, &redo, &help).clicked(), Action::Redo);
            ui.separator();
        }
        match room {
            Room::Files | Room::Units => {}
            Room::Tab => {
                let open = shown.of(Group::Tabs).find(|entry| entry.is_open);
                let name = open.map_or_else(String::new, |entry| entry.label.say());
                tab_menu(ui, &name, &mut |ui| tabs(ui, shown, false, &mut ask));
            }
            Room::Tabs | Room::All | Room::Name => {
                tabs(ui, shown, true, &mut ask);
                tab_menu(ui, &say!("app-learn"), &mut |ui| learn(ui, shown, &mut ask));
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if room >= Room::All {
                of_views(ui, state, views, shown, &mut ask);
            } else {
                icon_menu(ui, Icon::Menu, &say!("app-menu"), &say!("app-menu-help"), &mut |ui| {
                    if room < Room::Units {
                        menu(ui, &say!("app-open-in"), &mut |ui| units(ui, can_compare, &mut ask));
                    }
                    more(ui, state, views, shown, room, &mut ask);
                });
            }
        });
    });
}

/// What can be saved, and what of it is kept here.
fn save(ui: &mut Ui, state: &State, shown: Shown<'_>, ask: &mut impl FnMut(bool, Action)) {
    if let Some(document) = &state.document {
        let verdict = verdict::verdict(state, document);
        ui.set_max_width(300.0);
        let colour = ui.visuals().error_fg_color;
        let colour = if verdict.is_safe == Some(false) { colour } else { ui.visuals().weak_text_color() };
        in_lines(ui, &verdict.in_short(tell), colour);
        ui.separator();
    }
    if theme::suits_finger(ui.ctx()) || theme::is_narrow(ui.ctx()) {
        // Rows for a finger: all of them at once are higher than a phone.
        menu(ui, &say!("app-save-surface"), &mut |ui| of_surface(ui, state, ask));
        menu(ui, &say!("app-save-vessels"), &mut |ui| of_vessels(ui, state, ask));
        menu(ui, &say!("app-save-record"), &mut |ui| {
            ask_record(record::report(ui, state.calibre().is_some()), ask);
            settings_and_link(ui, shown, ask);
        });
        ask_record(record::pictures(ui, shown.record, shown.has_video), ask);
    } else {
        of_surface(ui, state, ask);
        ui.separator();
        of_vessels(ui, state, ask);
        ui.separator();
        ask_record(record::report(ui, state.calibre().is_some()), ask);
        ask_record(record::pictures(ui, shown.record, shown.has_video), ask);
        ui.separator();
        settings_and_link(ui, shown, ask);
    }
    if let Some(mut keeps) = shown.keeps_surface {
        ui.separator();
        kept_here(ui, &mut keeps, ask);
    }
}

/// The formats that the surface is saved in.
fn of_surface(ui: &mut Ui, state: &State, ask: &mut impl FnMut(bool, Action)) {
    for format in Format::ALL {
        let text = format!("{}...", format.label());
        let unit = say!("app-save-lengths", unit = format.unit().to_string());
        ask(ui.button(text).on_hover_text(unit).clicked(), Action::Save(format));
    }
    let levels = ui.button(say!("app-save-levels")).on_hover_text(say!("app-save-levels-help"));
    ask(levels.clicked(), Action::SaveLevels);
    ui.label(RichText::new(say!("app-save-all-lengths")).small().weak());
    axes::written(ui, state, ask);
}

/// What is saved of the vessels.
fn of_vessels(ui: &mut Ui, state: &State, ask: &mut impl FnMut(bool, Action)) {
    let has_vessels = state.calibre().is_some_and(|calibre| calibre.found.is_ok());
    ui.add_enabled_ui(has_vessels, |ui| {
        for (text, what, help) in vessels::FILES {
            ask(ui.button(text.say()).on_hover_text(help.say()).clicked(), Action::Vessels(what));
        }
    });
}

fn ask_record(asked: Option<record::Action>, ask: &mut impl FnMut(bool, Action)) {
    if let Some(asked) = asked {
        ask(true, Action::Record(asked));
    }
}

fn settings_and_link(ui: &mut Ui, shown: Shown<'_>, ask: &mut impl FnMut(bool, Action)) {
    let save = ui.button(say!("app-save-settings")).on_hover_text(say!("app-save-settings-help"));
    ask(save.clicked(), Action::SaveSettings);
    if shown.has_links {
        let copy = ui.button(say!("app-copy-link")).on_hover_text(say!("app-copy-link-help"));
        ask(copy.clicked(), Action::CopyLink);
    }
}

/// The tabs of the modes: in the bar, or one below the other in a menu.
fn tabs(ui: &mut Ui, shown: Shown<'_>, is_bar: bool, ask: &mut impl FnMut(bool, Action)) {
    for entry in shown.of(Group::Tabs) {
        let label = entry.label.say();
        let response = if is_bar {
            tab(ui, &label, entry.is_open, entry.is_enabled)
        } else {
            ui.add_enabled(entry.is_enabled, Button::new(label).selected(entry.is_open))
        };
        if response.on_hover_text(entry.help.say()).clicked() && !entry.is_open {
            ask(true, Action::Prepare);
            ask(entry.action != Action::Prepare, entry.action.clone());
        }
    }
}

/// A tab: words, and under those of the one that is open a line.
fn tab(ui: &mut Ui, label: &str, is_open: bool, is_enabled: bool) -> Response {
    let words = RichText::new(label);
    let button = Button::new(if is_open { words.strong() } else { words }).frame_when_inactive(false);
    let response = ui.add_enabled(is_enabled, button);
    response.widget_info(|| WidgetInfo::selected(Role::Button, is_enabled, is_open, label));
    if is_open {
        let rect = response.rect.shrink2(vec2(4.0, 0.0));
        let line = Rect::from_min_max(pos2(rect.left(), rect.bottom() - 2.0), rect.max);
        ui.painter().rect_filled(line, 1.0, ui.visuals().hyperlink_color);
    }
    response
}

/// A tab that opens a menu.
fn tab_menu(ui: &mut Ui, label: &str, content: &mut dyn FnMut(&mut Ui)) {
    // Room for the triangle.
    let response = ui.add(Button::new(format!("{label}     ")).frame_when_inactive(false));
    name(&response, Role::Button, label);
    let middle = response.rect.right_center() - vec2(ui.spacing().button_padding.x + TRIANGLE / 3.0, -1.0);
    icon::down(ui.painter(), middle, ui.style().interact(&response).fg_stroke.color);
    egui::Popup::menu(&response).show(content);
}

/// What belongs to the views, from right to left.
fn of_views(ui: &mut Ui, state: &State, views: &Views, shown: Shown<'_>, ask: &mut impl FnMut(bool, Action)) {
    let (about, help) = (say!("app-about"), say!("app-about-help"));
    ask(icon::button(ui, Icon::About, true, &about, &help).clicked(), Action::About);
    let (keys, help) = (say!("app-help"), say!("app-help-help"));
    ask(icon::button(ui, Icon::Help, true, &keys, &help).clicked(), Action::Help);
    let (other, help) = (say!("app-theme"), say!("app-theme-help"));
    ask(icon::button(ui, Icon::Theme, true, &other, &help).clicked(), Action::Theme);
    icon_menu(ui, Icon::View, &say!("app-view"), &say!("app-view-help"), &mut |ui| {
        view_menu(ui, state, views.options, shown, ask);
    });
    let is_method = shown.mode == Mode::Method;
    let (before, help) = (say!("app-before"), say!("app-before-help"));
    let is_held =
        icon::hold(ui, Icon::Before, is_method, views.show_before, &before, &help).is_pointer_button_down_on();
    ask(is_held != views.before_is_held, Action::HoldBefore(is_held));
    let is_split = state.document.as_ref().is_some_and(|document| views.reveals(document));
    let (split, help) = (say!("app-split"), say!("app-split-help"));
    ask(icon::toggle(ui, Icon::Split, is_method, is_split, &split, &help).clicked(), Action::Reveal);
}

/// Files whose numbers are in another unit.
fn units(ui: &mut Ui, can_compare: bool, ask: &mut impl FnMut(bool, Action)) {
    ui.set_min_width(ui.spacing().interact_size.x);
    ui.label(RichText::new(say!("app-open-units")).small().weak());
    for unit in Unit::ALL {
        ask(ui.button(format!("{unit}...")).clicked(), Action::OpenIn(unit));
    }
    ui.separator();
    let compare = ui.add_enabled(can_compare, Button::new(say!("reference-open")));
    let compare = compare.on_hover_text(say!("reference-open-help"));
    ask(compare.clicked(), Action::Reference(reference::Action::Choose));
}

/// What is kept on this device.
fn kept_here(ui: &mut Ui, keeps: &mut bool, ask: &mut impl FnMut(bool, Action)) {
    let help = say!("app-keep-surface-help");
    let chosen = ui.checkbox(keeps, say!("app-keep-surface")).on_hover_text(help).changed();
    ask(chosen, Action::KeepSurface(*keeps));
    let forget = ui.button(say!("app-forget")).on_hover_text(say!("app-forget-help")).clicked();
    ask(forget, Action::Forget);
}

fn view_menu(ui: &mut Ui, state: &State, options: ViewOptions, shown: Shown<'_>, ask: &mut impl FnMut(bool, Action)) {
    ask(ui.button(say!("app-fit")).clicked(), Action::Fit);
    ui.separator();
    // Where the patient's sides are not known they are sides of the surface alone.
    let is_known = state.document.as_ref().is_some_and(|document| document.import.axes != Axes::Unknown);
    for view in StandardView::ALL {
        ask(ui.button(side_label(view, is_known)).clicked(), Action::View(view));
    }
    ui.separator();
    let mut chosen = options;
    ui.checkbox(&mut chosen.flat, say!("app-flat")).on_hover_text(say!("app-flat-help"));
    ui.checkbox(&mut chosen.raking, say!("app-raking")).on_hover_text(say!("app-raking-help"));
    ui.checkbox(&mut chosen.occlusion, say!("app-occlusion")).on_hover_text(say!("app-occlusion-help"));
    ui.checkbox(&mut chosen.see_through, say!("app-see-through")).on_hover_text(say!("app-see-through-help"));
    ui.checkbox(&mut chosen.reveal_lines, say!("app-split-lines")).on_hover_text(say!("app-split-lines-help"));
    let maps = [
        (Colours::Deviation(chosen.deviation), Key("app-colour-deviation"), Key("app-colour-deviation-help")),
        (Colours::Calibre, Key("app-colour-calibre"), Key("app-colour-calibre-help")),
        (Colours::Classes, Key("app-colour-classes"), Key("app-colour-classes-help")),
    ];
    for (colours, text, help) in maps {
        let mut is_chosen = chosen.colours == colours;
        if ui.checkbox(&mut is_chosen, text.say()).on_hover_text(help.say()).changed() {
            chosen.colours = chosen.colours.toggled(colours);
        }
        if let Colours::Deviation(_) = colours
            && is_chosen
        {
            deviation::choices(ui, &mut chosen.deviation);
            chosen.colours = Colours::Deviation(chosen.deviation);
        }
    }
    ui.checkbox(&mut chosen.lines, say!("app-feature-lines")).on_hover_text(say!("app-feature-lines-help"));
    ask(chosen != options, Action::Show(chosen));
    ui.separator();
    let mut presents = shown.is_presenting;
    let present = ui.checkbox(&mut presents, say!("app-present")).on_hover_text(say!("app-present-help"));
    ask(present.clicked(), Action::Present);
    ui.separator();
    menu(ui, &say!("app-language"), &mut |ui| languages(ui, shown.language, ask));
}

/// The languages, each by its own name.
fn languages(ui: &mut Ui, chosen: Option<Language>, ask: &mut impl FnMut(bool, Action)) {
    ask(ui.radio(chosen.is_none(), say!("app-language-system")).clicked(), Action::Speak(None));
    for language in Language::ALL {
        ask(ui.radio(chosen == Some(language), language.name()).clicked(), Action::Speak(Some(language)));
    }
}

/// Lessons, the steps of decimation, and the words that are used.
fn learn(ui: &mut Ui, shown: Shown<'_>, ask: &mut impl FnMut(bool, Action)) {
    for (name, title, _) in lesson::LESSONS {
        let begin = ui.button(title.say()).on_hover_text(say!("app-lesson-help"));
        ask(begin.clicked(), Action::Lesson(lesson::Action::Open(name)));
    }
    let own = ui.button(say!("app-open-lesson")).on_hover_text(say!("app-open-lesson-help"));
    ask(own.clicked(), Action::Lesson(lesson::Action::Choose));
    ui.separator();
    for entry in shown.of(Group::Learn) {
        let mut is_open = entry.is_open;
        let box_of = egui::Checkbox::new(&mut is_open, entry.label.say());
        let toggled = ui.add_enabled(entry.is_enabled, box_of).on_hover_text(entry.help.say()).changed();
        ask(toggled, entry.action.clone());
    }
    let words = ui.button(say!("app-glossary")).on_hover_text(say!("app-glossary-help"));
    ask(words.clicked(), Action::Lesson(lesson::Action::Glossary));
}

/// What has no place of its own in the bar.
fn more(ui: &mut Ui, state: &State, views: &Views, shown: Shown<'_>, room: Room, ask: &mut impl FnMut(bool, Action)) {
    if room < Room::Tab {
        ask(ui.add_enabled(state.history.can_undo(), Button::new(say!("app-undo"))).clicked(), Action::Undo);
        ask(ui.add_enabled(state.history.can_redo(), Button::new(say!("app-redo"))).clicked(), Action::Redo);
    }
    let mut chosen = views.options;
    ui.checkbox(&mut chosen.before, say!("app-show-before"));
    ask(chosen != views.options, Action::Show(chosen));
    let mut is_split = state.document.as_ref().is_some_and(|document| views.reveals(document));
    ask(ui.checkbox(&mut is_split, say!("app-split-view")).clicked(), Action::Reveal);
    if room < Room::Tab {
        ui.separator();
        tabs(ui, shown, false, ask);
        ui.separator();
    }
    long_menu(ui, &say!("app-view"), &mut |ui| view_menu(ui, state, views.options, shown, ask));
    if room < Room::Tabs {
        long_menu(ui, &say!("app-learn"), &mut |ui| learn(ui, shown, ask));
    }
    ask(ui.button(say!("app-theme")).clicked(), Action::Theme);
    ask(ui.button(say!("app-help")).clicked(), Action::Help);
    ask(ui.button(say!("app-about")).clicked(), Action::About);
}

/// Lines of the verdict over what can be saved.
const VERDICT_LINES: usize = 4;

/// A text in small letters in the room of so many lines, so that what is found while a menu is open moves nothing in it. The
/// whole is told where the pointer rests, and to assistive tools.
fn in_lines(ui: &mut Ui, text: &str, colour: Color32) {
    let mut job = LayoutJob::simple(unbroken(text), TextStyle::Small.resolve(ui.style()), colour, ui.available_width());
    job.wrap.max_rows = VERDICT_LINES;
    ui.scope(|ui| {
        ui.set_min_height(VERDICT_LINES as f32 * ui.text_style_height(&TextStyle::Small));
        let response = explain(ui.label(job), text);
        name(&response, Role::Label, text);
    });
}

/// The most lines that a notice takes in the bar below.
const MAX_LINES: usize = 5;

/// What stands at the right of the bar below, the rightmost first: what always holds, then the rate and the triangles of what
/// is shown.
fn standing(state: &State, views: &Views) -> Vec<RichText> {
    let shown = state.document.as_ref().and_then(|document| document.shown.as_ref());
    let shown = shown.into_iter().flat_map(|shown| {
        let count = say!("app-triangles", count = shown.level.triangles.len());
        [RichText::new(views.rate()).weak(), RichText::new(count)]
    });
    std::iter::once(RichText::new(say!("about-not-clinical")).small().weak()).chain(shown).collect()
}

/// The notice for a bar below of so many points, in as many lines as it takes beside what stands at the right.
pub(super) fn notice(ui: &Ui, state: &State, views: &Views, is_narrow: bool, width: f32) -> Option<Arc<Galley>> {
    let notice = state.notices.newest()?;
    let colour = if notice.kind == Kind::Wrong { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
    let said = notice.said();
    let lay_out = |width: f32| {
        let mut job = LayoutJob::simple(said.clone(), TextStyle::Body.resolve(ui.style()), colour, width);
        job.wrap.max_rows = MAX_LINES;
        ui.fonts_mut(|fonts| fonts.layout_job(job))
    };
    let space = ui.spacing().item_spacing.x;
    let mut width = width;
    if notice.stands() {
        width -= theme::row(ui.ctx(), 20.0) + space;
    }
    if notice.kind == Kind::OffersNext {
        for label in [say!("app-open-next"), say!("reference-take-next")] {
            let label = WidgetText::from(label);
            let label = label.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Button);
            width -= label.size().x + 2.0 * ui.spacing().button_padding.x + space;
        }
    }
    let told = lay_out(width);
    if is_narrow {
        return Some(told);
    }
    // Each with a line before it, and room around that.
    let gap = 6.0 + 2.0 * space;
    let right = standing(state, views).into_iter().map(|text| {
        WidgetText::from(text).into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Body).size().x
            + gap
    });
    let room = width - right.sum::<f32>();
    Some(if told.rows.len() == 1 && told.size().x <= room { told } else { lay_out(room) })
}

/// The bar below, with the [`notice`] as it is laid out. Says whether that can be read: work stands in its place.
pub(super) fn status(
    ui: &mut Ui,
    state: &State,
    views: &Views,
    notice: Option<Arc<Galley>>,
    drawing: Option<(String, f32)>,
    is_narrow: bool,
    asked: &mut Vec<Action>,
) -> bool {
    let mut is_read = false;
    spoken::announce(ui, state);
    ui.horizontal_centered(|ui| {
        if let Some((what, fraction)) = drawing {
            progress(ui, fraction, if is_narrow { 96.0 } else { 160.0 }, &say!("app-progress"));
            ui.label(format!("{what} {:.0} %", fraction * 100.0));
            if ui.button(say!("app-cancel")).on_hover_text(say!("app-cancel-help")).clicked() {
                asked.push(Action::Record(record::Action::Cancel));
            }
        } else if let Some((work, fraction)) = state.told_work() {
            let width = if is_narrow { 96.0 } else { 160.0 };
            progress(ui, fraction, width, &say!("app-progress"));
            ui.label(format!("{} {:.0} %", work.label(), fraction * 100.0));
            if let Some(name) = state.opening().filter(|_| !is_narrow) {
                row::name_of_file(ui, &name);
            }
            if ui.button(say!("app-cancel")).on_hover_text(say!("app-cancel-help")).clicked() {
                asked.push(Action::Cancel);
            }
        } else if let Some(notice) = notice {
            let response = ui.label(notice.clone());
            name(&response, Role::Label, notice.text());
            is_read = true;
            let told = state.notices.newest();
            if told.is_some_and(|told| told.kind == Kind::OffersNext) {
                if ui.button(say!("app-open-next")).on_hover_text(say!("app-open-next-help")).clicked() {
                    asked.push(Action::OpenNext);
                }
                let compare = ui.button(say!("reference-take-next")).on_hover_text(say!("reference-take-next-help"));
                if compare.clicked() {
                    asked.push(Action::Reference(reference::Action::TakeNext));
                }
            }
            if told.is_some_and(Notice::stands)
                && icon::button(ui, Icon::Close, true, &say!("app-take-away"), &say!("app-take-away-help")).clicked()
            {
                asked.push(Action::TakeAway);
            }
        } else if let Some(document) = &state.document {
            ui.label(RichText::new(document.title()).weak());
        }
        if !is_narrow || state.told_work().is_none() && state.notices.newest().is_none() {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let standing = standing(state, views);
                // A phone has room for the count alone.
                for (i, text) in standing.into_iter().skip(if is_narrow { 2 } else { 0 }).enumerate() {
                    if i > 0 {
                        ui.separator();
                    }
                    ui.label(text);
                }
            });
        }
    });
    is_read
}
