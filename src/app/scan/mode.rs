//! A scan as a mode of the window.

use egui::Ui;

use super::action::Action as OfScan;
use super::state::Scans;
use super::view::ScanView;
use super::{panel, slices_panel};
use crate::app::action::Action;
use crate::app::filling::Filling;
use crate::app::mode::{Acting, Beside, Layer, Mode, Now, Panel};
use crate::app::platform::Platform;
use crate::app::row;
use crate::app::state::State;
use crate::app::views::Views;

/// A scan: what is known of it, and its views.
#[derive(Default)]
pub(in crate::app) struct ScanPanel {
    pub(in crate::app) scans: Scans,
    view: ScanView,
}

impl ScanPanel {
    /// Shows which slices stand behind the surface, where they are those of a scan that is kept.
    pub(in crate::app) fn show_slices(&self, ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
        let source = state.document.as_ref().map(|document| &document.source);
        if let Some(kept) = self.scans.kept(source) {
            let mut of_scan = Vec::new();
            ui.push_id("slices", |ui| slices_panel::show(ui, kept, &mut of_scan));
            asked.extend(of_scan.into_iter().map(Action::Scan));
        }
    }
}

impl Panel for ScanPanel {
    fn id(&self) -> &'static str {
        "scan"
    }

    fn is_there(&self, _: &State, _: Beside) -> bool {
        self.scans.is_open()
    }

    fn mode(&self) -> Option<Mode> {
        Some(Mode::Scan)
    }

    fn replaces_method(&self) -> bool {
        true
    }

    fn leaves_short_cuts(&self) -> bool {
        false
    }

    fn blocks(&self, action: &Action) -> bool {
        // What lies below the scan is not to be seen.
        !matches!(action, Action::Open | Action::Help)
    }

    fn escape(&self, _: Now<'_>, layer: Layer) -> Option<Action> {
        match layer {
            Layer::Awaited => self.scans.opening().map(|_| Action::Scan(OfScan::Cancel)),
            Layer::Open => self
                .scans
                .shown()
                .map(|scan| Action::Scan(if scan.is_making() { OfScan::Cancel } else { OfScan::Close })),
            Layer::Held | Layer::Underway => None,
        }
    }

    fn show(&mut self, ui: &mut Ui, _: Now<'_>, asked: &mut Vec<Action>) {
        let Some(scan) = self.scans.shown() else { return };
        let mut of_scan = Vec::new();
        row::scrolled(ui, |ui| panel::show(ui, scan, &mut of_scan));
        asked.extend(of_scan.into_iter().map(Action::Scan));
    }

    fn show_status(&self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Action>) -> bool {
        let Some(opening) = self.scans.opening() else { return false };
        let mut of_scan = Vec::new();
        ui.horizontal_centered(|ui| panel::status(ui, opening, now.is_narrow, &mut of_scan));
        asked.extend(of_scan.into_iter().map(Action::Scan));
        true
    }

    fn act(&mut self, action: Action, acting: &mut Acting<'_>) -> Option<Action> {
        let Action::Scan(action) = action else { return Some(action) };
        if let Some(link) = acting.platform.scans() {
            self.scans.act(action, link);
        }
        None
    }

    fn leave_surface(&mut self, acting: &mut Acting<'_>) {
        if let Some(link) = acting.platform.scans() {
            let source = acting.state.document.as_ref().map(|document| &document.source);
            self.scans.surface_opened(source, link);
        }
    }

    fn goes_on(&self, _: &dyn Platform) -> bool {
        self.scans.opening().is_some() || self.scans.is_open() || self.scans.awaits_slice()
    }
}

impl Filling for ScanPanel {
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        self.view.set_device(device);
    }

    fn refuse(&mut self) {
        self.view.refuse();
    }

    fn release(&mut self, _: &State, _: &mut Views) {
        if !self.scans.is_open() {
            self.view.release();
        }
    }

    fn fill(&mut self, ui: &mut Ui, _: &State, views: &mut Views, is_narrow: bool) -> Vec<Action> {
        let clicked = self.scans.shown().and_then(|scan| self.view.show(ui, scan, views, is_narrow));
        clicked.map(|seed| Action::Scan(OfScan::Seed(Some(seed)))).into_iter().collect()
    }
}
