//! The collapses of the progressive mesh, one by one: what goes next, the hole and what fills it, a step back and forth, slowly
//! by itself; and for a vertex that is clicked where it may go, and what forbids the rest.
//!
//! A step is another number of triangles in the settings, as if it had been typed: what is shown is the level in force.

pub(super) mod action;

use egui::{Button, Color32, Rect, ScrollArea, Shape, Stroke, Ui};
use glam::Vec3;

pub use self::action::Action;
use crate::app::action::Action as Ask;
use crate::app::document::Document;
use crate::app::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel, Place};
use crate::app::places::seen;
use crate::app::platform::Platform;
use crate::app::row::wrapped;
use crate::app::state::State;
use crate::app::theme;
use crate::language::{Key, decimal, inner, tell};
use crate::pipeline::classes::Class;
use crate::pipeline::decimation::{CollapseStatus, Ways};
use crate::pipeline::one_collapse::OneCollapse;
use crate::pipeline::progressive::NEVER;
use crate::pipeline::settings::{Decimation, Method, Target};
use crate::render::Camera;
use crate::say;

/// Seconds from one collapse to the next while they are played; in the first half the hole is shown, then what fills it.
const PERIOD_S: f64 = 1.2;
/// Height of what is seen at a collapse, in times the size of its hole.
const AROUND: f32 = 5.0;

/// The collapses; nothing is known of them while they are not shown.
#[derive(Default)]
pub struct Collapses(Option<Open>);

/// What is shown of the collapses.
#[derive(Default)]
struct Open {
    /// Whether the camera stays where it is.
    stays: bool,
    /// Since when the present level is shown, by the window's clock, while they are played.
    playing_s: Option<f64>,
    /// Of the level that is shown.
    shown: Option<Shown>,
}

/// What is known of a level.
struct Shown {
    /// Document, levels and level that it is of.
    of: [u64; 3],
    next: Option<OneCollapse>,
    asked: Option<(u32, Ways)>,
}

impl Collapses {
    /// Whether they are shown.
    pub fn is_open(&self) -> bool {
        self.0.is_some()
    }

    /// Whether they follow one another.
    pub fn is_playing(&self) -> bool {
        self.0.as_ref().is_some_and(|open| open.playing_s.is_some())
    }

    /// What is known of the level that is shown.
    fn shown(&self) -> Option<&Shown> {
        self.0.as_ref()?.shown.as_ref()
    }

    /// The next collapse of the level that is shown, while they are shown.
    pub fn next(&self) -> Option<&OneCollapse> {
        self.shown()?.next.as_ref()
    }

    /// Where the vertex that was asked for may go.
    pub fn ways(&self) -> Option<&Ways> {
        self.shown()?.asked.as_ref().map(|(_, ways)| ways)
    }

    /// Does what is asked for; `now_s` is the window's clock.
    fn act_on(&mut self, action: Action, state: &mut State, now_s: f64) {
        if action == Action::Toggle {
            self.0 = if self.is_open() { None } else { Some(Open::default()) };
        }
        if let Action::Step(on) = action {
            step(state, on);
        }
        let Some(open) = &mut self.0 else { return };
        match action {
            Action::Toggle => {}
            Action::Step(_) => open.playing_s = open.playing_s.map(|_| now_s),
            Action::Play => open.playing_s = if open.playing_s.is_some() { None } else { Some(now_s) },
            Action::Follow(follows) => open.stays = !follows,
            Action::Why(node) => {
                let document = state.document.as_ref();
                if let (Some(shown), Some(document)) = (&mut open.shown, document) {
                    shown.asked = ways(document, node, method(state)).map(|ways| (node, ways));
                }
            }
        }
    }

    /// Brings them up to the level that is shown, and the camera to where the next is; asks for the next while they are
    /// played.
    pub(super) fn follow(&mut self, document: Option<&Document>, camera: &mut Camera, now_s: f64) -> Option<Ask> {
        let open = self.0.as_mut()?;
        let level = document
            .and_then(|document| Some((document, &document.levels.as_ref()?.1, &document.shown.as_ref()?.level)));
        let Some((document, levels, level)) = level else {
            open.shown = None;
            return None;
        };
        let revision = document.revision;
        let of = [revision.document, revision.levels, revision.shown];
        if open.shown.as_ref().is_none_or(|shown| shown.of != of) {
            let next = levels.collapse_at(level.steps, &level.triangles);
            if let Some(next) = next.as_ref().filter(|_| !open.stays) {
                look_at(camera, next, &levels.positions);
            }
            open.shown = Some(Shown { of, next, asked: None });
        }
        let since_s = now_s - open.playing_s?;
        if open.shown.as_ref().is_none_or(|shown| shown.next.is_none()) {
            open.playing_s = None;
            return None;
        }
        (since_s >= PERIOD_S).then_some(Ask::Collapses(Action::Step(true)))
    }

    /// Shows the controls, and in words what goes next and what was asked for.
    fn controls(&self, ui: &mut Ui, state: &State, asked: &mut Vec<Ask>) {
        let mut ask = |wanted: bool, action: Action| {
            if wanted {
                asked.push(Ask::Collapses(action));
            }
        };
        let steps =
            state.document.as_ref().and_then(|document| document.shown.as_ref()).map_or(0, |shown| shown.level.steps);
        ui.horizontal_wrapped(|ui| {
            let back = ui.add_enabled(steps > 0, Button::new(say!("views-back")));
            ask(back.on_hover_text(say!("views-back-help")).clicked(), Action::Step(false));
            let on = ui.add_enabled(self.next().is_some(), Button::new(say!("views-on")));
            ask(on.on_hover_text(say!("views-on-help")).clicked(), Action::Step(true));
            let play =
                ui.add_enabled(self.next().is_some(), Button::new(say!("views-play")).selected(self.is_playing()));
            ask(play.on_hover_text(say!("views-play-help")).clicked(), Action::Play);
            let mut follows = self.0.as_ref().is_none_or(|open| !open.stays);
            let follow = ui.checkbox(&mut follows, say!("views-follow"));
            ask(follow.on_hover_text(say!("views-follow-help")).changed(), Action::Follow(follows));
            ask(ui.button(say!("views-close")).on_hover_text(say!("views-close-help")).clicked(), Action::Toggle);
        });
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for line in self.words(state, theme::suits_finger(ui.ctx())) {
                wrapped(ui, &line, |text| text);
            }
        });
    }

    /// What there is to say.
    fn words(&self, state: &State, has_finger: bool) -> Vec<String> {
        let mut said = Vec::new();
        let Some((shown, document)) = self.shown().zip(state.document.as_ref()) else { return said };
        let Some((levels, level)) = document.levels.as_ref().zip(document.shown.as_ref()) else { return said };
        let (levels, steps, method) = (&levels.1, level.level.steps, method(state));
        match &shown.next {
            Some(next) => {
                let classes = document.classes();
                let class = classes.and_then(|classes| *classes.by_node.get(next.gone[0] as usize)?);
                let (number, all) = (steps + 1, levels.errors.len());
                let (before, after) = (next.hole.len(), next.patch.len());
                said.push(if next.gone.len() == 1 {
                    let class = class.map_or(String::new(), |class| inner(&tell(&class)));
                    say!("views-next-vertex", number = number, all = all, class = class, before = before, after = after)
                } else {
                    say!("views-next-edge", number = number, all = all, before = before, after = after)
                });
                let (cost, largest) = (decimal(next.cost_mm, 4), decimal(levels.error_after(steps), 4));
                said.push(match class {
                    Some(Class::Boundary | Class::InteriorEdge) if method == Method::Schroeder => {
                        say!("views-next-error-line", cost = cost, largest = largest)
                    }
                    _ => say!("views-next-error", cost = cost, largest = largest),
                });
            }
            None => said.push(say!("views-last-level")),
        }
        match &shown.asked {
            Some((node, ways)) => said.extend(answer(*node, ways, document, &state.settings.decimation)),
            None if has_finger => said.push(say!("views-click-vertex-touch")),
            None => said.push(say!("views-click-vertex")),
        }
        said
    }

    /// Draws the next collapse, and what was asked for, over the view in `rect`. Where they are played the hole comes first,
    /// then what fills it.
    pub(super) fn marks(&self, ui: &Ui, rect: Rect, camera: &Camera, document: &Document) {
        let (Some(shown), Some((_, levels))) = (self.shown(), &document.levels) else { return };
        let painter = ui.painter_at(rect);
        let at = |node: u32| seen(levels.positions[node as usize], camera, rect);
        let (accent, ink) = (ui.visuals().hyperlink_color, ui.visuals().text_color());
        let line = |[a, b]: [u32; 2], stroke: Stroke| {
            if let (Some(a), Some(b)) = (at(a), at(b)) {
                painter.line_segment([a, b], stroke);
            }
        };
        if let Some(next) = &shown.next {
            let playing_s = self.0.as_ref().and_then(|open| open.playing_s);
            let since_s = playing_s.map(|since_s| ui.input(|input| input.time) - since_s);
            if since_s.is_none_or(|since_s| since_s > PERIOD_S / 2.0) {
                for corners in &next.patch {
                    let places: Option<Vec<egui::Pos2>> = corners.iter().map(|&node| at(node)).collect();
                    let Some(places) = places else { continue };
                    painter.add(Shape::convex_polygon(places, accent.gamma_multiply(0.25), Stroke::new(1.5, accent)));
                }
            }
            next.outline.iter().for_each(|&ends| line(ends, Stroke::new(3.0, accent)));
            for place in next.gone.iter().filter_map(|&node| at(node)) {
                painter.circle(place, 5.0, ui.visuals().error_fg_color, Stroke::new(1.5, ink));
            }
        }
        if let Some((node, ways)) = &shown.asked {
            for (other, fate) in &ways.to {
                line([*node, *other], Stroke::new(2.5, colour(ui, *fate)));
            }
            if let Some(place) = at(*node) {
                painter.circle_stroke(place, 8.0, Stroke::new(2.0, ink));
            }
        }
    }
}

const TOGGLE: Ask = Ask::Collapses(Action::Toggle);

impl Panel for Collapses {
    fn id(&self) -> &'static str {
        "collapses"
    }

    fn is_there(&self, _: &State, _: Beside) -> bool {
        self.is_open()
    }

    fn place(&self, ui: &Ui, now: Now<'_>) -> Place {
        // On a phone the buttons take two rows.
        let (height, rows) = if now.is_narrow { (120.0, 2.0) } else { (104.0, 1.0) };
        let taller = theme::row(ui.ctx(), 28.0) - 28.0;
        Place::Below(height + rows * taller, None)
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        Some(Entry {
            group: Group::Learn,
            label: Key("app-collapses"),
            help: Key("app-collapses-help"),
            key: None,
            action: TOGGLE,
            is_open: self.is_open(),
            is_enabled: now.mode == Mode::Method,
        })
    }

    fn escape(&self, _: Now<'_>, layer: Layer) -> Option<Ask> {
        (layer == Layer::Open && self.is_open()).then_some(TOGGLE)
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        self.controls(ui, now.state, asked);
    }

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let Ask::Collapses(action) = action else { return Some(action) };
        let now_s = acting.ctx.input(|input| input.time);
        self.act_on(action, acting.state, now_s);
        None
    }

    fn leave_surface(&mut self, _: &mut Acting<'_>) {
        // Nothing is played in the new one yet.
        if let Some(open) = &mut self.0 {
            open.playing_s = None;
        }
    }

    fn goes_on(&self, _: &dyn Platform) -> bool {
        self.is_playing()
    }
}

/// The method of the levels.
fn method(state: &State) -> Method {
    state.settings.decimation.method
}

/// Goes to the level with a collapse more, or one fewer.
fn step(state: &mut State, on: bool) {
    let Some(document) = &state.document else { return };
    let Some(((_, levels), shown)) = document.levels.as_ref().zip(document.shown.as_ref()) else { return };
    let last = levels.errors.len() as u32;
    let steps = if on { (shown.level.steps + 1).min(last) } else { shown.level.steps.saturating_sub(1) };
    // Each collapse takes a triangle at least: the number names the level.
    state.settings.target = Target::Triangles(levels.triangles_after(steps) as u32);
}

fn ways(document: &Document, node: u32, method: Method) -> Option<Ways> {
    let (levels, level) = (&document.levels.as_ref()?.1, &document.shown.as_ref()?.level);
    Ways::new(levels, &level.triangles, document.classes()?, node, method)
}

/// Looks at a collapse from outside, so near that its surroundings are seen.
fn look_at(camera: &mut Camera, next: &OneCollapse, positions: &[Vec3]) {
    let place = |node: u32| positions[node as usize];
    let middle = place(next.gone[0]);
    let normal: Vec3 = next
        .hole
        .iter()
        .map(|&[a, b, c]| (place(b) - place(a)).cross(place(c) - place(a)))
        .sum::<Vec3>()
        .normalize_or_zero();
    let size = next.outline.iter().flatten().map(|&node| place(node).distance(middle)).fold(0.0, f32::max);
    camera.face(normal);
    camera.focus(middle, AROUND * size);
}

/// What became of a vertex in the run, and of each way for it to go on this level.
fn answer(node: u32, ways: &Ways, document: &Document, decimation: &Decimation) -> Vec<String> {
    let Some((_, levels)) = &document.levels else { return Vec::new() };
    let end = levels.node_ends[node as usize];
    let goes = if end == NEVER {
        say!("views-goes-never")
    } else {
        let (triangles, cost) = (levels.triangles_after(end), levels.costs[end as usize]);
        say!("views-goes-at", count = triangles, cost = decimal(cost, 4))
    };
    let vertex = say!("views-vertex", class = tell(&ways.class));
    if ways.to.is_empty() {
        let why = if ways.class == Class::Complex { say!("views-stays-by-rule") } else { say!("views-stays-crowded") };
        return vec![[vertex, why, goes].join(" ")];
    }
    let kinds = [
        CollapseStatus::Open,
        CollapseStatus::Eased,
        CollapseStatus::OffLine,
        CollapseStatus::Link,
        CollapseStatus::Flip,
        CollapseStatus::Sliver,
    ];
    let count = |kind: CollapseStatus| ways.to.iter().filter(|(_, fate)| *fate == kind).count();
    let parts: Vec<String> =
        kinds.into_iter().filter(|&kind| count(kind) > 0).map(|kind| way(kind, count(kind))).collect();
    let neighbours = say!("views-ways", count = ways.to.len(), ways = parts.join(", "));
    let mut said = vec![vertex, goes, neighbours];
    said.push(match decimation.method {
        Method::Schroeder => say!("views-unseen"),
        Method::Quadric => say!("views-unseen-quadric"),
    });
    if decimation.keep_labels {
        said.push(say!("views-unseen-borders"));
    }
    vec![said.join(" ")]
}

/// How many ways are of a kind.
fn way(kind: CollapseStatus, count: usize) -> String {
    match kind {
        CollapseStatus::Open => say!("views-way-open", count = count),
        CollapseStatus::Eased => say!("views-way-eased", count = count),
        CollapseStatus::OffLine => say!("views-way-off-line", count = count),
        CollapseStatus::Link => say!("views-way-link", count = count),
        CollapseStatus::Flip => say!("views-way-flip", count = count),
        CollapseStatus::Sliver => say!("views-way-sliver", count = count),
    }
}

/// The colour of a way.
fn colour(ui: &Ui, fate: CollapseStatus) -> Color32 {
    match fate {
        CollapseStatus::Open => ui.visuals().hyperlink_color,
        CollapseStatus::Eased => ui.visuals().warn_fg_color,
        CollapseStatus::OffLine | CollapseStatus::Link | CollapseStatus::Flip | CollapseStatus::Sliver => {
            ui.visuals().error_fg_color
        }
    }
}
