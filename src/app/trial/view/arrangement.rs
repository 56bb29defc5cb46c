//! Where the three pictures and their buttons are.

use egui::{Color32, Rect, Role, Ui, Vec2, pos2, vec2};

use crate::app::assist::name;
use crate::app::trial::action::{Action, Arm};
use crate::language::Key;
use crate::say;

/// The words on the buttons in the views' corners.
const TIP_HIDE: Key = Key("trial-tip-hide");
const TIP_SHOW: Key = Key("trial-tip-show");
const LARGE_BACK: Key = Key("trial-large-back");
const LARGE: Key = Key("trial-large");

/// Shows or hides the tip's view.
pub(super) fn tip_button(ui: &mut Ui, at: Rect, shows_tip: &mut bool) {
    let (label, help) = if *shows_tip {
        (TIP_HIDE.say(), say!("trial-tip-hide-help"))
    } else {
        (TIP_SHOW.say(), say!("trial-tip-show-help"))
    };
    let response = ui.put(at, egui::Button::new(label)).on_hover_text(help.to_owned());
    name(&response, Role::Button, &help);
    if response.clicked() {
        *shows_tip = !*shows_tip;
    }
}

/// Where the vessel, the fluoroscopy and the tip's view are; that of a tip's view that is hidden is empty. A large
/// fluoroscopy has all of `area`, and the others are a strip over its right side.
pub(super) fn places(area: Rect, is_large: bool, shows_tip: bool, is_narrow: bool) -> [Rect; 3] {
    let nowhere = Rect::from_min_size(area.right_bottom(), vec2(0.0, 0.0));
    if is_large {
        // Its own writing and buttons stay free.
        let size = vec2(area.width() * if is_narrow { 0.42 } else { 0.3 }, area.height() * 0.7 - 40.0);
        let strip = Rect::from_min_size(pos2(area.right() - size.x - 8.0, area.top() + 40.0), size);
        let nowhere = Rect::from_min_size(strip.right_bottom(), vec2(0.0, 0.0));
        let (vessel, tip) = if shows_tip { strip.split_top_bottom_at_fraction(0.6) } else { (strip, nowhere) };
        return [vessel, area, tip];
    }
    let (vessel, others) =
        if is_narrow { area.split_top_bottom_at_fraction(0.55) } else { area.split_left_right_at_fraction(0.58) };
    let (fluoroscopy, tip) = match (shows_tip, is_narrow) {
        (false, _) => (others, nowhere),
        (true, true) => others.split_left_right_at_fraction(0.5),
        (true, false) => others.split_top_bottom_at_fraction(0.6),
    };
    [vessel, fluoroscopy, tip]
}

/// Where the buttons are that show and hide the tip's view, and that makes the fluoroscopy large.
pub(super) fn buttons(fluoroscopy: Rect, tip: Rect, shows_tip: bool, size: Vec2) -> [Rect; 2] {
    let in_corner = |of: Rect, place: f32| {
        let right = of.right() - 6.0 - place * (size.x + 6.0);
        Rect::from_min_size(pos2(right - size.x, of.top() + 6.0), size)
    };
    if shows_tip {
        [in_corner(tip, 0.0), in_corner(fluoroscopy, 0.0)]
    } else {
        [in_corner(fluoroscopy, 0.0), in_corner(fluoroscopy, 1.0)]
    }
}

/// The width of the longest word on these buttons, in points.
pub(super) fn words_width(ui: &Ui) -> f32 {
    let font = egui::TextStyle::Button.resolve(ui.style());
    let width = |word: Key| ui.painter().layout_no_wrap(word.say(), font.clone(), Color32::WHITE).size().x;
    [TIP_HIDE, TIP_SHOW, LARGE_BACK, LARGE].map(width).into_iter().fold(34.0, f32::max)
}

/// Makes the fluoroscopy the large picture, or lays the pictures side by side again.
pub(super) fn large_button(ui: &mut Ui, at: Rect, is_large: bool) -> Option<Action> {
    let (label, what) = if is_large {
        (LARGE_BACK.say(), say!("trial-large-back-name"))
    } else {
        (LARGE.say(), say!("trial-large-name"))
    };
    let response = ui.put(at, egui::Button::new(label)).on_hover_text(say!("trial-large-help"));
    name(&response, Role::Button, &what);
    response.clicked().then_some(Action::Arm(Arm::Enlarge))
}
