//! Where everything stands in the window: bars, panels, views and what lies over them.

use egui::{
    Align, CentralPanel, Frame, Hyperlink, Layout, Margin, Panel, RichText, TextStyle, TextWrapMode, Ui, WidgetText,
};

use super::LumenApp;
use crate::app::action::Action;
use crate::app::drawer::Content;
use crate::app::mode::{Beside, Mode, Now, Place};
use crate::app::solver::SolverView;
use crate::app::state::State;
use crate::app::views::{Clicked, Over, Subject};
use crate::app::{assist, bar, collapses, invitation, panel, row, theme, verdict};
use crate::pipeline::settings::Settings;
use crate::say;

/// From this width on there is room for a plot beside the views while someone presents, in points.
const ROOM_TO_PRESENT: f32 = 800.0;

/// What the verdict leaves of the height to the views in a part of another page: where it is less, there is none, in points.
const LEFT_TO_VIEWS: f32 = 140.0;

/// A part of another page that is lower than this shows the sliders in a row, and nothing that they lead to, in points.
const LOW: f32 = 480.0;

impl LumenApp {
    /// Shows the bars and the panel, and does what is asked for there.
    pub(super) fn controls(&mut self, ui: &mut Ui) {
        let bar = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 6));
        let mut asked = Vec::new();
        let (mode, is_narrow, is_stacked) = (self.mode(), self.is_narrow, self.is_stacked);
        let (entries, keeps_surface) = (self.entries(mode), self.recovery.keeps(&mut *self.platform));
        let is_embedded = self.platform.is_embedded();
        // A part of another page opens and saves nothing.
        if !is_embedded {
            Panel::top("top").frame(bar).exact_size(theme::row(ui.ctx(), 36.0) + 12.0).show(ui, |ui| {
                let shown = bar::Shown {
                    mode,
                    entries: &entries,
                    is_presenting: self.presenter.is_on(),
                    keeps_surface,
                    has_links: self.has_links,
                    language: self.speech.chosen(),
                    record: self.record.chosen(),
                    has_video: self.platform.has_video(),
                };
                bar::top(ui, &self.state, &self.views, shown, &mut asked);
            });
        }
        let is_low = self.is_low(ui);
        let mut inside = ui.available_width() - bar.inner_margin.sum().x;
        let whole = is_low.then(|| self.whole()).flatten();
        if whole.is_some() {
            let words = WidgetText::from(RichText::new(say!("app-whole")).small());
            let galley = words.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, TextStyle::Small);
            inside -= galley.size().x + ui.spacing().item_spacing.x;
        }
        let notice = bar::notice(ui, &self.state, &self.views, is_narrow, inside);
        let height = notice.as_ref().map_or(0.0, |notice| notice.size().y).max(theme::row(ui.ctx(), 28.0));
        Panel::bottom("status").frame(bar).exact_size(height + 12.0).show(ui, |ui| {
            // Of one height whatever is told of work, or the views would move with it: of egui's least the panel's edge is
            // taken off.
            ui.set_min_height(height);
            let now = self.now(mode);
            let mut is_read = false;
            let mut status = |ui: &mut Ui| {
                let is_told = self.panels.all().into_iter().any(|panel| panel.show_status(ui, now, &mut asked));
                let progress = self.record.progress();
                is_read = !is_told
                    && bar::status(ui, &self.state, &self.views, notice.clone(), progress, is_narrow, &mut asked);
            };
            match whole {
                Some(link) => {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        way_to_whole(ui, link);
                        ui.with_layout(Layout::left_to_right(Align::Center), status);
                    });
                }
                None => status(ui),
            }
            if let Some(left) = self.state.notices.follow(ui.input(|input| input.time), is_read) {
                ui.ctx().request_repaint_after(left);
            }
        });
        if let Some(panel) = self.panels.of_mut(mode).filter(|_| is_stacked)
            && let Some(height) = panel.thumb_height()
        {
            // Below all else: where the thumbs are of whoever holds a phone.
            Panel::bottom("pads").frame(bar).exact_size(height).show(ui, |ui| panel.show_thumbs(ui));
        }
        let feet = self.placed(ui, mode, |place| matches!(place, Place::Foot(_) | Place::Side(..)));
        for (index, place) in &feet {
            let card = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
            match place.clone() {
                // Not under the name of the foot: its size is another.
                Place::Side(width, range) => {
                    let frame = |id| Panel::right(egui::Id::unique((id, "side"))).resizable(true).default_size(width);
                    self.show_panel(ui, *index, mode, |id| frame(id).size_range(range).frame(card), &mut asked);
                    assist::name_edge(ui, egui::Id::unique((self.panels.all()[*index].id(), "side")));
                }
                Place::Foot(height) => {
                    self.show_panel(
                        ui,
                        *index,
                        mode,
                        |id| Panel::bottom(id).exact_size(height).frame(card),
                        &mut asked,
                    );
                }
                Place::Panel | Place::Right(..) | Place::Below(..) => {}
            }
        }
        let takes_panel = self.placed(ui, mode, |place| *place == Place::Panel).pop().map(|(index, _)| index);
        let takes_panel = takes_panel.filter(|_| mode == Mode::Method);
        let part = if feet.is_empty() { 0.45 } else { 0.35 };
        self.side(ui, mode, takes_panel, part, &mut asked);
        // A small part of another page has room for the views and what is dragged.
        let strip = verdict::Strip { is_narrow, is_part: is_embedded, is_low };
        let height = strip.height(ui.ctx()) + 8.0;
        let has_verdict = !is_embedded || ui.available_height() >= LEFT_TO_VIEWS + height;
        if mode == Mode::Method && takes_panel.is_none() && has_verdict {
            let frame = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 4));
            Panel::top("verdict").frame(frame).exact_size(height).show(ui, |ui| {
                verdict::show(ui, &self.state, self.views.options, strip, &mut asked);
            });
        }
        if mode == Mode::Method {
            self.around_views(ui, &mut asked);
        }
        self.act_on_all(asked, ui.ctx());
    }

    /// The panels that are open and no mode, by their place in the list, of those places that `is_wanted` says.
    fn placed(&self, ui: &Ui, mode: Mode, is_wanted: impl Fn(&Place) -> bool) -> Vec<(usize, Place)> {
        let (now, panels) = (self.now(mode), self.panels.all());
        let open = panels
            .into_iter()
            .enumerate()
            .filter(|(_, panel)| panel.mode().is_none() && panel.is_there(&self.state, self.beside));
        open.map(|(index, panel)| (index, panel.place(ui, now))).filter(|(_, place)| is_wanted(place)).collect()
    }

    /// Shows one of the panels in what `frame` makes of its name.
    fn show_panel(
        &mut self,
        ui: &mut Ui,
        index: usize,
        mode: Mode,
        frame: impl FnOnce(&'static str) -> Panel,
        asked: &mut Vec<Action>,
    ) {
        let (panels, now) = self.with_now(mode);
        if let Some(panel) = panels.all_mut().into_iter().nth(index) {
            frame(panel.id()).show(ui, |ui| panel.show(ui, now, asked));
        }
    }

    /// Shows what stands around the views: first at their right, then below them, the last of the list at the lowest.
    fn around_views(&mut self, ui: &mut Ui, asked: &mut Vec<Action>) {
        let margin = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
        for (index, place) in self.placed(ui, Mode::Method, |place| matches!(place, Place::Right(..))) {
            let Place::Right(width, range) = place else { continue };
            let beside = |id| Panel::right(id).resizable(true).default_size(width).size_range(range).frame(margin);
            self.show_panel(ui, index, Mode::Method, beside, asked);
            assist::name_edge(ui, self.panels.all()[index].id());
        }
        for (index, _) in self.placed(ui, Mode::Method, |place| matches!(place, Place::Below(..))) {
            // What is above has taken its part of the height.
            let place = self.panels.all()[index].place(ui, self.now(Mode::Method));
            let Place::Below(height, range) = place else { continue };
            let below = |id| match range {
                Some(range) => Panel::bottom(id).resizable(true).default_size(height).size_range(range).frame(margin),
                None => Panel::bottom(id).frame(margin).exact_size(height),
            };
            self.show_panel(ui, index, Mode::Method, below, asked);
            assist::name_edge(ui, self.panels.all()[index].id());
        }
    }

    /// Shows the panel at the side, on a phone below: the mode's controls, one that takes their place, or the method.
    fn side(&mut self, ui: &mut Ui, mode: Mode, taken_by: Option<usize>, part: f32, asked: &mut Vec<Action>) {
        let is_stacked = self.is_stacked;
        // Where a finger points the panel is drawn up and down.
        let is_drawn = is_stacked && theme::suits_finger(ui.ctx());
        let index_of_mode = self.panels.all().into_iter().position(|panel| panel.mode() == Some(mode));
        let of_mode = index_of_mode.filter(|&index| self.panels.all()[index].replaces_method());
        let instead = of_mode.or(taken_by);
        // Who presents sees no method; the trial and a scan cannot be used without.
        if (self.presenter.is_on() || self.platform.is_embedded()) && instead.is_none() {
            return self.presented(ui, mode);
        }
        // On a phone the pictures that are compared, or a lesson's card, need the room.
        let compares = mode == Mode::Compare;
        let needs_room = compares || self.panels.lesson.given().is_some();
        let content = match instead {
            Some(index) if !self.panels.all()[index].has_head() => Content::Plain,
            None if is_drawn && self.is_narrow && needs_room => Content::Folded { compares },
            instead => Content::Headed(instead),
        };
        self.drawer.take(content, ui.available_height(), part);
        let side = if is_drawn {
            Panel::bottom("panel").exact_size(self.drawer.height())
        } else if is_stacked {
            Panel::bottom("panel").exact_size(ui.available_height() * part)
        } else {
            Panel::left("panel").resizable(true).default_size(296.0).size_range(256.0..=440.0)
        };
        let margin = Margin { top: if is_drawn { 0 } else { 8 }, ..Margin::symmetric(16, 8) };
        side.frame(Frame::side_top_panel(ui.style()).inner_margin(margin)).show(ui, |ui| {
            if is_drawn {
                self.drawer.handle(ui);
            }
            let is_low = is_drawn && self.drawer.peeks();
            match (content, instead) {
                (Content::Headed(_), _) => self.headed(ui, mode, instead, is_low, asked),
                (Content::Folded { .. }, _) if !is_low => self.headed(ui, mode, instead, false, asked),
                (Content::Plain, Some(index)) if !is_low => {
                    let (panels, now) = self.with_now(mode);
                    if let Some(panel) = panels.all_mut().into_iter().nth(index) {
                        panel.show(ui, now, asked);
                    }
                }
                (Content::Folded { .. } | Content::Plain, _) => {}
            }
        });
        assist::name_edge(ui, "panel");
    }

    /// Shows the method, or the panel that stands in its place, with its head above what scrolls; in a window that is too
    /// low for that the head scrolls, too.
    fn headed(&mut self, ui: &mut Ui, mode: Mode, instead: Option<usize>, is_low: bool, asked: &mut Vec<Action>) {
        if let Some(panel) = self.panels.of_mut(mode).filter(|panel| !self.is_stacked && panel.thumb_height().is_some())
        {
            panel.show_thumbs(ui);
        }
        if !is_low && !self.drawer.docks(ui.available_height()) {
            return row::scrolled(ui, |ui| {
                let height = ui.scope(|ui| self.head(ui, mode, instead, asked)).response.rect.height();
                self.drawer.take_head(ui, height);
                self.below_head(ui, mode, instead, asked);
            });
        }
        let height = row::docked(ui, |ui| self.head(ui, mode, instead, asked));
        self.drawer.take_head(ui, height);
        if !is_low {
            ui.separator();
            row::scrolled(ui, |ui| self.below_head(ui, mode, instead, asked));
        }
    }

    fn head(&mut self, ui: &mut Ui, mode: Mode, instead: Option<usize>, asked: &mut Vec<Action>) {
        let Some(index) = instead else {
            return self.dock(ui);
        };
        let (panels, now) = self.with_now(mode);
        if let Some(panel) = panels.all_mut().into_iter().nth(index) {
            panel.show_head(ui, now, asked);
        }
    }

    fn below_head(&mut self, ui: &mut Ui, mode: Mode, instead: Option<usize>, asked: &mut Vec<Action>) {
        let Some(index) = instead else {
            return self.method_panel(ui, asked);
        };
        let (panels, now) = self.with_now(mode);
        if let Some(panel) = panels.all_mut().into_iter().nth(index) {
            panel.show(ui, now, asked);
        }
    }

    /// Shows what is dragged. What it sets is done at once: what follows, and the views, are of the level that was just
    /// asked for.
    fn dock(&mut self, ui: &mut Ui) {
        let mut asked = Vec::new();
        let show = if self.is_low(ui) { panel::flat_dock } else { panel::dock };
        ui.push_id("dock", |ui| show(ui, &self.state, &mut asked));
        self.act_on_all(asked, ui.ctx());
    }

    /// Shows what of the method stays in sight while someone presents.
    fn presented(&mut self, ui: &mut Ui, mode: Mode) {
        let margin = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
        if self.is_low(ui) {
            let margin = margin.inner_margin(Margin::symmetric(12, 4));
            Panel::bottom("dock").frame(margin).show(ui, |ui| row::docked(ui, |ui| self.dock(ui)));
            return;
        }
        Panel::bottom("dock").frame(margin).show(ui, |ui| {
            row::docked(ui, |ui| self.dock(ui));
            if let Some(link) = self.whole() {
                way_to_whole(ui, link);
            }
        });
        let has_response =
            self.presenter.is_on() && mode == Mode::Method && self.state.settings.smoothing.iterations > 0;
        if has_response && ui.available_width() >= ROOM_TO_PRESENT {
            let width = 0.36 * ui.available_width();
            Panel::right("response").frame(margin).exact_size(width).show(ui, |ui| {
                panel::present_response(ui, &self.state);
            });
        }
    }

    /// Whether this is a part of another page with next to no height.
    fn is_low(&self, ui: &Ui) -> bool {
        self.platform.is_embedded() && ui.ctx().content_rect().height() < LOW
    }

    /// The address of the whole program with what is shown here, where this is a part of another page.
    fn whole(&self) -> Option<String> {
        let is_part = self.platform.is_embedded();
        is_part.then(|| self.sharing.whole(&self.state, &self.views.camera, &*self.platform)).flatten()
    }

    /// The panels, to be changed, and what they may look at.
    fn with_now(&mut self, mode: Mode) -> (&mut crate::app::Panels, Now<'_>) {
        let now = Now {
            state: &self.state,
            mode,
            beside: self.beside,
            options: self.views.options,
            camera: &self.views.camera,
            is_narrow: self.is_narrow,
            has_links: self.has_links,
        };
        (&mut self.panels, now)
    }

    /// Shows the method from top to bottom. What its steps set is done at once, as in the dock.
    fn method_panel(&mut self, ui: &mut Ui, asked: &mut Vec<Action>) {
        for (id, step) in panel::STEPS {
            let mut of_step = Vec::new();
            ui.push_id(id, |ui| step(ui, &self.state, &self.views, &mut of_step));
            self.act_on_all(of_step, ui.ctx());
            if id == "surface" {
                let mut of_slices = Vec::new();
                self.panels.scan.show_slices(ui, &self.state, &mut of_slices);
                self.act_on_all(of_slices, ui.ctx());
            }
        }
        self.state.show_level();
        ui.push_id("trial", |ui| self.panels.trial.show_step(ui, &self.state, asked));
        ui.push_id("solver", |ui| SolverView::show_step(ui, &self.state, asked));
        ui.push_id("result", |ui| panel::result(ui, &self.state, asked));
    }

    /// Shows the views, and what lies over them.
    pub(super) fn centre(&mut self, ui: &mut Ui) {
        let (mode, keep) = (self.mode(), self.state.settings.keep);
        // The two views leave nothing to be filled behind them.
        let is_covered = self.panels.filling_of_mut(mode).is_none();
        let line = ui.visuals().widgets.noninteractive.bg_stroke.color;
        let frame = if is_covered { Frame::new() } else { Frame::new().fill(line) };
        let asked = CentralPanel::default().frame(frame).show(ui, |ui| {
            if std::mem::take(&mut self.look_next) {
                self.views.look_first(self.state.document.as_ref(), keep);
                self.recovery.look(&mut self.views.camera);
            }
            self.sharing.look(&mut self.views.camera);
            for filling in self.panels.filling_mut() {
                filling.release(&self.state, &mut self.views);
            }
            if let Some(filling) = self.panels.filling_of_mut(mode) {
                return filling.fill(ui, &self.state, &mut self.views, self.is_narrow);
            }
            let mut asked = Vec::from_iter(self.show_views(ui));
            // Who learns or presents has a surface to look at.
            let is_free =
                self.panels.lesson.given().is_none() && !self.presenter.is_on() && !self.platform.is_embedded();
            if self.invites && is_free && self.state.shows_sample() {
                invitation::show(ui, self.views.first(), &mut asked);
            }
            asked
        });
        self.act_on_all(asked.inner, ui.ctx());
        let mut asked = Vec::new();
        self.panels.all_mut().into_iter().for_each(|panel| panel.show_over(ui, &mut asked));
        self.act_on_all(asked, ui.ctx());
    }

    /// Shows the two views of the method; what a click in them asks for.
    fn show_views(&mut self, ui: &mut Ui) -> Option<Action> {
        let shape = (self.is_narrow, self.is_low(ui));
        let State { document, settings, measures, .. } = &self.state;
        let (document, keep) = (document.as_ref(), settings.keep);
        self.views.take_slices(self.panels.scan.scans.kept(document.map(|document| &document.source)));
        let subject = Subject { document, keep, measures };
        let mut over = Over {
            measuring: &mut self.panels.measure,
            is_measuring: self.beside == Beside::Measure,
            collapses: &self.panels.collapses,
        };
        let piece = match self.views.show(ui, subject, &mut over, shape)? {
            Clicked::Place(asked) => return Some(asked),
            Clicked::Measure(asked) => return Some(Action::Measure(asked)),
            Clicked::Vertex(node) => return Some(Action::Collapses(collapses::Action::Why(node))),
            Clicked::Piece(piece) => piece,
        };
        let pieces = &document?.pieces;
        let adds = ui.input(|input| input.modifiers.shift || input.modifiers.command);
        let keep = if adds { pieces.toggled(keep, piece) } else { pieces.only(piece) };
        Some(Action::Set(Box::new(Settings { keep, ..settings.clone() })))
    }
}

/// The way from a part of another page to the whole program.
fn way_to_whole(ui: &mut Ui, link: String) {
    let whole = Hyperlink::from_label_and_url(RichText::new(say!("app-whole")).small(), link);
    ui.add(whole.open_in_new_tab(true)).on_hover_text(say!("app-whole-help"));
}
