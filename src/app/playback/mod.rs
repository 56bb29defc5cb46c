//! The progressive mesh played: from all triangles to one in a thousand and back, at a speed of the user's choice.
//!
//! What is shown is the target of the settings, as if its slider were dragged. The target that was there before comes back when
//! the panel is closed.

pub(super) mod action;

use std::ops::RangeInclusive;

use egui::{Align, Label, Layout, Role, Slider, Ui};

pub use self::action::Action;
use super::action::Action as Ask;
use super::assist::describe;
use super::document::Document;
use super::icon::{self, Icon};
use super::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel, Place};
use super::platform::Platform;
use super::record;
use super::state::State;
use crate::language::{Key, decimal};
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::settings::{Settings, Target};
use crate::say;

/// Seconds there and back: at first, and what can be chosen.
const PERIOD_S: (f64, RangeInclusive<f64>) = (12.0, 4.0..=60.0);
/// One triangle in so many is left at the far end: 99.9 %.
const LEAST_PART: f64 = 1000.0;
/// From this width on all of it stands in one row, in points, and what its panel leaves at both sides.
const ROW: f32 = 720.0;
const MARGIN: f32 = 32.0;
/// The longest step of the clock, in seconds: after a pause of the window it goes on where it was.
const LONGEST_S: f64 = 0.1;

/// The reduction that is played; nothing while the panel is closed.
#[derive(Default)]
pub struct Playback(Option<Open>);

struct Open {
    /// The target that comes back.
    before: Target,
    /// The target that was set last.
    set: Option<Target>,
    /// How far it is: 0 and 1 are all triangles, 0.5 the fewest.
    phase: f64,
    period_s: f64,
    /// The window's clock a frame ago, while it plays.
    playing_s: Option<f64>,
}

/// How many triangles there are at a place on the way: as many times fewer in each second.
pub(super) fn count(levels: &ProgressiveMesh, phase: f64) -> usize {
    let way = 1.0 - (2.0 * phase.rem_euclid(1.0) - 1.0).abs();
    (levels.triangles.len() as f64 * libm::pow(LEAST_PART, -way)).round() as usize
}

/// As "90.0 %: 7,430 triangles".
pub(super) fn told(levels: &ProgressiveMesh, left: usize) -> String {
    let percent = decimal(100.0 * (1.0 - left as f64 / levels.triangles.len().max(1) as f64), 1);
    say!("app-playback-level", percent = percent, count = left)
}

fn levels(document: Option<&Document>) -> Option<&ProgressiveMesh> {
    Some(&document?.levels.as_ref()?.1)
}

impl Playback {
    /// Whether it plays.
    pub(super) fn is_playing(&self) -> bool {
        self.0.as_ref().is_some_and(|open| open.playing_s.is_some())
    }

    /// The settings of this frame, where they are others; `now_s` is the window's clock. Whoever sets another target takes
    /// over.
    pub(super) fn follow(&mut self, state: &State, mode: Mode, now_s: f64) -> Option<Ask> {
        let open = self.0.as_mut()?;
        let levels = levels(state.document.as_ref())?;
        if open.set.is_some_and(|set| set != state.settings.target) {
            (open.playing_s, open.set, open.before) = (None, None, state.settings.target);
        }
        if mode != Mode::Method {
            return Some(TOGGLE);
        }
        let since_s = now_s - open.playing_s?;
        open.playing_s = Some(now_s);
        open.phase = (open.phase + since_s.clamp(0.0, LONGEST_S) / open.period_s).fract();
        let target = Target::Triangles(count(levels, open.phase) as u32);
        open.set = Some(target);
        (target != state.settings.target).then(|| Ask::Set(Box::new(Settings { target, ..state.settings.clone() })))
    }

    /// Closes the panel, and gives back the target that was there before.
    pub(super) fn close(&mut self, state: &mut State) {
        if let Some(open) = self.0.take()
            && open.set == Some(state.settings.target)
        {
            state.settings.target = open.before;
        }
    }
}

const TOGGLE: Ask = Ask::Playback(Action::Toggle);

impl Panel for Playback {
    fn id(&self) -> &'static str {
        "playback"
    }

    fn is_there(&self, _: &State, _: Beside) -> bool {
        self.0.is_some()
    }

    fn place(&self, ui: &Ui, _: Now<'_>) -> Place {
        let rows = if ui.available_width() < ROW { 2.0 } else { 1.0 };
        let height = ui.spacing().interact_size.y;
        Place::Below(rows * height + (rows - 1.0) * ui.spacing().item_spacing.y + 16.0, None)
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        Some(Entry {
            group: Group::Learn,
            label: Key("app-playback"),
            help: Key("app-playback-help"),
            key: None,
            action: TOGGLE,
            is_open: self.0.is_some(),
            is_enabled: now.has_level() && now.mode == Mode::Method || self.0.is_some(),
        })
    }

    fn escape(&self, _: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && self.0.is_some()).then_some(TOGGLE)
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        let Some(open) = &self.0 else { return };
        let mut ask = |wanted: bool, action: Ask| {
            if wanted {
                asked.push(action);
            }
        };
        let (plays, mut period_s) = (open.playing_s.is_some(), open.period_s);
        let is_row = ui.available_width() + MARGIN >= ROW;
        let document = now.state.document.as_ref();
        let counts = levels(document).zip(document.and_then(|document| document.shown.as_ref()));
        let level = counts.map(|(levels, shown)| told(levels, shown.level.triangles.len()));
        let mut row = |ui: &mut Ui, has_speed: bool, has_level: bool| {
            ui.horizontal(|ui| {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if has_speed {
                        let (close, help) = (say!("app-playback-close"), say!("app-playback-close-help"));
                        ask(icon::button(ui, Icon::Close, true, &close, &help).clicked(), TOGGLE);
                    }
                    if has_level {
                        let save = ui.button(say!("app-playback-save")).on_hover_text(say!("app-playback-save-help"));
                        ask(save.clicked(), Ask::Record(record::Action::Film));
                    }
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        if has_speed {
                            let words = if plays { say!("app-playback-pause") } else { say!("app-playback-play") };
                            let play = ui.button(words).on_hover_text(say!("app-playback-play-help"));
                            ask(play.clicked(), Ask::Playback(Action::Play));
                            let slider = Slider::new(&mut period_s, PERIOD_S.1).logarithmic(true).suffix(" s");
                            let slider = ui.add(slider.max_decimals(0)).on_hover_text(say!("app-playback-period-help"));
                            describe(&slider, Role::Slider, &say!("app-playback-period"), period_s);
                            ask(slider.changed(), Ask::Playback(Action::Last(period_s)));
                        }
                        if let Some(level) = level.as_ref().filter(|_| has_level) {
                            ui.add(Label::new(level).truncate());
                        }
                    });
                });
            });
        };
        row(ui, true, is_row);
        if !is_row {
            row(ui, false, true);
        }
    }

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let Ask::Playback(action) = action else { return Some(action) };
        let now_s = acting.ctx.input(|input| input.time);
        match (action, &mut self.0) {
            (Action::Toggle, Some(_)) => self.close(acting.state),
            (Action::Toggle, none) => {
                let before = acting.state.settings.target;
                let playing_s = Some(now_s);
                *none = Some(Open { before, set: None, phase: 0.0, period_s: PERIOD_S.0, playing_s });
            }
            (Action::Play, Some(open)) => {
                open.playing_s = if open.playing_s.is_some() { None } else { Some(now_s) };
            }
            (Action::Last(period_s), Some(open)) => open.period_s = period_s,
            (_, None) => {}
        }
        None
    }

    fn leave_surface(&mut self, acting: &mut Acting<'_>) {
        self.close(acting.state);
    }

    fn goes_on(&self, _: &dyn Platform) -> bool {
        self.is_playing()
    }
}
