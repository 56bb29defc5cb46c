//! The numbers of a trial: how far, how long, how hard.

use egui::{Align2, Color32, FontId, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::state::{Run, Trial};
use crate::app::row::number;
use crate::render::{Colour, viridis};
use crate::trial::STEP;
use crate::trial::frame::{Frame, Progress};
use crate::trial::report::StepKind;

/// Below this many N a force is told in mN.
const SMALL: f64 = 0.01;
/// The room beside a bar for where it ends, in points.
const END: f32 = 40.0;

/// One sentence on how the trial stands.
pub(super) fn sentence(run: &Run, frame: &Frame) -> (String, bool) {
    if let Some(summary) = &run.summary {
        let text = if summary.success {
            format!(
                "Success: the tip arrived after {:.1} s; largest wall force {}.",
                summary.time_s,
                force(summary.max_wall_force_n)
            )
        } else {
            format!("Failed after {:.1} s: {}", summary.time_s, summary.reason)
        };
        return (text, summary.success);
    }
    let text = match frame.progress {
        Progress::Arrived => "Success: the tip is at the target.",
        Progress::TimedOut => "Failed: the time is over.",
        Progress::GaveUp => "Failed: the autopilot gave up.",
        Progress::Over => "The recorded input is over.",
        Progress::Running if run.is_paused => "Paused.",
        Progress::Running if frame.is_looped => "The wire has turned back on itself: withdraw.",
        Progress::Running if frame.is_wrong_branch => "Wrong branch: withdraw and roll.",
        Progress::Running if frame.is_behind => "The machine is behind: the trial runs slower than time.",
        Progress::Running if !frame.doing.is_empty() => return (format!("Autopilot: {}.", lower(&frame.doing)), true),
        Progress::Running if frame.step == 0 => {
            "Feed (W, S) and roll (A, D) the wire to the target, or let the autopilot steer: time runs from then on."
        }
        Progress::Running => "Feed (W, S) and roll (A, D) the wire to the target, or let the autopilot steer.",
    };
    (text.to_owned(), matches!(frame.progress, Progress::Arrived | Progress::Running))
}

fn lower(text: &str) -> String {
    let text = text.trim_end_matches('.');
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_lowercase().collect()).unwrap_or_default();
    format!("{first}{}", letters.as_str())
}

/// Shows the bars and the numbers.
pub(super) fn show(ui: &mut Ui, trial: &Trial, frame: &Frame) {
    let wall = frame.max_wall_force_n as f32;
    let peaks = trial.peaks();
    let end = peaks.wall_scale();
    let Colour([r, g, b]) = viridis(wall / end);
    let help = "The largest normal force at one place of the wall; the bar grows with the largest so far";
    bar(ui, "Wall force", wall, end, Color32::from_rgb(r, g, b), help);
    let accent = ui.visuals().hyperlink_color;
    let help = "What it takes to hold the wire at the guide: negative when it is held back. The bar shows how much";
    bar(ui, "Push force", frame.push_n as f32, peaks.push_scale(), accent, help);
    ui.add_space(2.0);
    number(ui, "Insertion", &format!("{:.1} cm", frame.inserted_mm / 10.0), "Length of wire outside the guide");
    number(
        ui,
        "To target",
        &format!("{:.1} mm", frame.target_mm),
        "Distance of the tip from the target's cross-section",
    );
    number(ui, "Elapsed", &clock(frame.time_s), "Simulated time");
    number(ui, "Fluoroscopy", &clock(trial.carm.seconds), "Time that the beam was on");
    let touches = format!("{}, {} in all", frame.contacts, force(frame.wall_force_n));
    number(ui, "Contacts", &touches, "Places where the wire lies against the wall, and the sum of their forces");
    number(ui, "Force at the tip", &force(frame.tip_force_n), "On the wall within 5 mm of the tip");
    number(
        ui,
        "Torque",
        &format!("{} N mm", thousandths(frame.torque_n_mm)),
        "The moment about the wire's axis at the guide",
    );
    let branch = if frame.is_wrong_branch { "off the route" } else { "on the route" };
    number(
        ui,
        "Branch",
        &format!("{}, {branch}", frame.branch + 1),
        "The branch of the vessel tree that the tip is in",
    );
    let speed = frame.steps_per_second;
    let steps = if speed > 0.0 { format!("{speed:.0} a second") } else { "-".to_owned() };
    number(ui, "Steps", &steps, "What this machine can do; 500 a second keep up with time");
    number(
        ui,
        "Unbalanced steps",
        &unbalanced(frame),
        "Where something snaps, steps are braked or the guide waits, so that their forces are not in balance: forces are \
         those of the last step that was",
    );
    number(ui, "Fed", &fed(frame), "What the guide fed in the last step, of what was asked for");
}

/// The share of the steps that were not balanced, and what the last one was.
fn unbalanced(frame: &Frame) -> String {
    let now = match frame.report.kind {
        StepKind::Balanced => "",
        StepKind::Unsettled => ", now not settled",
        StepKind::Braked => ", now braked",
        StepKind::Waited => ", now waiting",
        StepKind::Held => ", now held",
    };
    format!("{:.1} %{now}", 100.0 * frame.step_kinds.unbalanced_share())
}

/// The speed of the feed in the last step, and what was asked for where that is another.
fn fed(frame: &Frame) -> String {
    let [fed, wanted] = [frame.report.fed_mm, frame.report.wanted_mm].map(|mm| (10.0 * mm / STEP).round() / 10.0 + 0.0);
    if fed == wanted { format!("{fed:.1} mm/s") } else { format!("{fed:.1} of {wanted:.1} mm/s") }
}

/// A bar with its number, and beside it the force at its end.
fn bar(ui: &mut Ui, what: &str, value: f32, scale: f32, colour: Color32, help: &str) {
    let most = if is_small(scale) { format!("{:.0} mN", scale * 1e3) } else { format!("{scale} N") };
    number(ui, what, &force(f64::from(value)), help);
    let (whole, response) = ui.allocate_exact_size(vec2(ui.available_width(), 12.0), Sense::hover());
    let rect = whole.shrink2(vec2(0.0, 2.0)).with_max_x(whole.right() - END);
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Meter, true, format!("{what}, up to {most}"));
        info.value = Some(f64::from(value));
        info
    });
    response.on_hover_text(help);
    let painter = ui.painter();
    let (end, font) = (whole.right_center(), FontId::proportional(12.0));
    painter.text(end, Align2::RIGHT_CENTER, most, font, ui.visuals().weak_text_color());
    painter.rect_filled(rect, 3.0, ui.visuals().widgets.inactive.bg_fill);
    let part = (value.abs() / scale).min(1.0);
    let filled = rect.with_max_x(rect.left() + rect.width() * part);
    painter.rect_filled(filled, 3.0, colour);
    // Colours of low forces are dark: the end of the bar is marked.
    let end = filled.right().max(rect.left() + 1.0);
    painter
        .line_segment([pos2(end, rect.top()), pos2(end, rect.bottom())], Stroke::new(1.0, ui.visuals().text_color()));
}

/// Whether a bar or a legend that ends at this many N is told in mN.
pub(super) fn is_small(end: f32) -> bool {
    end < SMALL as f32
}

/// In N, or in mN where there are few.
fn force(newtons: f64) -> String {
    if newtons.abs() < SMALL {
        format!("{:.2} mN", (newtons * 1e5).round() / 100.0 + 0.0)
    } else {
        format!("{} N", thousandths(newtons))
    }
}

/// With three decimals, and never a negative nought.
fn thousandths(value: f64) -> String {
    format!("{:.3}", (value * 1000.0).round() / 1000.0 + 0.0)
}

/// Minutes and seconds.
fn clock(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round() as u64;
    format!("{}:{:02}.{} min", tenths / 600, tenths / 10 % 60, tenths % 10)
}

#[cfg(test)]
mod tests {
    #[test]
    fn small_forces_are_told_in_thousandths() {
        let forces = [0.0, -0.000_001, 0.000_214, -0.009_9, 0.01, 0.312_4];
        let told = ["0.00 mN", "0.00 mN", "0.21 mN", "-9.90 mN", "0.010 N", "0.312 N"];
        assert_eq!(forces.map(super::force), told);
    }

    #[test]
    fn a_nought_has_no_sign() {
        assert_eq!([-0.0004, 0.0, -0.2, 1.2348].map(super::thousandths), ["0.000", "0.000", "-0.200", "1.235"]);
    }

    #[test]
    fn steps_that_are_not_balanced_and_feed_that_was_not_fed_are_told() {
        use super::{Frame, StepKind, fed, unbalanced};
        use crate::trial::report::{StepCounts, StepReport};

        let step_kinds = StepCounts { balanced: 970, braked: 20, waited: 10, ..StepCounts::default() };
        let told = |kind, fed_mm, wanted_mm| {
            let report = StepReport { kind, fed_mm, wanted_mm, ..StepReport::default() };
            let frame = Frame { report, step_kinds, ..Frame::default() };
            [unbalanced(&frame), fed(&frame)]
        };
        assert_eq!(told(StepKind::Balanced, 0.04, 0.04), ["3.0 %", "20.0 mm/s"]);
        assert_eq!(told(StepKind::Waited, 0.0, -0.04), ["3.0 %, now waiting", "0.0 of -20.0 mm/s"]);
        assert_eq!(told(StepKind::Balanced, -0.0, 0.0), ["3.0 %", "0.0 mm/s"]);
    }

    #[test]
    fn clocks_have_minutes_and_tenths() {
        assert_eq!(
            [0.0, 9.96, 75.04, 600.0].map(super::clock),
            ["0:00.0 min", "0:10.0 min", "1:15.0 min", "10:00.0 min"]
        );
    }
}
