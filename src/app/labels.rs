//! Who gives way where words over a view would collide. In one pass over a frame, in this order: what always stands there
//! (title, name, scale, axes, legends), the place that was gone to, what is wrong, measures. Each takes the first of its
//! places that is free. Where none is left, the words of a ring are written all the same, those of a measure are not.

use egui::{Align2, Context, Id, Pos2, Rect, Ui, Vec2, vec2};

/// Room around words, in points.
const ROOM: Vec2 = vec2(6.0, 3.0);

/// Where words stand in this pass: a frame that is laid out twice has two.
#[derive(Clone, Default)]
struct Taken {
    pass: u64,
    places: Vec<Rect>,
}

impl Taken {
    fn of(ctx: &Context) -> Self {
        let pass = ctx.cumulative_pass_nr();
        let taken = ctx.data(|data| data.get_temp::<Self>(Self::id())).unwrap_or_default();
        if taken.pass == pass { taken } else { Self { pass, places: Vec::new() } }
    }

    fn id() -> Id {
        Id::unique("words over views")
    }

    fn take(mut self, place: Rect, ctx: &Context) {
        self.places.push(place);
        ctx.data_mut(|data| data.insert_temp(Self::id(), self));
    }
}

/// Takes a place that gives way to nothing.
pub(super) fn stands(ctx: &Context, place: Rect) {
    Taken::of(ctx).take(place, ctx);
}

/// Takes the first of these places that lies in `view` and on nothing that was written before; `None` where there is none.
pub(super) fn free(ui: &Ui, view: Rect, places: impl IntoIterator<Item = Rect>) -> Option<Rect> {
    let taken = Taken::of(ui.ctx());
    let inside = view.shrink2(ROOM);
    let is_free = |place: &Rect| {
        let around = place.expand2(ROOM);
        inside.contains_rect(*place) && !taken.places.iter().any(|other| other.intersects(around))
    };
    let place = places.into_iter().find(is_free)?;
    taken.take(place, ui.ctx());
    Some(place)
}

/// The places around a point for words of this size, `away` from it: beside it, towards the middle of the view first, then
/// above and below, then askew.
pub(super) fn around(at: Pos2, size: Vec2, away: f32, view: Rect) -> [Rect; 8] {
    let to_right = if at.x < view.center().x { 1.0 } else { -1.0 };
    let down = if at.y < view.center().y { 1.0 } else { -1.0 };
    let beside = |x: f32, y: f32| {
        let middle = at + vec2(x * (away + size.x / 2.0), y * (away + size.y / 2.0));
        Align2::CENTER_CENTER.anchor_size(middle, size)
    };
    [
        beside(to_right, 0.0),
        beside(-to_right, 0.0),
        beside(0.0, down),
        beside(0.0, -down),
        beside(to_right, down),
        beside(to_right, -down),
        beside(-to_right, down),
        beside(-to_right, -down),
    ]
}

#[cfg(test)]
mod tests {
    use egui::{RawInput, pos2};

    use super::*;

    #[test]
    fn words_go_around_what_stands_and_give_way_where_nothing_is_free() {
        let ctx = Context::default();
        let view = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0));
        let size = vec2(60.0, 12.0);
        let mut found = Vec::new();
        // In the second pass nothing of the first is left.
        for _frame in 0..2 {
            let mut passes = 0;
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                found.clear();
                passes += 1;
                if passes == 1 {
                    ui.ctx().request_discard("to lay out again");
                }
                stands(ui.ctx(), Rect::from_min_size(pos2(110.0, 40.0), vec2(80.0, 20.0)));
                let at = pos2(99.0, 50.0);
                found.extend((0..9).map(|_| free(ui, view, around(at, size, 10.0, view))));
            });
            output.textures_delta.clear();
            assert_eq!(passes, 2);
        }
        let places: Vec<Rect> = found.iter().flatten().copied().collect();
        // To the right something stands, near those above and below, too: left, then left above and left below.
        assert_eq!(
            places.iter().map(|place| place.center().to_vec2()).collect::<Vec<_>>(),
            [50.0, 34.0, 66.0].map(|y| vec2(59.0, y))
        );
        assert!(found.last().unwrap().is_none(), "{places:?}");
        for (i, one) in places.iter().enumerate() {
            assert!(view.contains_rect(*one) && !places[..i].iter().any(|other| other.intersects(*one)), "{places:?}");
        }
    }
}
