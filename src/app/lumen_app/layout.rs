//! Where everything stands in the window: bars, panels, views and what lies over them.

use egui::{CentralPanel, Frame, Margin, Panel, ScrollArea, Ui};

use super::LumenApp;
use crate::app::action::{Action, of_trial};
use crate::app::drawer::Stops;
use crate::app::state::State;
use crate::app::views::{Clicked, Subject};
use crate::app::{bar, collapses, lesson, measure, panel, scan, theme, trial, verdict, vessels};
use crate::pipeline::settings::{Keep, Settings};

impl LumenApp {
    /// Whether the measures are shown: a trial, a scan and a comparison take their place.
    pub(super) fn shows_measuring(&self) -> bool {
        self.measuring.is_open && !(self.trial.is_open() || self.scans.is_open() || self.state.comparison.is_open())
    }

    /// Whether the vessels are shown: a trial and a comparison take their place.
    pub(super) fn shows_vessels(&self) -> bool {
        self.vessels.is_open && !self.trial.is_open() && !self.state.comparison.is_open()
    }

    /// Shows the bars and the panel, and does what is asked for there.
    pub(super) fn controls(&mut self, ui: &mut Ui, is_narrow: bool) {
        let bar = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 6));
        let mut asked = Vec::new();
        let in_trial = self.trial.is_open();
        let (keeps_surface, has_links) = (self.recovery.keeps(&mut *self.platform), self.platform.address().is_some());
        Panel::top("top").frame(bar).exact_size(theme::row(ui.ctx(), 36.0) + 12.0).show(ui, |ui| {
            let are_vessels_open = self.shows_vessels();
            let (in_scan, record) = (self.scans.is_open(), self.record.chosen());
            let is_presenting = self.presenter.is_on();
            let (is_measuring, language) = (self.shows_measuring(), self.speech.chosen());
            let shown = bar::Shown {
                in_trial,
                in_scan,
                is_narrow,
                are_vessels_open,
                is_presenting,
                is_measuring,
                keeps_surface,
                has_links,
                language,
                record,
            };
            bar::top(ui, &self.state, &self.views, shown, &mut asked);
        });
        let inside = ui.available_width() - bar.inner_margin.sum().x;
        let notice = bar::notice(ui, &self.state, &self.views, is_narrow, inside);
        let height = notice.as_ref().map_or(0.0, |notice| notice.size().y).max(theme::row(ui.ctx(), 28.0));
        Panel::bottom("status").frame(bar).exact_size(height + 12.0).show(ui, |ui| {
            // Of one height whatever is told of work, or the views would move with it: of egui's least the panel's edge is
            // taken off.
            ui.set_min_height(height);
            if let Some(opening) = self.scans.opening() {
                let mut of_scan = Vec::new();
                ui.horizontal_centered(|ui| scan::status(ui, opening, is_narrow, &mut of_scan));
                return asked.extend(of_scan.into_iter().map(Action::Scan));
            }
            bar::status(ui, &self.state, &self.views, notice, self.record.progress(), is_narrow, &mut asked);
        });
        let has_pads = in_trial && !self.scans.is_open();
        if has_pads && is_narrow {
            // Below all else: where the thumbs are of whoever holds a phone.
            Panel::bottom("pads").frame(bar).exact_size(72.0).show(ui, |ui| self.trial.pads(ui));
        }
        if let Some(given) = self.lessons.given() {
            let card = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
            let height = (ui.available_height() * 0.28).clamp(120.0, 210.0);
            Panel::bottom("lesson").frame(card).exact_size(height).show(ui, |ui| {
                lesson::card::show(ui, given, has_links, &mut asked);
            });
        }
        let takes_panel = is_narrow && (self.shows_vessels() || self.shows_measuring());
        let part = if self.lessons.given().is_some() { 0.35 } else { 0.45 };
        // On a phone the panel is drawn up and down.
        let is_drawn = is_narrow && theme::suits_finger(ui.ctx());
        let shows_method = !(in_trial || self.scans.is_open() || takes_panel);
        let peek = if shows_method { panel::PEEK } else { 8.0 };
        let stops = Stops::new(ui.available_height(), part, peek);
        let panel = if is_drawn {
            Panel::bottom("panel").exact_size(self.drawer.height(stops))
        } else if is_narrow {
            Panel::bottom("panel").exact_size(ui.available_height() * part)
        } else {
            Panel::left("panel").resizable(true).default_size(296.0).size_range(256.0..=440.0)
        };
        let margin = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
        let of_panel = Margin { top: if is_drawn { 0 } else { 8 }, ..margin.inner_margin };
        // The trial and a scan cannot be used without.
        let has_panel = !self.presenter.is_on() || in_trial || self.scans.is_open() || takes_panel;
        if has_panel {
            panel.frame(margin.inner_margin(of_panel)).show(ui, |ui| {
                if is_drawn {
                    self.drawer.handle(ui, stops);
                    if self.drawer.peeks(stops) {
                        ui.spacing_mut().item_spacing.y = 3.0;
                        if shows_method {
                            panel::peek(ui, &self.state, &mut asked);
                        }
                        return;
                    }
                }
                if takes_panel && self.shows_measuring() {
                    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                        ui.set_max_width(ui.available_width() - 8.0);
                        measure::show(ui, &self.measuring, &self.state, &self.views, true, &mut asked);
                    });
                    return;
                }
                if takes_panel {
                    return vessels::show(ui, &self.vessels, &self.state, &self.views, true, &mut asked);
                }
                if has_pads && !is_narrow {
                    self.trial.pads(ui);
                }
                self.scrolled_panel(ui, in_trial, &mut asked);
            });
        }
        if !(in_trial || self.scans.is_open() || self.state.comparison.is_open() || takes_panel) {
            let strip = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 4));
            Panel::top("verdict").frame(strip).exact_size(verdict::height(ui.ctx(), is_narrow) + 8.0).show(ui, |ui| {
                verdict::show(ui, &self.state, is_narrow, &mut asked);
            });
        }
        if self.shows_measuring() && !is_narrow {
            let beside = Panel::right("measure").resizable(true).default_size(264.0).size_range(232.0..=400.0);
            beside.frame(margin).show(ui, |ui| {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    ui.set_max_width(ui.available_width() - 8.0);
                    measure::show(ui, &self.measuring, &self.state, &self.views, false, &mut asked);
                });
            });
        }
        let shows_views = !(in_trial || self.scans.is_open() || self.state.comparison.is_open());
        if shows_views && self.views.collapses.is_open() {
            // On a phone the buttons take two rows.
            let (height, rows) = if is_narrow { (120.0, 2.0) } else { (104.0, 1.0) };
            let taller = theme::row(ui.ctx(), 28.0) - 28.0;
            let below = Panel::bottom("collapses").frame(margin).exact_size(height + rows * taller);
            below.show(ui, |ui| self.views.collapses.show(ui, &self.state, &mut asked));
        }
        if self.shows_vessels() && !is_narrow {
            let height = (ui.available_height() * 0.4).clamp(160.0, 320.0);
            let below = Panel::bottom("vessels").resizable(true).default_size(height).size_range(120.0..=480.0);
            below.frame(margin).show(ui, |ui| {
                vessels::show(ui, &self.vessels, &self.state, &self.views, false, &mut asked);
            });
        }
        self.act_on_all(asked, ui.ctx());
    }

    /// Shows what the panel has for the scan, the trial or the method, in a column that scrolls.
    pub(super) fn scrolled_panel(&mut self, ui: &mut Ui, in_trial: bool, asked: &mut Vec<Action>) {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            // Room for the scroll bar beside what stands at the right.
            ui.set_max_width(ui.available_width() - 8.0);
            ui.spacing_mut().item_spacing.y = 3.0;
            if let Some(scan) = self.scans.shown() {
                let mut of_scan = Vec::new();
                scan::panel(ui, scan, &mut of_scan);
                return asked.extend(of_scan.into_iter().map(Action::Scan));
            }
            let of_trial = if in_trial { self.trial_panel(ui) } else { self.method_panel(ui) };
            asked.extend(of_trial);
        });
    }

    /// Shows the method from top to bottom. What its steps set is done at once: what follows, and the views, are of the
    /// level that was just asked for. Returns what is asked of the trial.
    pub(super) fn method_panel(&mut self, ui: &mut Ui) -> Vec<Action> {
        for (id, step) in panel::STEPS {
            let mut asked = Vec::new();
            ui.push_id(id, |ui| step(ui, &self.state, &self.views, &mut asked));
            self.act_on_all(asked, ui.ctx());
            let source = self.state.document.as_ref().map(|document| &document.source);
            if let ("surface", Some(kept)) = (id, self.scans.kept(source)) {
                let mut asked = Vec::new();
                ui.push_id("slices", |ui| scan::slices_panel(ui, kept, &mut asked));
                self.act_on_all(asked.into_iter().map(Action::Scan), ui.ctx());
            }
        }
        self.state.show_level();
        let asked = ui.push_id("trial", |ui| self.trial_panel(ui)).inner;
        let mut of_result = Vec::new();
        ui.push_id("result", |ui| panel::result(ui, &self.state, &mut of_result));
        asked.into_iter().chain(of_result).collect()
    }

    pub(super) fn trial_panel(&self, ui: &mut Ui) -> Vec<Action> {
        let (smoothing, document) = (&self.state.settings.smoothing, self.state.document.as_ref());
        let mut asked = Vec::new();
        trial::panel(ui, &self.trial, smoothing, document, &mut asked);
        of_trial(asked).collect()
    }

    /// Shows the views, and what lies over them.
    pub(super) fn centre(&mut self, ui: &mut Ui, is_narrow: bool) {
        let keep = self.state.settings.keep;
        let asked = CentralPanel::default()
            .frame(Frame::new().fill(ui.visuals().widgets.noninteractive.bg_stroke.color))
            .show(ui, |ui| {
                let State { document, comparison, settings, measures, .. } = &self.state;
                let document = document.as_ref();
                if std::mem::take(&mut self.look_next) {
                    self.views.look_first(document, keep);
                    self.recovery.look(&mut self.views.camera);
                }
                if !comparison.is_open() {
                    self.compare.let_go(&mut self.views);
                }
                if !(self.trial.is_open() || self.trial.tables.needs_views()) {
                    self.trial_view.let_go();
                }
                if let Some(scan) = self.scans.shown() {
                    self.scan_view.show(ui, scan, &mut self.views, is_narrow);
                    return Vec::new();
                }
                self.scan_view.let_go();
                if self.trial.is_open() {
                    let trial = &mut self.trial;
                    let asked = self.trial_view.show(ui, trial, &mut self.views, document, keep, is_narrow);
                    return Vec::from_iter(asked.map(Action::Trial));
                }
                if comparison.is_open() {
                    return self.compare.show(ui, comparison, &mut self.views, settings, document, is_narrow);
                }
                self.views.take_slices(self.scans.kept(document.map(|document| &document.source)));
                let subject = Subject { document, keep, measures };
                let piece = match self.views.show(ui, subject, &mut self.measuring, is_narrow) {
                    None => return Vec::new(),
                    Some(Clicked::Place(asked)) => return vec![asked],
                    Some(Clicked::Measure(asked)) => return vec![Action::Measure(asked)],
                    Some(Clicked::Vertex(node)) => return vec![Action::Collapses(collapses::Action::Why(node))],
                    Some(Clicked::Piece(piece)) => piece,
                };
                let is_largest = document.and_then(|document| document.pieces.by_size.first()) == Some(&piece);
                let keep = if is_largest { Keep::Largest } else { Keep::Component(piece) };
                vec![Action::Set(Box::new(Settings { keep, ..settings.clone() }))]
            });
        self.act_on_all(asked.inner, ui.ctx());
        self.trial_view.time_tables(ui, &mut self.trial.tables);
        let mut asked = Vec::new();
        trial::tables(ui, &self.trial.tables, &mut asked);
        self.act_on_all(of_trial(asked), ui.ctx());
    }
}
