//! Where single ends are cut: a row for each below the step, and in the view a ring that is dragged along its vessel.

use egui::{Checkbox, Color32, CursorIcon, DragValue, Grid, Rect, Role, Sense, Ui, Vec2, vec2};

use super::action::Action;
use super::preparation::{Planned, Preparation};
use super::view::end_colour;
use crate::app::action::Action as Ask;
use crate::app::assist::{describe, name};
use crate::app::control::reads_comma;
use crate::app::measure::canvas::Canvas;
use crate::app::row::{remark, warning};
use crate::app::theme;
use crate::engine::CutEnd;
use crate::language::tell;
use crate::mesh::Vec3;
use crate::prepare::cuts::{ClipAt, Cut, NEAR};
use crate::prepare::ends::Length;
use crate::prepare::prepare::Plan;
use crate::render::Camera;
use crate::say;

/// Side of the square in which a ring is held, in points.
const HANDLE: f32 = 30.0;
/// Radii of the vessel that a ring has, so that it stands out of the wall.
const RING: f32 = 1.3;
/// Sides of a ring.
const SIDES: usize = 48;
/// Radii of the vessel that are shown around an end.
const AROUND: f32 = 10.0;

impl CutEnd {
    /// The end of its centreline, in mm.
    fn tip(&self) -> Vec3 {
        self.at(0.0).0
    }

    /// The radius of the vessel there, in mm.
    fn radius_mm(&self) -> f32 {
        self.at(0.0).1
    }

    /// How far from the end a plane may stand, in mm.
    fn room_mm(&self) -> f32 {
        // A sum of nothing is -0, which would be shown so.
        self.way.windows(2).map(|pair| place(pair[0]).distance(place(pair[1]))).fold(0.0, std::ops::Add::add)
    }

    /// The centreline so far from the end, and its radius there, in mm.
    fn at(&self, mm: f32) -> (Vec3, f32) {
        let mut left = mm.max(0.0);
        for pair in self.way.windows(2) {
            let [from, to] = [place(pair[0]), place(pair[1])];
            let length = from.distance(to);
            if left <= length {
                let part = if length > 0.0 { left / length } else { 0.0 };
                return (from.lerp(to, part), pair[0][3] + (pair[1][3] - pair[0][3]) * part);
            }
            left -= length;
        }
        self.way.last().map_or((Vec3::ZERO, 0.0), |&last| (place(last), last[3]))
    }

    /// The middle, the direction out of the vessel, and the radius of a plane so far from the end, in mm.
    fn plane_at(&self, mm: f32) -> (Vec3, Vec3, f32) {
        if let Some(plane) = self.plane.filter(|plane| (plane.arc_mm as f32 - mm).abs() < 1e-3) {
            return (Vec3::from(plane.centre), Vec3::from(plane.normal), plane.radius_mm);
        }
        let (middle, radius) = self.at(mm);
        let out = self.at(mm - radius).0 - self.at(mm + radius).0;
        (middle, out.normalize_or(Vec3::Z), radius)
    }
}

fn place([x, y, z, _]: [f32; 4]) -> Vec3 {
    Vec3::new(x, y, z)
}

/// For each end the place in the plan's cuts of what is asked of it by itself, as the engine finds it.
fn own(plan: &Plan, ends: &[CutEnd]) -> Vec<Option<usize>> {
    let mut own = vec![None; ends.len()];
    for (number, cut) in plan.cuts.iter().enumerate() {
        let to = Vec3::from_array(cut.end_mm.map(|x| x as f32));
        let far = |end: &CutEnd| end.tip().distance(to);
        let nearest = (0..ends.len()).min_by(|&a, &b| far(&ends[a]).total_cmp(&far(&ends[b])));
        if let Some(end) = nearest.filter(|&end| f64::from(far(&ends[end])) <= NEAR * f64::from(ends[end].radius_mm()))
        {
            own[end] = Some(number);
        }
    }
    own
}

/// Where an end is asked to be cut.
fn asked_of(plan: &Plan, own: Option<usize>) -> Option<ClipAt> {
    own.map_or(plan.clip, |cut| plan.cuts[cut].at)
}

/// How far from an end that is, in mm. Where no place is round, or none is found yet, it is a radius.
fn distance(end: &CutEnd, at: ClipAt) -> f32 {
    match (at, end.plane) {
        (ClipAt::Distance(Length::Mm(mm)), _) => mm as f32,
        (ClipAt::Distance(Length::Radii(radii)), _) => radii as f32 * end.radius_mm(),
        (ClipAt::Round, Some(plane)) => plane.arc_mm as f32,
        (ClipAt::Round, None) => end.radius_mm().min(end.room_mm()),
    }
}

/// The plan with another place for one end, whose cut in it is `own`.
fn with(plan: &Plan, end: &CutEnd, own: Option<usize>, at: Option<ClipAt>) -> Plan {
    let mut plan = plan.clone();
    let cut = Cut { end_mm: end.tip().to_array().map(f64::from), at };
    match own {
        Some(number) => plan.cuts[number] = cut,
        None => plan.cuts.push(cut),
    }
    plan
}

/// So far from an end, to a hundredth of a mm, as it stands in the field; no farther than there is room.
fn in_mm(end: &CutEnd, mm: f32) -> Option<ClipAt> {
    let room = ((f64::from(end.room_mm()) - 1e-3) * 100.0).floor().max(0.0) / 100.0;
    Some(ClipAt::Distance(Length::Mm(((f64::from(mm) * 100.0).round() / 100.0).min(room))))
}

/// A row for each end.
pub(super) fn list(ui: &mut Ui, preparation: &Preparation, planned: &Planned, asked: &mut Vec<Ask>) {
    let (plan, ends) = (&preparation.plan, planned.found.ends.as_slice());
    let own = own(plan, ends);
    ui.separator();
    remark(ui, &say!("solver-cuts-help"));
    let mut changed = None;
    let grid = Grid::new("cuts").num_columns(4).striped(true).spacing(vec2(8.0, 4.0)).min_col_width(8.0);
    grid.show(ui, |ui| {
        for (i, end) in ends.iter().enumerate() {
            let (swatch, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
            ui.painter().rect_filled(swatch, 2.0, end_colour(i));
            let at = asked_of(plan, own[i]);
            let mut is_cut = at.is_some();
            if ui.add(Checkbox::new(&mut is_cut, say!("solver-cut-end", number = i + 1))).changed() {
                let at = is_cut.then_some(plan.clip.unwrap_or(ClipAt::Round));
                changed = Some(with(plan, end, own[i], at));
            }
            let mut mm = at.map_or(0.0, |at| distance(end, at));
            let field = DragValue::new(&mut mm).range(0.0..=end.room_mm()).speed(0.05).max_decimals(2).suffix(" mm");
            let field = ui.add_enabled(is_cut, reads_comma(field, false));
            name(&field, Role::SpinButton, &say!("solver-cut-distance", number = i + 1));
            if field.changed() {
                changed = Some(with(plan, end, own[i], in_mm(end, mm)));
            }
            let go = ui.small_button(say!("solver-go"));
            let label = say!("solver-cut-end", number = i + 1);
            name(&go, Role::Button, &say!("solver-go-to", what = label.clone()));
            if go.clicked() {
                let (at, radius) = end.at(mm);
                asked.push(Ask::GoTo { at_mm: at.to_array(), height_mm: AROUND * radius, label });
            }
            ui.end_row();
        }
    });
    for (i, why) in ends.iter().enumerate().filter_map(|(i, end)| Some((i, end.why.as_ref()?))) {
        warning(ui, &say!("solver-cut-not", number = i + 1, why = tell(why)));
    }
    planned.found.notes.iter().for_each(|note| warning(ui, &tell(note)));
    if !plan.cuts.is_empty() && ui.button(say!("solver-cuts-reset")).clicked() {
        changed = Some(Plan { cuts: Vec::new(), ..plan.clone() });
    }
    asked.extend(changed.map(|plan| Ask::Solver(Action::Set(plan))));
}

/// The rings, and what the hand that drags one asks for; `index` is the number of the view in `rect`.
pub(super) fn rings(
    ui: &Ui,
    index: usize,
    rect: Rect,
    camera: &Camera,
    preparation: &Preparation,
    planned: &Planned,
) -> Option<Action> {
    let (plan, ends) = (&preparation.plan, planned.found.ends.as_slice());
    let (canvas, own) = (Canvas::new(ui, rect, rect, camera), own(plan, ends));
    let mut asked = None;
    for (i, end) in ends.iter().enumerate() {
        let Some(mm) = asked_of(plan, own[i]).map(|at| distance(end, at)) else {
            // Which it is, is seen all the same.
            canvas.dot(end.tip(), end_colour(i));
            canvas.label(end.tip(), &(i + 1).to_string(), ui.visuals().text_color());
            continue;
        };
        let (middle, out, radius) = end.plane_at(mm);
        let (right, up) = out.any_orthonormal_pair();
        let round = |side: usize| {
            let (sin, cos) = (std::f32::consts::TAU * side as f32 / SIDES as f32).sin_cos();
            middle + (right * cos + up * sin) * (RING * radius)
        };
        let ring: Vec<Vec3> = (0..SIDES).map(round).collect();
        let colour = end_colour(i);
        canvas.line(&ring, true, 2.5, colour);
        let Some(at) = canvas.at(middle).filter(|at| rect.shrink(4.0).contains(*at)) else { continue };
        let square = Rect::from_center_size(at, Vec2::splat(theme::row(ui.ctx(), HANDLE)));
        let handle = ui.interact(square, ui.scope_id().with(("cut", index, i)), Sense::drag());
        let handle = handle.on_hover_and_drag_cursor(CursorIcon::Move);
        describe(&handle, Role::Slider, &say!("solver-cut-distance", number = i + 1), f64::from(mm));
        let size = if handle.hovered() || handle.dragged() { 8.0 } else { 6.0 };
        canvas.painter.circle(at, size, colour, egui::Stroke::new(1.5, Color32::WHITE));
        canvas.label(middle, &(i + 1).to_string(), ui.visuals().text_color());
        if let Some(hand) = handle.interact_pointer_pos().filter(|_| handle.dragged()) {
            asked = nearest_mm(&canvas, end, hand).map(|mm| Action::Set(with(plan, end, own[i], in_mm(end, mm))));
        }
    }
    asked
}

/// How far from its end the place of a vessel's centreline is that is seen nearest to the hand, in mm.
fn nearest_mm(canvas: &Canvas<'_>, end: &CutEnd, hand: egui::Pos2) -> Option<f32> {
    let mut best: Option<(f32, f32)> = None;
    let mut before = 0.0;
    for pair in end.way.windows(2) {
        let [from, to] = [place(pair[0]), place(pair[1])];
        let length = from.distance(to);
        if let (Some(a), Some(b)) = (canvas.at(from), canvas.at(to)) {
            let way = b - a;
            let part =
                if way.length_sq() > 0.0 { ((hand - a).dot(way) / way.length_sq()).clamp(0.0, 1.0) } else { 0.0 };
            let far = (a + way * part).distance(hand);
            if best.is_none_or(|(least, _)| far < least) {
                best = Some((far, before + length * part));
            }
        }
        before += length;
    }
    best.map(|(_, mm)| mm)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two ends of a straight vessel of 2 mm along z, of which the lower is cut at 3 mm.
    fn ends() -> Vec<CutEnd> {
        let way = |from: f32, step: f32| (0..20).map(|i| [0.0, 0.0, from + step * i as f32, 2.0]).collect();
        let plane =
            crate::engine::CutPlane { arc_mm: 3.0, centre: [0.1, 0.0, 3.0], normal: [0.0, 0.0, -1.0], radius_mm: 2.1 };
        let (low, high) = (way(0.0, 1.0), way(40.0, -1.0));
        vec![CutEnd { way: low, plane: Some(plane), why: None }, CutEnd { way: high, plane: None, why: None }]
    }

    #[test]
    fn a_plane_stands_square_to_its_way_and_looks_out() {
        let ends = ends();
        assert_eq!(ends[0].room_mm(), 19.0);
        let fork = CutEnd { way: vec![[0.0, 0.0, 0.0, 2.0]], plane: None, why: None };
        assert!(fork.room_mm() == 0.0 && fork.room_mm().is_sign_positive());
        // As the engine found it; elsewhere by the centreline.
        assert_eq!(ends[0].plane_at(3.0), (Vec3::new(0.1, 0.0, 3.0), Vec3::NEG_Z, 2.1));
        assert_eq!(ends[0].plane_at(5.5), (Vec3::Z * 5.5, Vec3::NEG_Z, 2.0));
        assert_eq!(ends[1].plane_at(5.5), (Vec3::Z * 34.5, Vec3::Z, 2.0));
    }

    fn distances(plan: &Plan, ends: &[CutEnd]) -> Vec<Option<f32>> {
        let own = own(plan, ends);
        ends.iter().zip(own).map(|(end, own)| asked_of(plan, own).map(|at| distance(end, at))).collect()
    }

    #[test]
    fn what_is_asked_of_an_end_takes_the_place_of_what_was_and_leaves_the_others() {
        let ends = ends();
        let set = |plan: &Plan, end: usize, at| with(plan, &ends[end], own(plan, &ends)[end], at);
        let plan = Plan::flow();
        // The other is round nowhere: it can be cut by hand, from a radius on.
        assert_eq!(distances(&plan, &ends), [Some(3.0), Some(2.0)]);
        let plan = set(&plan, 1, in_mm(&ends[1], 4.567));
        assert_eq!(distances(&plan, &ends), [Some(3.0), Some(4.57)]);
        let plan = set(&plan, 1, in_mm(&ends[1], 5.0));
        assert_eq!(plan.cuts.len(), 1);
        let plan = set(&plan, 0, None);
        assert_eq!(distances(&plan, &ends), [None, Some(5.0)]);
        // A place that is far from every end is that of none.
        let stray = Cut { end_mm: [30.0, 0.0, 0.0], at: None };
        assert_eq!(distances(&Plan { cuts: vec![stray], ..Plan::flow() }, &ends), [Some(3.0), Some(2.0)]);
    }

    #[test]
    fn what_is_dragged_all_the_way_in_is_no_farther_than_there_is_room() {
        let mut ends = ends();
        for length in [12.346_f32, 12.344, 0.004] {
            ends[0].way = vec![[0.0, 0.0, 0.0, 2.0], [0.0, 0.0, length, 2.0]];
            let Some(ClipAt::Distance(Length::Mm(mm))) = in_mm(&ends[0], length) else { panic!("a distance") };
            assert!((0.0..f64::from(length)).contains(&mm) && f64::from(length) - mm < 0.012, "{mm} of {length}");
        }
    }
}
