//! The numbers of a trial: how far, how long, how hard.

use egui::{Align2, CollapsingHeader, Color32, FontId, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::setup::words;
use super::state::{Run, Trial};
use crate::app::row::number;
use crate::language::{decimal, grouped, inner, tell};
use crate::render::{Colour, viridis};
use crate::say;
use crate::trial::STEP;
use crate::trial::autopilot::AutopilotTask;
use crate::trial::frame::{Frame, Progress};
use crate::trial::report::StepKind;

/// Below this many N a force is told in mN.
const SMALL: f64 = 0.01;
/// The room beside a bar for where it ends, in points.
const END: f32 = 40.0;

/// One sentence on how the trial stands.
pub(super) fn sentence(run: &Run, frame: &Frame, has_finger: bool) -> (String, bool) {
    if let Some(summary) = &run.summary {
        let (time, force) = (decimal(summary.time_s, 1), force(summary.max_wall_force_n));
        let why = run.end.as_ref().map_or_else(String::new, |end| tell(end));
        let wire = words(&summary.wire);
        let failed = summary.failed_wires.iter().map(|wire| words(wire)).collect::<Vec<_>>().join(", ");
        let text = match (summary.success, summary.failed_wires.is_empty()) {
            (true, true) => say!("trial-success", time = time, force = force),
            (true, false) => {
                say!("trial-success-exchanged", time = time, wire = wire, failed = failed, force = force)
            }
            (false, true) => say!("trial-failed", time = time, why = why),
            (false, false) => say!("trial-failed-exchanged", time = time, wire = wire, failed = failed, why = why),
        };
        return (text, summary.success);
    }
    let text = match frame.progress {
        Progress::Arrived => say!("trial-arrived"),
        Progress::TimedOut => say!("trial-timed-out"),
        Progress::GaveUp => say!("trial-gave-up"),
        Progress::Over => say!("trial-input-over"),
        Progress::Running if run.is_paused => say!("trial-paused"),
        Progress::Running if let Some(doing @ AutopilotTask::LookingAhead { .. }) = frame.doing => steers(doing),
        Progress::Running if frame.is_looped => say!("trial-looped"),
        Progress::Running if frame.is_wrong_branch => say!("trial-wrong-branch"),
        Progress::Running if frame.is_behind => say!("trial-behind"),
        Progress::Running => match frame.doing {
            Some(doing) => steers(doing),
            None => feed(frame.step == 0, has_finger),
        },
    };
    (text, matches!(frame.progress, Progress::Arrived | Progress::Running))
}

/// What the autopilot is doing.
fn steers(doing: AutopilotTask) -> String {
    say!("trial-steers", doing = inner(&tell(&doing)))
}

/// What to do, at first or later, by keys or by pads.
fn feed(is_first: bool, has_finger: bool) -> String {
    match (is_first, has_finger) {
        (true, false) => say!("trial-feed-first"),
        (false, false) => say!("trial-feed"),
        (true, true) => say!("trial-feed-first-touch"),
        (false, true) => say!("trial-feed-touch"),
    }
}

/// Shows the three gauges and, folded up, the other numbers.
pub(super) fn show(ui: &mut Ui, trial: &Trial, frame: &Frame) {
    // Rows of numbers are lower than those of controls.
    ui.scope(|ui| gauges(ui, trial, frame));
    let fold = CollapsingHeader::new(say!("trial-more-numbers")).id_salt("more numbers");
    fold.show(ui, |ui| numbers(ui, trial, frame));
}

fn gauges(ui: &mut Ui, trial: &Trial, frame: &Frame) {
    let peaks = trial.peaks();
    let accent = ui.visuals().hyperlink_color;
    let is_small = in_small(trial);
    let (wall, end) = (frame.max_wall_force_n as f32, peaks.wall_scale());
    let Colour([r, g, b]) = viridis(wall / end);
    let words = [say!("trial-wall-force"), say!("trial-wall-force-help")];
    let told = [force_in(is_small, frame.max_wall_force_n), force_end(is_small, end)];
    bar(ui, &words, &told, [wall, end], Color32::from_rgb(r, g, b));
    let words = [say!("trial-push-force"), say!("trial-push-force-help")];
    let end = peaks.push_scale();
    let told = [force_in(is_small, frame.push_n), force_end(is_small, end)];
    bar(ui, &words, &told, [frame.push_n as f32, end], accent);
    let length = trial.session().map_or(0.0, |session| session.ready.route.length_mm);
    let told = [format!("{} cm", decimal(frame.inserted_mm / 10.0, 1)), format!("{:.0} cm", length / 10.0)];
    let words = [say!("trial-insertion"), say!("trial-insertion-help")];
    bar(ui, &words, &told, [frame.inserted_mm as f32, (length as f32).max(1.0)], accent);
}

fn numbers(ui: &mut Ui, trial: &Trial, frame: &Frame) {
    let distance = format!("{} mm", decimal(frame.target_mm, 1));
    number(ui, &say!("trial-to-target"), &distance, &say!("trial-to-target-help"));
    number(ui, &say!("trial-elapsed"), &clock(frame.time_s), &say!("trial-elapsed-help"));
    number(
        ui,
        &say!("trial-fluoroscopy"),
        &clock(trial.open().map_or(0.0, |open| open.carm.seconds)),
        &say!("trial-beam-time-help"),
    );
    let force = |newtons: f64| force_in(in_small(trial), newtons);
    let touches = say!("trial-contacts-sum", count = frame.contacts, force = force(frame.wall_force_n));
    number(ui, &say!("trial-contacts"), &touches, &say!("trial-contacts-help"));
    number(ui, &say!("trial-tip-force"), &force(frame.tip_force_n), &say!("trial-tip-force-help"));
    let torque = format!("{} N mm", thousandths(frame.torque_n_mm));
    number(ui, &say!("trial-torque"), &torque, &say!("trial-torque-help"));
    let branch = (frame.branch + 1).to_string();
    let branch = if frame.is_wrong_branch {
        say!("trial-branch-off", branch = branch)
    } else {
        say!("trial-branch-on", branch = branch)
    };
    number(ui, &say!("trial-branch"), &branch, &say!("trial-branch-help"));
    let speed = frame.steps_per_second;
    let steps = if speed > 0.0 { say!("trial-steps-rate", rate = decimal(speed, 0)) } else { "-".to_owned() };
    number(ui, &say!("trial-steps"), &steps, &say!("trial-steps-help"));
    number(ui, &say!("trial-unbalanced"), &unbalanced(frame), &say!("trial-unbalanced-help"));
    number(ui, &say!("trial-fed"), &fed(frame), &say!("trial-fed-help"));
}

/// The share of the steps that were not balanced, and what the last one was.
fn unbalanced(frame: &Frame) -> String {
    let share = decimal(100.0 * frame.step_kinds.unbalanced_share(), 1);
    match frame.report.kind {
        StepKind::Balanced => format!("{share} %"),
        StepKind::Unsettled => say!("trial-unbalanced-unsettled", share = share),
        StepKind::Braked => say!("trial-unbalanced-braked", share = share),
        StepKind::Waited => say!("trial-unbalanced-waiting", share = share),
        StepKind::Held => say!("trial-unbalanced-held", share = share),
    }
}

/// The speed of the feed in the last step, and what was asked for where that is another.
fn fed(frame: &Frame) -> String {
    let [fed, wanted] = [frame.report.fed_mm, frame.report.wanted_mm].map(|mm| (10.0 * mm / STEP).round() / 10.0 + 0.0);
    let is_all = fed == wanted;
    let [fed, wanted] = [fed, wanted].map(|speed| decimal(speed, 1));
    if is_all { format!("{fed} mm/s") } else { say!("trial-fed-of", fed = fed, wanted = wanted) }
}

/// A bar from 0 to `end` with its number, and beside it what stands at its end: `told` has both in words. What it is, and
/// what that means, come before.
fn bar(ui: &mut Ui, words: &[String; 2], told: &[String; 2], [value, end]: [f32; 2], colour: Color32) {
    let ([what, help], [number_told, most]) = (words, told);
    number(ui, what, number_told, help);
    let (whole, response) = ui.allocate_exact_size(vec2(ui.available_width(), 12.0), Sense::hover());
    let rect = whole.shrink2(vec2(0.0, 2.0)).with_max_x(whole.right() - END);
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Meter, true, say!("trial-bar-up-to", what = what, most = most));
        info.value = Some(f64::from(value));
        info
    });
    response.on_hover_text(help.to_owned());
    let painter = ui.painter();
    let (beside, font) = (whole.right_center(), FontId::proportional(12.0));
    painter.text(beside, Align2::RIGHT_CENTER, most, font, ui.visuals().weak_text_color());
    painter.rect_filled(rect, 3.0, ui.visuals().widgets.inactive.bg_fill);
    let part = (value.abs() / end).min(1.0);
    let filled = rect.with_max_x(rect.left() + rect.width() * part);
    painter.rect_filled(filled, 3.0, colour);
    // Colours of low forces are dark: the end of the bar is marked.
    let mark = filled.right().max(rect.left() + 1.0);
    painter
        .line_segment([pos2(mark, rect.top()), pos2(mark, rect.bottom())], Stroke::new(1.0, ui.visuals().text_color()));
}

/// Whether the forces of the panel are told in mN, all of them in one unit: by the bar that goes farther.
fn in_small(trial: &Trial) -> bool {
    let peaks = trial.peaks();
    is_small(peaks.wall_scale().max(peaks.push_scale()))
}

/// The end of a bar of forces.
fn force_end(is_small: bool, end: f32) -> String {
    if is_small { format!("{:.0} mN", end * 1e3) } else { format!("{} N", grouped(end)) }
}

/// Whether a bar or a legend that ends at this many N is told in mN.
pub(super) fn is_small(end: f32) -> bool {
    end < SMALL as f32
}

/// In N, or in mN where there are few.
fn force(newtons: f64) -> String {
    force_in(newtons.abs() < SMALL, newtons)
}

/// In mN or in N.
fn force_in(is_small: bool, newtons: f64) -> String {
    if is_small {
        format!("{} mN", decimal((newtons * 1e5).round() / 100.0 + 0.0, 2))
    } else {
        format!("{} N", thousandths(newtons))
    }
}

/// With three decimals, and never a negative nought.
fn thousandths(value: f64) -> String {
    decimal((value * 1000.0).round() / 1000.0 + 0.0, 3)
}

/// Minutes and seconds.
fn clock(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round() as u64;
    let second = decimal((tenths % 600) as f64 / 10.0, 1);
    format!("{}:{second:0>4} min", tenths / 600)
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
    fn where_one_bar_is_in_newtons_so_is_the_end_of_the_other() {
        assert_eq!([0.005, 0.5].map(|end| super::force_end(false, end)), ["0.005 N", "0.5 N"]);
        assert_eq!([0.002, 0.005].map(|end| super::force_end(true, end)), ["2 mN", "5 mN"]);
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
