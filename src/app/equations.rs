//! The paper's equations (1) to (7), whose symbols are tied to the sliders and to the marks of the plot.

use egui::{Id, Label, Rect, RichText, Role, Sense, Ui, WidgetInfo, vec2};

use super::formula::Math;
use super::row::remark;
use super::tie::Tie;
use crate::language::Key;
use crate::pipeline::settings::{Settings, Window};
use crate::say;

/// Letters, where a mouse points, and around a line.
const SIZE: f32 = 15.0;
const GAP: f32 = 4.0;

fn upright(text: &'static str) -> Math {
    Math::Upright(text.into())
}

fn variable(name: &'static str) -> Math {
    Math::Variable(name)
}

fn row(parts: impl Into<Vec<Math>>) -> Math {
    Math::Row(parts.into())
}

fn indexed(name: &'static str, index: &'static str) -> Math {
    Math::index(variable(name), variable(index))
}

fn theta() -> Math {
    variable("θ").tied(Tie::PassBand)
}

fn degree() -> Math {
    variable("N").tied(Tie::Iterations)
}

fn wave() -> Math {
    variable("k").tied(Tie::Wave)
}

fn weight(index: &'static str) -> Math {
    indexed("w", index).tied(Tie::Window)
}

/// T_n(1 - k/2).
fn chebyshev(index: Math) -> Math {
    row([upright(" "), Math::index(variable("T"), index), upright("(1 − "), wave(), upright("/2)")])
}

/// (1) to (4): what smoothing is.
fn filtering() -> [(Math, Key); 4] {
    let laplacian = row([
        upright("Δ"),
        indexed("y", "i"),
        upright(" = "),
        Math::Sum(Box::new(row([variable("j"), upright(" at "), variable("i")]))),
        indexed("w", "ij"),
        upright(" ("),
        indexed("y", "j"),
        upright(" − "),
        indexed("y", "i"),
        upright(")"),
    ]);
    let matrix = row([upright("Δ"), variable("y"), upright(" = −"), variable("K"), upright(" "), variable("y")]);
    let filter = row([
        variable("y'"),
        upright(" = "),
        variable("f").tied(Tie::Response),
        upright("("),
        variable("K"),
        upright(") "),
        variable("y"),
    ]);
    let waves = row([
        variable("y'"),
        upright(" = "),
        Math::Sum(Box::new(variable("i"))),
        indexed("ρ", "i"),
        upright(" "),
        variable("f").tied(Tie::Response),
        upright("("),
        indexed("k", "i").tied(Tie::Wave),
        upright(") "),
        indexed("e", "i"),
    ]);
    [
        (laplacian, Key("panel-equation-1")),
        (matrix, Key("panel-equation-2")),
        (filter, Key("panel-equation-3")),
        (waves, Key("panel-equation-4")),
    ]
}

/// (5), in two lines.
fn series() -> [Math; 2] {
    let first = row([
        Math::index(variable("f"), degree()).tied(Tie::Response),
        upright("("),
        wave(),
        upright(") = "),
        Math::index(variable("w"), upright("0")).tied(Tie::Window),
        Math::fraction(theta(), upright("π")),
        chebyshev(upright("0")),
    ]);
    let rest = row([
        upright("+ "),
        Math::Sum(Box::new(row([variable("n"), upright(" = 1 … "), degree()]))),
        weight("n"),
        Math::fraction(
            row([upright("2 sin("), variable("n"), theta(), upright(")")]),
            row([variable("n"), upright("π")]),
        ),
        chebyshev(variable("n")),
    ]);
    [first, rest]
}

/// (6), of the window that is chosen.
fn window(window: Window) -> Math {
    let cosines = ["", " cos ", " cos 2", " cos 3"];
    let mut parts = vec![weight("n"), upright(" = ")];
    for (n, (term, cosine)) in window.terms().iter().zip(cosines).enumerate() {
        // Four digits after a point, in every language: as the paper prints them.
        let term = (term * 1e4).round() / 1e4;
        parts.push(Math::Upright(format!("{}{term}{cosine}", if n > 0 { " + " } else { "" }).into()));
        parts.extend((n > 0).then(|| variable("t")));
    }
    row(parts)
}

/// What t of (6) is.
fn angle() -> Math {
    let fraction = Math::fraction(row([variable("n"), upright("π")]), row([degree(), upright(" + 1")]));
    row([variable("t"), upright(" = "), fraction])
}

/// What ties the angle of (5) to the slider.
fn band() -> Math {
    let pass_band = Math::index(variable("k"), upright("PB")).tied(Tie::PassBand);
    row([pass_band, upright(" = 2 (1 − cos "), theta(), upright(")")])
}

/// (1) to (6).
pub(super) fn smoothing(ui: &mut Ui, settings: &Settings) {
    for (i, (math, words)) in filtering().iter().enumerate() {
        equation(ui, &format!("({})", i + 1), std::slice::from_ref(math), settings);
        remark(ui, &words.say());
        ui.add_space(GAP);
    }
    equation(ui, "(5)", &series(), settings);
    equation(ui, "", &[band()], settings);
    remark(ui, &say!("panel-equation-5"));
    ui.add_space(GAP);
    let chosen = settings.smoothing.window;
    equation(ui, "(6)", &[window(chosen), angle()], settings);
    remark(ui, &say!("panel-equation-6", window = chosen.name()));
}

/// (7).
pub(super) fn reduction(ui: &mut Ui, settings: &Settings) {
    let rate = row([upright("r").tied(Tie::Reduction), upright(" = ")]);
    let fraction = Math::fraction(upright("m − m'"), upright("m"));
    equation(ui, "(7)", &[row([rate, fraction])], settings);
    remark(ui, &say!("panel-equation-7"));
}

/// A line or more of an equation, with its number; each tied symbol can be pointed at.
fn equation(ui: &mut Ui, number: &str, lines: &[Math], settings: &Settings) {
    let lit = Tie::lit(ui.ctx());
    let colour = ui.visuals().text_color();
    for (i, math) in lines.iter().enumerate() {
        let set = math.set(ui, SIZE);
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), set.size().y + GAP), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("{number} {math}")));
        let indent = if i == 0 { 0.0 } else { SIZE };
        let corner = rect.left_top() + vec2(indent, GAP / 2.0);
        let ties = set.paint(ui, corner, colour, lit);
        // Of N within f the inner one is meant.
        let at = ui.ctx().pointer_hover_pos();
        if let Some(&(tie, place)) = ties.iter().find(|(_, place)| at.is_some_and(|at| place.contains(at))) {
            symbol(ui, response.id.with("symbol"), tie, place, settings);
        }
        if i == 0 {
            let text = RichText::new(number).small().weak();
            let place = Rect::from_min_max(rect.right_top() - vec2(28.0, 0.0), rect.right_bottom());
            ui.put(place, Label::new(text));
        }
    }
}

/// A symbol that is tied to something: it lights that, and says what it is.
fn symbol(ui: &Ui, id: Id, tie: Tie, place: Rect, settings: &Settings) {
    let response = ui.interact(place, id, Sense::hover());
    if response.hovered() {
        tie.light(ui.ctx());
    }
    response.on_hover_text(told(tie, settings));
}

/// What a symbol is, and what it is set to.
fn told(tie: Tie, settings: &Settings) -> String {
    let smoothing = &settings.smoothing;
    match tie {
        Tie::PassBand => say!("panel-tied-pass-band", value = smoothing.pass_band.to_string()),
        Tie::Iterations => say!("panel-tied-iterations", count = smoothing.iterations),
        Tie::Window => say!("panel-tied-window", window = smoothing.window.name()),
        Tie::Reduction => say!("panel-tied-reduction"),
        Tie::Wave => say!("panel-tied-wave"),
        Tie::Response => say!("panel-tied-response"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equations_are_those_of_the_paper() {
        let words = filtering().map(|(math, _)| math.to_string());
        assert_eq!(words[0], "Δy_i = Σ_(j at i) w_ij (y_j − y_i)");
        assert_eq!(words[1..], ["Δy = −K y", "y' = f(K) y", "y' = Σ_(i) ρ_i f(k_i) e_i"]);
        let [first, rest] = series().map(|math| math.to_string());
        assert_eq!(first, "f_N(k) = w_0(θ)/(π) T_0(1 − k/2)");
        assert_eq!(rest, "+ Σ_(n = 1 … N) w_n(2 sin(nθ))/(nπ) T_n(1 − k/2)");
        assert_eq!(window(Window::Hamming).to_string(), "w_n = 0.54 + 0.46 cos t");
        assert_eq!(window(Window::Blackman).to_string(), "w_n = 0.42 + 0.5 cos t + 0.08 cos 2t");
        assert_eq!(angle().to_string(), "t = (nπ)/(N + 1)");
        assert_eq!(band().to_string(), "k_PB = 2 (1 − cos θ)");
    }
}
