//! The operator's hand: keys, the pads on the screen and a gamepad, as feed and roll.

use egui::{Context, Event, Id, Key, Pos2, Rect, Sense, Stroke, TouchPhase, Ui, WidgetInfo, pos2, vec2};

use crate::app::keys::Keys;
use crate::app::platform::Gamepad;
use crate::engine::trial::HAND;
use crate::say;
use crate::trial::setup::Input;

/// Feed by a key, and with Shift, in mm/s.
const FEED: [f32; 2] = [15.0, Input::MAX_FEED];
/// Roll by a key, and with Shift, in rad/s: half a turn a second, and two.
const ROLL: [f32; 2] = [std::f32::consts::PI, Input::MAX_ROLL];
/// Height of a pad, in points.
const PAD: f32 = 56.0;

/// A pad that springs back to its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pad {
    Feed,
    Roll,
}

/// The operator's hand, and what the engine was told of it.
#[derive(Default)]
pub(super) struct Hand {
    pads: Pads,
    /// The input that the engine has, and when it was told, by the window's clock.
    told: Input,
    told_s: f64,
}

impl Hand {
    /// What it does now.
    pub(super) fn input(&mut self, ctx: &Context, keys: Keys, gamepad: Option<Gamepad>) -> Input {
        self.pads.input(ctx, keys, gamepad)
    }

    /// Shows the pads, side by side.
    pub(super) fn pads(&mut self, ui: &mut Ui) {
        self.pads.show(ui);
    }

    /// The input that the engine has.
    pub(super) fn told(&self) -> Input {
        self.told
    }

    /// Whether `input` has to be told at `now_s`: where it has changed, and again and again while the hand is on the wire,
    /// as the engine lets go of what it does not hear of any more. Then it counts as told.
    pub(super) fn tell(&mut self, input: Input, now_s: f64, steers_itself: bool) -> bool {
        let is_held = input != Input::default() && !steers_itself;
        let is_due = is_held && now_s - self.told_s >= HAND / 5.0;
        let is_news = input != self.told || is_due;
        if is_news {
            (self.told, self.told_s) = (input, now_s);
        }
        is_news
    }

    /// The engine begins anew, and has no input.
    pub(super) fn forget_told(&mut self) {
        self.told = Input::default();
    }

    /// The window's clock begins anew, and the fingers were on another canvas.
    pub(super) fn restart_clock(&mut self) {
        self.pads.release();
        self.told_s = f64::NEG_INFINITY;
    }
}

/// How far each pad is pushed, -1 to 1.
#[derive(Clone, Debug, Default)]
struct Pads {
    feed: f32,
    roll: f32,
    /// Fingers on the pads: egui has one pointer, and two pads may be held at once.
    fingers: Vec<(u64, Pad)>,
    /// Whether the pointer was let go while it was down: it counts again when it is pressed anew.
    is_let_go: bool,
}

impl Pads {
    /// What the hand does now. It rests while the window is hidden or without attention, and under a sheet; keys rest
    /// while others have them.
    fn input(&mut self, ctx: &Context, keys: Keys, gamepad: Option<Gamepad>) -> Input {
        let is_seen = ctx.input(|input| input.raw.focused && input.viewport().visible() != Some(false));
        if !is_seen || keys == Keys::Sheet {
            self.release();
            return Input::default();
        }
        let (mut feed, mut roll) = (0.0, 0.0);
        if keys == Keys::Views {
            // Arrows belong to a control that has the focus.
            let is_free = ctx.memory(|memory| memory.focused().is_none());
            let (ahead, aside, fast) = ctx.input(|input| {
                let held =
                    |letter, arrow| f32::from(u8::from(input.key_down(letter) || is_free && input.key_down(arrow)));
                let is_command = input.modifiers.command || input.modifiers.alt;
                let ahead = held(Key::W, Key::ArrowUp) - held(Key::S, Key::ArrowDown);
                let aside = held(Key::D, Key::ArrowRight) - held(Key::A, Key::ArrowLeft);
                if is_command { (0.0, 0.0, false) } else { (ahead, aside, input.modifiers.shift) }
            });
            feed += ahead * FEED[usize::from(fast)];
            roll += aside * ROLL[usize::from(fast)];
        }
        // Slow near the middle, fast at the end.
        let eased = |x: f32| x * x.abs();
        feed += eased(self.feed) * Input::MAX_FEED;
        roll += eased(self.roll) * Input::MAX_ROLL;
        if let Some(pad) = gamepad {
            let reach = usize::from(pad.fast);
            feed += eased(pad.feed) * FEED[reach];
            roll += eased(pad.roll) * ROLL[reach];
        }
        Input { feed, roll }.limited()
    }

    /// Takes the hand off the pads: that it comes off while nobody looks is not heard.
    fn release(&mut self) {
        *self = Self { is_let_go: true, ..Self::default() };
    }

    /// Shows both pads, side by side.
    fn show(&mut self, ui: &mut Ui) {
        let gap = ui.spacing().item_spacing.x;
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width() - 8.0, PAD), Sense::hover());
        let (left, right) = rect.split_left_right_at_fraction(0.5);
        let left = left.with_max_x(left.right() - gap / 2.0);
        let right = right.with_min_x(right.left() + gap / 2.0);
        self.is_let_go &= !ui.input(|input| input.pointer.any_pressed());
        self.listen(ui, &[(Pad::Feed, left), (Pad::Roll, right)]);
        self.pad(ui, Pad::Feed, left);
        self.pad(ui, Pad::Roll, right);
    }

    /// Follows each finger by itself.
    fn listen(&mut self, ui: &Ui, pads: &[(Pad, Rect)]) {
        let events = ui.input(|input| input.raw.events.clone());
        for event in events {
            let Event::Touch { id, phase, pos, .. } = event else { continue };
            match phase {
                TouchPhase::Start => {
                    if let Some(&(pad, _)) = pads.iter().find(|(_, rect)| rect.contains(pos)) {
                        self.fingers.push((id.0, pad));
                    }
                }
                TouchPhase::Move => {}
                TouchPhase::End | TouchPhase::Cancel => {
                    let lifted = self.fingers.iter().position(|(finger, _)| *finger == id.0);
                    if let Some((_, pad)) = lifted.map(|at| self.fingers.swap_remove(at)) {
                        *self.value(pad) = 0.0;
                    }
                    continue;
                }
            }
            let held = self.fingers.iter().find(|(finger, _)| *finger == id.0).map(|&(_, pad)| pad);
            if let Some((pad, rect)) = pads.iter().copied().find(|(pad, _)| Some(*pad) == held) {
                *self.value(pad) = pushed(rect, pos);
            }
        }
    }

    fn value(&mut self, pad: Pad) -> &mut f32 {
        match pad {
            Pad::Feed => &mut self.feed,
            Pad::Roll => &mut self.roll,
        }
    }

    fn pad(&mut self, ui: &Ui, pad: Pad, rect: Rect) {
        let (salt, label, called, help) = match pad {
            Pad::Feed => ("Feed", say!("devices-feed"), say!("devices-feed-pad"), say!("devices-feed-pad-help")),
            Pad::Roll => ("Roll", say!("devices-roll"), say!("devices-roll-pad"), say!("devices-roll-pad-help")),
        };
        let [left, right] = match pad {
            Pad::Feed => [say!("devices-feed-out"), say!("devices-feed-in")],
            Pad::Roll => [say!("devices-roll-left"), say!("devices-roll-right")],
        };
        let response = ui.interact(rect, Id::unique(("pad", salt)), Sense::drag());
        if !self.fingers.iter().any(|(_, held)| *held == pad) {
            let is_held = response.is_pointer_button_down_on() && !self.is_let_go;
            let at = response.interact_pointer_pos().filter(|_| is_held);
            *self.value(pad) = at.map_or(0.0, |at| pushed(rect, at));
        }
        let value = *self.value(pad);
        let response = response.on_hover_text(help.to_owned());
        response.widget_info(|| WidgetInfo::slider(true, f64::from(value), called.as_str()));
        let visuals = ui.visuals();
        let painter = ui.painter_at(rect);
        let stroke = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color);
        painter.rect(rect, 6.0, visuals.faint_bg_color, stroke, egui::StrokeKind::Inside);
        let (weak, text) = (visuals.weak_text_color(), visuals.text_color());
        let small = egui::FontId::proportional(12.0);
        let top = rect.top() + 10.0;
        painter.text(pos2(rect.center().x, top), egui::Align2::CENTER_CENTER, label.as_str(), small.clone(), text);
        painter.text(pos2(rect.left() + 8.0, top), egui::Align2::LEFT_CENTER, left.as_str(), small.clone(), weak);
        painter.text(pos2(rect.right() - 8.0, top), egui::Align2::RIGHT_CENTER, right.as_str(), small, weak);
        let (y, reach) = (rect.top() + 36.0, rect.width() / 2.0 - 22.0);
        let rail = [pos2(rect.center().x - reach, y), pos2(rect.center().x + reach, y)];
        painter.line_segment(rail, Stroke::new(3.0, visuals.widgets.inactive.bg_fill));
        let knob = pos2(rect.center().x + value * reach, y);
        painter.line_segment([pos2(rect.center().x, y), knob], Stroke::new(3.0, visuals.hyperlink_color));
        let fill = if value == 0.0 { weak } else { visuals.hyperlink_color };
        painter.circle_filled(knob, 11.0, fill);
    }
}

/// How far a pad is pushed from its middle, -1 to 1.
fn pushed(rect: Rect, at: Pos2) -> f32 {
    let part = (at.x - rect.center().x) / (rect.width() / 2.0 - 16.0).max(1.0);
    if part.abs() < 0.05 { 0.0 } else { part.clamp(-1.0, 1.0) }
}
