//! What a finger on a slider is about: along the slider it moves the value, up or down it scrolls the panel. It is known
//! after the first few points of its way, and till then nothing moves. A mouse, which has a wheel, moves the value at once.
//!
//! Lifted on its way it leaves the panel its speed, which goes down by the law of egui's `KineticScrollStyle`, as where the
//! panel itself was held: the rest of the way is the speed times the law's time constant, and a part of it that is the same
//! in equal times is gone.

use egui::style::ScrollAnimation;
use egui::{Event, Id, Pos2, Response, Ui, vec2};

/// How far a finger goes before it is known what it is about, in points.
const KNOWN: f32 = 8.0;

/// Of a frame that took longer no more is made up for, in seconds.
const LONGEST_S: f32 = 0.1;

/// Where a panel is farther than this from where it was left, something else moves it or it is at its end, in points.
const OFF: f32 = 1.5;

/// What the pointer that is down is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// It moves what it holds: a finger that goes aside or only taps, a mouse. So do keys.
    Moves,
    /// It is not known yet.
    Open,
    /// It scrolls.
    Scrolls,
}

/// A finger that was put down: where, and what it is about.
#[derive(Clone, Copy)]
struct Finger {
    from: Pos2,
    way: Way,
}

impl Way {
    /// That of the pointer that is down in this frame, or comes up in it.
    pub(super) fn of(ui: &Ui) -> Self {
        let id = Id::unique("swipe");
        let (is_new, is_up, at, by_finger) = ui.input(|input| {
            let pointer = &input.pointer;
            // Where a pen or a finger taps within a frame, it is up again by its end.
            let is_touched = input.any_touches() || input.events.iter().any(|e| matches!(e, Event::Touch { .. }));
            let is_held = pointer.any_down() || pointer.any_released();
            let at = pointer.interact_pos().filter(|_| is_held);
            (pointer.any_pressed(), pointer.any_released(), at.zip(pointer.press_origin().or(at)), is_touched)
        });
        let Some((at, from)) = at else { return Self::Moves };
        ui.data_mut(|data| {
            if is_new && by_finger {
                data.insert_temp(id, Finger { from, way: Self::Open });
            } else if is_new {
                data.remove::<Finger>(id);
            }
            let Some(mut finger) = data.get_temp::<Finger>(id) else { return Self::Moves };
            let way = (at - finger.from).abs();
            if finger.way == Self::Open && way.max_elem() >= KNOWN {
                finger.way = if way.y > way.x { Self::Scrolls } else { Self::Moves };
                data.insert_temp(id, finger);
            }
            if finger.way == Self::Open && is_up { Self::Moves } else { finger.way }
        })
    }

    /// Takes what a control sets, where the pointer moves it; gives the value that it then has.
    pub(super) fn take(self, value: &mut f64, set: Option<f64>) -> f64 {
        if let (Self::Moves, Some(set)) = (self, set) {
            *value = set;
        }
        *value
    }

    /// Scrolls what the control stands in, where the finger that holds it is about that. Says whether what it has set is to
    /// be put back, where it was not asked through [`Self::take`].
    pub(super) fn scroll(self, ui: &Ui, control: &Response) -> bool {
        if self == Self::Scrolls && control.dragged() {
            ui.scroll_with_delta_animation(vec2(0.0, control.drag_delta().y), ScrollAnimation::none());
        } else if self == Self::Scrolls && control.drag_stopped() {
            Coast::begin(ui, control);
        } else {
            Coast::go_on(ui, control);
        }
        self != Self::Moves && (control.dragged() || control.drag_stopped())
    }
}

/// The way that a panel goes on after the finger that has scrolled it was lifted.
#[derive(Clone, Copy)]
struct Coast {
    /// The control that the finger was on.
    control: Id,
    /// What is left of the way, in points; down is positive.
    rest: f32,
    /// Where the control's top is to be by what the last frames have asked for, the newest last, if nothing else moves it: a
    /// panel is there a frame or two later.
    tops: [f32; 3],
}

impl Coast {
    fn begin(ui: &Ui, control: &Response) {
        let rest = ui.input(|input| input.pointer.velocity().y) * ui.spacing().scroll.kinetic.decay_time;
        Self { control: control.id, rest, tops: [control.rect.top(); 3] }.keep(ui);
    }

    /// Goes a frame on, where it is this control's. A finger or a wheel ends it, and so does the end of the panel.
    fn go_on(ui: &Ui, control: &Response) {
        let found = ui.data_mut(|data| data.get_temp::<Self>(Self::id()));
        let Some(coast) = found.filter(|coast| coast.control == control.id) else { return };
        let (dt_s, is_held) = ui.input(|input| (input.stable_dt.min(LONGEST_S), input.pointer.any_down()));
        let [.., before, last] = coast.tops;
        let (top, [low, high]) =
            (control.rect.top(), [f32::min, f32::max].map(|of| coast.tops.into_iter().fold(last, of)));
        let is_moved = top < low - OFF || top > high + OFF;
        let kinetic = ui.spacing().scroll.kinetic;
        if is_held || is_moved || coast.rest.abs() <= kinetic.stop_distance {
            ui.data_mut(|data| data.remove::<Self>(Self::id()));
            return;
        }
        let way = -coast.rest * libm::expm1f(-dt_s / kinetic.decay_time);
        ui.scroll_with_delta_animation(vec2(0.0, way), ScrollAnimation::none());
        Self { rest: coast.rest - way, tops: [before, last, last + way], ..coast }.keep(ui);
    }

    fn keep(self, ui: &Ui) {
        ui.data_mut(|data| data.insert_temp(Self::id(), self));
        ui.ctx().request_repaint();
    }

    fn id() -> Id {
        Id::unique("coast")
    }
}
