//! What of the method stands in several places at once: a slider, a symbol of a formula, a mark of a plot. Where the pointer
//! is on one of them, all are lit.

use egui::{Context, Id, Rect, Stroke, StrokeKind, Ui, pos2};

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tie {
    /// Where the pass band ends.
    PassBand,
    /// The number of iterations, which is the degree of the filter.
    Iterations,
    /// The window.
    Window,
    /// The rate of reduction.
    Reduction,
    /// The eigenvalue of the wave that is tried.
    Wave,
    /// What is left of a wave.
    Response,
}

impl Tie {
    /// That of a setting, by its key.
    pub(super) fn of(key: &str) -> Option<Self> {
        match key {
            "pass-band" => Some(Self::PassBand),
            "iterations" => Some(Self::Iterations),
            "window" => Some(Self::Window),
            _ => None,
        }
    }

    fn id() -> Id {
        Id::unique("tie that is lit")
    }

    /// Which is lit: what was pointed at in this frame or in the one before.
    pub(super) fn lit(ctx: &Context) -> Option<Self> {
        let (tie, at) = ctx.data(|data| data.get_temp::<(Self, u64)>(Self::id()))?;
        (at + 1 >= ctx.cumulative_frame_nr()).then_some(tie)
    }

    /// Lights it, for as long as this is called in each frame.
    pub(super) fn light(self, ctx: &Context) {
        if Self::lit(ctx) != Some(self) {
            ctx.request_repaint();
        }
        let frame = ctx.cumulative_frame_nr();
        ctx.data_mut(|data| data.insert_temp(Self::id(), (self, frame)));
    }

    /// Shows a control that stands for it.
    pub(super) fn around<R>(self, ui: &mut Ui, control: impl FnOnce(&mut Ui) -> R) -> R {
        let top = ui.cursor().min;
        let shown = control(ui);
        let rect = Rect::from_min_max(top, pos2(ui.max_rect().right(), ui.min_rect().bottom()));
        if ui.rect_contains_pointer(rect) {
            self.light(ui.ctx());
        }
        self.ring(ui, rect);
        shown
    }

    /// Rings what stands for it while it is lit.
    fn ring(self, ui: &Ui, rect: Rect) {
        if Self::lit(ui.ctx()) == Some(self) {
            let stroke = Stroke::new(1.5, ui.visuals().hyperlink_color);
            ui.painter().rect_stroke(rect.expand(2.0), 4.0, stroke, StrokeKind::Inside);
        }
    }
}
