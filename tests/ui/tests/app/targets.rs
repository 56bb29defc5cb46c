//! What a hand can hit: how large it is, and whether it lies over something else.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, Node};
use lumen::app::LumenApp;
use lumen::say;

const ROLES: [Role; 7] = [
    Role::Button,
    Role::CheckBox,
    Role::ComboBox,
    Role::DisclosureTriangle,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
];

/// All of them, in sight or scrolled out of it.
pub(crate) fn targets<'a>(harness: &'a Harness<'_, LumenApp>) -> Vec<Node<'a>> {
    let nodes: Vec<_> = ROLES.into_iter().flat_map(|role| harness.query_all_by_role(role)).collect();
    assert!(nodes.len() > 5, "there are targets");
    nodes
}

/// What it is called, and where it is.
pub(crate) fn words(node: &Node<'_>) -> String {
    format!("{:?} {}", node.accesskit_node().label().unwrap_or_default(), node.rect())
}

/// Those that are not 44 points wide and high.
fn too_small(harness: &Harness<'_, LumenApp>) -> Vec<String> {
    targets(harness).iter().filter(|node| node.rect().size().min_elem() < 43.9).map(words).collect()
}

/// Pairs of one bar, one panel, one menu that lie over one another. What is scrolled out of a panel's sight lies over nothing,
/// wherever it is.
pub(crate) fn overlapping(harness: &Harness<'_, LumenApp>) -> Vec<String> {
    let line = |node: &Node<'_>| {
        let mut line = vec![node.accesskit_node().id()];
        let mut next = node.accesskit_node().parent();
        while let Some(parent) = next {
            line.push(parent.id());
            next = parent.parent();
        }
        line
    };
    // The bar stands in what all else stands in.
    let bar = line(&harness.get_by_role_and_label(Role::Button, &say!("app-open")));
    // What scrolls below the three sliders of the method is cut off at the edge of what they stand in.
    let sliders = [say!("panel-pass-band"), say!("panel-reduction")];
    let [first, last] = sliders.each_ref().map(|label| {
        let slider = harness.query_by_role_and_label(Role::Slider, label);
        slider.map_or_else(Vec::new, |slider| line(&slider))
    });
    let dock = first.into_iter().find(|id| last.contains(id));
    let handles = [say!("app-panel-low"), say!("app-panel-half"), say!("app-panel-full")];
    let is_handle = |node: &Node<'_>| node.accesskit_node().label().is_some_and(|label| handles.contains(&label));
    // A slider with a field has the field in it.
    let has_inside = |a: &Node<'_>, b: &Node<'_>| {
        let roles = [a, b].map(|node| node.accesskit_node().role());
        roles == [Role::Slider, Role::SpinButton] && a.rect().contains_rect(b.rect())
    };
    let nodes: Vec<_> = targets(harness).into_iter().filter(|node| !is_handle(node)).collect();
    let ids: Vec<_> = nodes.iter().map(|node| node.accesskit_node().id()).collect();
    // Each with what it stands in, and the button that opens the menu that it is in: that may lie over what is beside it.
    let targets = nodes.iter().map(|node| {
        let line = line(node);
        let opener = line[1..].iter().copied().find(|id| ids.contains(id));
        (node, line, opener)
    });
    let targets: Vec<_> = targets.collect();
    let mut found = Vec::new();
    for (i, (node, line, opener)) in targets.iter().enumerate() {
        for (other, other_line, other_opener) in &targets[i + 1..] {
            let common = node.rect().intersect(other.rect());
            if common.width().min(common.height()) <= 1.0 || has_inside(node, other) || has_inside(other, node) {
                continue;
            }
            let stands_in = line.iter().find(|id| other_line.contains(id));
            if stands_in.is_some_and(|id| !bar[2..].contains(id))
                && opener == other_opener
                && dock.is_none_or(|dock| line.contains(&dock) == other_line.contains(&dock))
            {
                found.push(format!("{} and {}", words(node), words(other)));
            }
        }
    }
    found
}

/// Asserts that a finger can hit each of them, and hits no other with it.
pub(crate) fn fits_a_finger(harness: &Harness<'_, LumenApp>, screen: &str) {
    assert_eq!(too_small(harness), [""; 0], "{screen}: too small");
    assert_eq!(overlapping(harness), [""; 0], "{screen}: over one another");
}
