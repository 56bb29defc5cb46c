//! Formulas as they are printed: indices, fractions and sums, drawn in the window's letters. No crate sets formulas in egui
//! without a browser or a second font.

use std::borrow::Cow;
use std::fmt::{self, Display};
use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Galley, Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};

use super::tie::Tie;

/// How much smaller an index is than what it stands at.
const INDEX: f32 = 0.72;
/// By how much an index is lower, in heights of the letters.
const LOWER: f32 = 0.22;
/// How far the bar of a fraction is above the base line, in heights of the letters.
const BAR: f32 = 0.28;

/// Room between a letter that leans and a bracket behind it, in heights of the letters.
const LEAN: f32 = 0.14;

/// A formula, or a part of one.
#[derive(Clone, Debug)]
pub(super) enum Math {
    /// Upright letters: numbers, operators, names of functions.
    Upright(Cow<'static, str>),
    /// The name of a variable.
    Variable(&'static str),
    /// One after another.
    Row(Vec<Self>),
    /// With an index.
    Index(Box<[Self; 2]>),
    /// One over another.
    Fraction(Box<[Self; 2]>),
    /// The sign of a sum, with what it runs over.
    Sum(Box<Self>),
    /// What stands for something of the window.
    Tied(Tie, Box<Self>),
}

impl Math {
    pub(super) fn index(of: Self, index: Self) -> Self {
        Self::Index(Box::new([of, index]))
    }

    pub(super) fn fraction(over: Self, under: Self) -> Self {
        Self::Fraction(Box::new([over, under]))
    }

    pub(super) fn tied(self, tie: Tie) -> Self {
        Self::Tied(tie, Box::new(self))
    }

    /// Whether it ends with a letter that leans over its width.
    fn leans(&self) -> bool {
        match self {
            Self::Variable(_) => true,
            Self::Row(parts) => parts.last().is_some_and(Self::leans),
            Self::Index(both) => both[1].leans(),
            Self::Tied(_, part) => part.leans(),
            Self::Upright(_) | Self::Fraction(_) | Self::Sum(_) => false,
        }
    }

    /// Whether it begins with a bracket or a stroke, which what leans would touch.
    fn is_upright_stroke(&self) -> bool {
        match self {
            Self::Upright(text) => text.starts_with(['(', ')', '/']),
            Self::Row(parts) => parts.first().is_some_and(Self::is_upright_stroke),
            Self::Tied(_, part) => part.is_upright_stroke(),
            Self::Variable(_) | Self::Index(_) | Self::Fraction(_) | Self::Sum(_) => false,
        }
    }

    /// Draws it from the left end of its base line at `size`, and says what it takes and what of it is tied.
    pub(super) fn set(&self, ui: &Ui, size: f32) -> Set {
        let letters = |text: &str, size: f32, italics: bool| {
            let format = TextFormat {
                font_id: FontId::proportional(size),
                color: Color32::PLACEHOLDER,
                italics,
                ..Default::default()
            };
            Set::of(ui.painter().layout_job(LayoutJob::single_section(text.to_owned(), format)))
        };
        match self {
            Self::Upright(text) => letters(text, size, false),
            Self::Variable(text) => letters(text, size, true),
            Self::Row(parts) => {
                let each = parts.iter().enumerate();
                each.fold(Set::default(), |mut row, (i, part)| {
                    if i > 0 && parts[i - 1].leans() && part.is_upright_stroke() {
                        row.width += LEAN * size;
                    }
                    row.beside(part.set(ui, size), 0.0)
                })
            }
            Self::Index(both) => both[0].set(ui, size).beside(both[1].set(ui, INDEX * size), LOWER * size),
            Self::Fraction(both) => Set::fraction(both[0].set(ui, 0.9 * size), both[1].set(ui, 0.9 * size), size),
            Self::Sum(below) => Set::sum(letters("Σ", 1.5 * size, false), below.set(ui, 0.9 * INDEX * size), size),
            Self::Tied(tie, part) => {
                let mut set = part.set(ui, size);
                set.ties.push((*tie, set.rect()));
                set
            }
        }
    }
}

/// As it is read out and written on a line.
impl Display for Math {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Upright(text) => f.write_str(text),
            Self::Variable(name) => f.write_str(name),
            Self::Row(parts) => parts.iter().try_for_each(|part| part.fmt(f)),
            Self::Index(both) => write!(f, "{}_{}", both[0], both[1]),
            Self::Fraction(both) => write!(f, "({})/({})", both[0], both[1]),
            Self::Sum(below) => write!(f, "Σ_({below}) "),
            Self::Tied(_, part) => part.fmt(f),
        }
    }
}

/// A formula that is set: from the left end of its base line, x to the right and y down.
#[derive(Clone, Debug, Default)]
pub(super) struct Set {
    width: f32,
    ascent: f32,
    descent: f32,
    letters: Vec<(Vec2, Arc<Galley>)>,
    /// Left end and length of each bar.
    bars: Vec<(Vec2, f32)>,
    ties: Vec<(Tie, Rect)>,
}

impl Set {
    fn of(galley: Arc<Galley>) -> Self {
        let ascent = galley.rows.first().and_then(|row| row.glyphs.first()).map_or(0.0, |glyph| glyph.pos.y);
        let (width, height) = (galley.size().x, galley.size().y);
        Self { width, ascent, descent: height - ascent, letters: vec![(vec2(0.0, -ascent), galley)], ..Self::default() }
    }

    /// What it takes.
    fn rect(&self) -> Rect {
        Rect::from_min_max(pos2(0.0, -self.ascent), pos2(self.width, self.descent))
    }

    pub(super) fn size(&self) -> Vec2 {
        self.rect().size()
    }

    fn moved(mut self, by: Vec2) -> Self {
        self.letters.iter_mut().for_each(|(at, _)| *at += by);
        self.bars.iter_mut().for_each(|(at, _)| *at += by);
        self.ties.iter_mut().for_each(|(_, rect)| *rect = rect.translate(by));
        self
    }

    /// Both, each where it is.
    fn with(mut self, other: Self) -> Self {
        self.letters.extend(other.letters);
        self.bars.extend(other.bars);
        self.ties.extend(other.ties);
        self
    }

    /// With another behind it, lower by `down`.
    fn beside(self, next: Self, down: f32) -> Self {
        let at = vec2(self.width, down);
        let (width, ascent) = (self.width + next.width, self.ascent.max(next.ascent - down));
        let descent = self.descent.max(next.descent + down);
        Self { width, ascent, descent, ..self.with(next.moved(at)) }
    }

    fn fraction(over: Self, under: Self, size: f32) -> Self {
        let gap = 0.06 * size;
        let width = over.width.max(under.width) + 0.3 * size;
        let (up, down) = (-BAR * size - over.descent - gap, -BAR * size + under.ascent - 0.1 * size + gap);
        let (ascent, descent) = (over.ascent - up, under.descent + down);
        let middle = |part: &Self| (width - part.width) / 2.0;
        let (left_over, left_under) = (middle(&over), middle(&under));
        let both = over.moved(vec2(left_over, up)).with(under.moved(vec2(left_under, down)));
        let mut bars = both.bars.clone();
        bars.push((vec2(0.1 * size, -BAR * size), width - 0.2 * size));
        Self { width, ascent, descent, bars, ..both }
    }

    fn sum(sign: Self, below: Self, size: f32) -> Self {
        let width = sign.width.max(below.width) + 0.25 * size;
        // The sign stands about the bars of fractions.
        let (drop, down) = (0.22 * size, 0.22 * size + 0.3 * sign.descent + below.ascent);
        let (ascent, descent) = (sign.ascent - drop, below.descent + down);
        let middle = |part: &Self| (width - part.width) / 2.0;
        let (left_sign, left_below) = (middle(&sign), middle(&below));
        let both = sign.moved(vec2(left_sign, drop)).with(below.moved(vec2(left_below, down)));
        Self { width, ascent, descent, ..both }
    }

    /// Draws it with its upper left corner there, a tied part in its own colour where it is lit. Where each tied part is, what is within another first.
    pub(super) fn paint(self, ui: &Ui, corner: Pos2, colour: Color32, lit: Option<Tie>) -> Vec<(Tie, Rect)> {
        let from = corner + vec2(0.0, self.ascent);
        let ties: Vec<(Tie, Rect)> =
            self.ties.iter().map(|&(tie, rect)| (tie, rect.translate(from.to_vec2()))).collect();
        let (accent, fill) = (ui.visuals().hyperlink_color, ui.visuals().selection.bg_fill);
        for (_, rect) in ties.iter().filter(|(tie, _)| lit == Some(*tie)) {
            ui.painter().rect_filled(rect.expand(1.0), 3.0, fill);
        }
        for (at, galley) in self.letters {
            let middle = from + at + galley.size() / 2.0;
            let of = ties.iter().find(|(_, rect)| rect.contains(middle)).map(|(tie, _)| *tie);
            let colour = match of {
                Some(tie) if lit == Some(tie) => ui.visuals().selection.stroke.color,
                Some(_) => accent,
                None => colour,
            };
            ui.painter().galley(from + at, galley, colour);
        }
        for (at, length) in self.bars {
            ui.painter().hline((from + at).x..=(from + at).x + length, (from + at).y, Stroke::new(1.0, colour));
        }
        ties
    }
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput};

    use super::*;

    #[test]
    fn a_letter_that_leans_touches_no_bracket() {
        let bracket = || Math::Upright(")".into());
        let index = || Math::index(Math::Variable("k"), Math::Variable("i"));
        let mut more = Vec::new();
        let _ = Context::default().run_ui(RawInput::default(), |ui| {
            let width = |math: &Math| math.set(ui, 20.0).size().x;
            let ends = [Math::Variable("K"), index(), index().tied(Tie::Wave), Math::Upright("2".into())];
            more = ends
                .into_iter()
                .map(|end| {
                    let apart = width(&end) + width(&bracket());
                    width(&Math::Row(vec![end, bracket()])) - apart
                })
                .collect();
        });
        assert!(more[..3].iter().all(|more| *more > 2.0) && more[3].abs() < 0.01, "{more:?}");
    }
}
