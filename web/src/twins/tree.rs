//! From egui's AccessKit tree to a list of twins: which nodes get one, its role, name, value and place.
//!
//! The roles are those of WAI-ARIA 1.2. Containers that mean nothing to a reader (panels, layouts) get no twin; their
//! children become children of the nearest ancestor that has one.

use std::collections::HashMap;

use egui::accesskit::{Affine, Live, Node, NodeId, Orientation, Role, Toggled, TreeUpdate};

/// One control as the page shows it to assistive tools.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Twin {
    /// The node it mirrors.
    pub(crate) id: NodeId,
    /// Index in the list of the twin it lies in; always smaller than its own.
    pub(crate) parent: Option<usize>,
    /// Left, top, width and height in CSS pixels from the canvas's corner; `None` where egui gives no place.
    pub(crate) place: Option<[f64; 4]>,
    /// Attributes and their values; `role` first if there is one.
    pub(crate) attributes: Vec<(&'static str, String)>,
    /// Text content, for plain text and for fields.
    pub(crate) text: Option<String>,
}

/// The twins of a whole tree, in reading order, parents before children.
///
/// `device_pixels` is how many device pixels make a CSS pixel: egui's tree is in the former.
pub(crate) fn twins(update: &TreeUpdate, device_pixels: f64) -> Vec<Twin> {
    let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let mut list = Vec::new();
    if let Some(tree) = &update.tree {
        let scale = Affine::scale(1.0 / device_pixels);
        walk(tree.root, &nodes, &Above { to_page: scale, twin: None, role: Role::Unknown }, &mut list);
    }
    list
}

/// What a node inherits from its ancestors.
struct Above {
    to_page: Affine,
    twin: Option<usize>,
    role: Role,
}

fn walk(id: NodeId, nodes: &HashMap<NodeId, &Node>, above: &Above, list: &mut Vec<Twin>) {
    let Some(node) = nodes.get(&id).copied() else { return };
    if node.is_hidden() {
        return;
    }
    let to_page = node.transform().map_or(above.to_page, |own| above.to_page * *own);
    let mut below = Above { to_page, twin: above.twin, role: above.role };
    if let Some((attributes, text)) = describe(node, nodes, above) {
        let place = node.bounds().map(|bounds| {
            let rect = to_page.transform_rect_bbox(bounds);
            [rect.x0, rect.y0, rect.width(), rect.height()]
        });
        below.twin = Some(list.len());
        below.role = node.role();
        // What pops up is egui's child of the control that opens it, and nobody's in the page: controls hold no others.
        let pops_up =
            matches!(node.role(), Role::Menu | Role::MenuListPopup | Role::ListBox | Role::Dialog | Role::Window);
        let parent = above.twin.filter(|_| !pops_up);
        list.push(Twin { id, parent, place, attributes, text });
    }
    for child in node.children() {
        walk(*child, nodes, &below, list);
    }
}

type Description = (Vec<(&'static str, String)>, Option<String>);

/// Role, name, states and text of a node, or `None` where it needs no twin.
fn describe(node: &Node, nodes: &HashMap<NodeId, &Node>, above: &Above) -> Option<Description> {
    let name = name(node, nodes);
    let role = aria_role(node, above, name.is_some())?;
    // What has no name is called as it begins.
    let name = name.or_else(|| matches!(role, "dialog" | "alertdialog").then(|| first_text(node, nodes)).flatten());
    let is_text = matches!(node.role(), Role::Label | Role::Heading);
    let is_field = matches!(role, "textbox" | "searchbox" | "combobox" | "status" | "alert");
    let text = match (is_text, is_field) {
        (true, _) => node.value().map(str::to_owned).or_else(|| name.clone()),
        (false, true) => node.value().map(str::to_owned),
        (false, false) => None,
    };
    if is_text && text.as_deref().is_none_or(|text| text.trim().is_empty()) {
        return None;
    }

    let mut attributes = Vec::with_capacity(8);
    let mut set = |key, value: String| attributes.push((key, value));
    if !role.is_empty() {
        set("role", role.to_owned());
    }
    if is_text && role == "menuitem" {
        set("aria-disabled", "true".to_owned());
    }
    if let Some(name) = name.filter(|_| !is_text) {
        set("aria-label", name);
    }
    if let Some(description) = node.description() {
        set("aria-description", description.to_owned());
    }
    if let Some(placeholder) = node.placeholder() {
        set("aria-placeholder", placeholder.to_owned());
    }
    for (key, value) in values(node, role, is_field) {
        set(key, value);
    }
    for (key, value) in states(node, role) {
        set(key, value);
    }
    Some((attributes, text))
}

/// The ARIA role; empty for plain text, `None` for what gets no twin.
fn aria_role(node: &Node, above: &Above, named: bool) -> Option<&'static str> {
    let in_menu = matches!(above.role, Role::Menu | Role::MenuBar | Role::MenuListPopup);
    let is_choice = node.toggled().is_some() || node.is_selected().is_some();
    Some(match node.role() {
        Role::Button | Role::DefaultButton if above.role == Role::ListBox => "option",
        Role::Button | Role::DefaultButton if in_menu && is_choice => "menuitemradio",
        Role::Button | Role::DefaultButton if in_menu => "menuitem",
        Role::Button | Role::DefaultButton | Role::DisclosureTriangle | Role::ColorWell => "button",
        Role::CheckBox if in_menu => "menuitemcheckbox",
        Role::CheckBox => "checkbox",
        Role::Switch => "switch",
        Role::RadioButton if in_menu => "menuitemradio",
        Role::RadioButton => "radio",
        Role::RadioGroup => "radiogroup",
        Role::Slider => "slider",
        Role::SpinButton => "spinbutton",
        Role::SearchInput => "searchbox",
        Role::TextInput
        | Role::MultilineTextInput
        | Role::NumberInput
        | Role::PasswordInput
        | Role::UrlInput
        | Role::EmailInput => "textbox",
        Role::ComboBox | Role::EditableComboBox => "combobox",
        Role::ListBox => "listbox",
        Role::ListBoxOption | Role::MenuListOption => "option",
        Role::Link => "link",
        // A menu holds items alone: a text is one that does nothing.
        Role::Label if in_menu => "menuitem",
        Role::Label => "",
        Role::Heading => "heading",
        Role::Image | Role::Canvas | Role::Figure | Role::GraphicsDocument => "img",
        Role::ProgressIndicator => "progressbar",
        Role::Meter => "meter",
        Role::Tab => "tab",
        Role::TabList => "tablist",
        Role::TabPanel => "tabpanel",
        Role::Menu | Role::MenuListPopup => "menu",
        Role::MenuBar => "menubar",
        Role::MenuItem => "menuitem",
        Role::MenuItemCheckBox => "menuitemcheckbox",
        Role::MenuItemRadio => "menuitemradio",
        Role::Dialog => "dialog",
        Role::AlertDialog => "alertdialog",
        // The root of the tree is a window too, but it is the page itself and has no name.
        Role::Window if named => "dialog",
        Role::Alert => "alert",
        Role::Status => "status",
        Role::Tooltip => "tooltip",
        Role::Splitter => "separator",
        Role::Toolbar => "toolbar",
        Role::List => "list",
        Role::ListItem => "listitem",
        Role::Table => "table",
        Role::Row => "row",
        Role::Cell => "cell",
        Role::RowHeader => "rowheader",
        Role::ColumnHeader => "columnheader",
        Role::Region | Role::Pane if named => "region",
        Role::Group | Role::GenericContainer if named => "group",
        _ => return None,
    })
}

/// The name: the node's own, else the text of what labels it.
fn name(node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<String> {
    let own = node.label().map(str::to_owned);
    own.or_else(|| {
        let texts = node.labelled_by().iter().filter_map(|id| nodes.get(id));
        let texts: Vec<&str> = texts.filter_map(|label| label.value().or_else(|| label.label())).collect();
        (!texts.is_empty()).then(|| texts.join(" "))
    })
    .map(|name| name.trim().trim_end_matches(':').to_owned())
    .filter(|name| !name.is_empty())
}

/// The first text in a node, in reading order.
fn first_text(node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<String> {
    node.children().iter().filter_map(|id| nodes.get(id)).find_map(|child| {
        let own = child.value().or_else(|| child.label()).filter(|_| child.role() == Role::Label);
        own.map(str::to_owned).or_else(|| first_text(child, nodes))
    })
}

/// Numeric value and bounds, with the value as it is drawn (unit and all) for tools to read out.
fn values(node: &Node, role: &str, is_field: bool) -> impl Iterator<Item = (&'static str, String)> {
    let ranged = matches!(role, "slider" | "spinbutton" | "progressbar" | "meter" | "separator");
    let numbers = [
        ("aria-valuenow", node.numeric_value()),
        ("aria-valuemin", node.min_numeric_value()),
        ("aria-valuemax", node.max_numeric_value()),
    ];
    let numbers =
        numbers.into_iter().filter_map(move |(key, value)| value.filter(|_| ranged).map(|v| (key, v.to_string())));
    let text = node.value().filter(|_| ranged && !is_field).map(|text| ("aria-valuetext", text.to_owned()));
    numbers.chain(text)
}

/// What is on, open, chosen, disabled.
fn states(node: &Node, role: &str) -> impl Iterator<Item = (&'static str, String)> {
    let toggled_key = match role {
        "checkbox" | "radio" | "switch" | "menuitemcheckbox" | "menuitemradio" => "aria-checked",
        "option" | "tab" | "row" => "aria-selected",
        _ => "aria-pressed",
    };
    let toggled = node.toggled().map(|toggled| match toggled {
        Toggled::True => "true",
        Toggled::False => "false",
        Toggled::Mixed => "mixed",
    });
    let live = node.live().and_then(|live| match live {
        Live::Off => None,
        Live::Polite => Some("polite"),
        Live::Assertive => Some("assertive"),
    });
    let orientation = node.orientation().map(|orientation| match orientation {
        Orientation::Horizontal => "horizontal",
        Orientation::Vertical => "vertical",
    });
    let yes_no = |value: bool| if value { "true" } else { "false" };
    [
        (toggled_key, toggled),
        ("aria-selected", node.is_selected().filter(|_| toggled.is_none()).map(yes_no)),
        // A list that says nothing of it is closed.
        ("aria-expanded", node.is_expanded().or((role == "combobox").then_some(false)).map(yes_no)),
        ("aria-disabled", node.is_disabled().then_some("true")),
        ("aria-modal", node.is_modal().then_some("true")),
        ("aria-readonly", node.is_read_only().then_some("true")),
        ("aria-live", live),
        ("aria-orientation", orientation),
    ]
    .into_iter()
    .filter_map(|(key, value)| value.map(|value| (key, value.to_owned())))
    // AccessKit counts from 0.
    .chain(node.level().map(|level| ("aria-level", (level + 1).to_string())))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second pass of egui over `content`, since in the first a sheet only measures itself, in a window of 400 x 300 points at `scale` device pixels a point.
    fn twins_of(scale: f32, mut content: impl FnMut(&mut egui::Ui)) -> Vec<Twin> {
        let ctx = egui::Context::default();
        ctx.enable_accesskit();
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 300.0))),
            ..Default::default()
        };
        if let Some(viewport) = input.viewports.get_mut(&egui::ViewportId::ROOT) {
            viewport.native_pixels_per_point = Some(scale);
        }
        let mut first = ctx.run_ui(input.clone(), |ui| content(ui));
        first.textures_delta.clear();
        let mut output = ctx.run_ui(input, |ui| content(ui));
        // Nothing is drawn here.
        output.textures_delta.clear();
        twins(&output.platform_output.accesskit_update.expect("AccessKit is enabled"), f64::from(scale))
    }

    fn attribute<'a>(twin: &'a Twin, key: &str) -> Option<&'a str> {
        twin.attributes.iter().find(|(k, _)| *k == key).map(|(_, value)| value.as_str())
    }

    fn find<'a>(twins: &'a [Twin], role: &str, name: &str) -> &'a Twin {
        twins
            .iter()
            .find(|twin| attribute(twin, "role") == Some(role) && attribute(twin, "aria-label") == Some(name))
            .unwrap_or_else(|| panic!("no {role} named {name} in {twins:#?}"))
    }

    #[test]
    fn a_slider_has_its_name_value_and_bounds() {
        let mut rate = 90.0;
        let twins = twins_of(1.0, |ui| {
            ui.add(egui::Slider::new(&mut rate, 0.0..=99.9).text("Reduction"));
        });
        let slider = find(&twins, "slider", "Reduction");
        assert_eq!(attribute(slider, "aria-valuenow"), Some("90"));
        assert_eq!(attribute(slider, "aria-valuemin"), Some("0"));
        assert_eq!(attribute(slider, "aria-valuemax"), Some("99.9"));
    }

    #[test]
    fn a_heading_has_its_text_and_level() {
        let twins = twins_of(1.0, |ui| {
            let id = ui.label("Smooth").id;
            ui.ctx().accesskit_node_builder(id, |node| {
                node.set_role(Role::Heading);
                node.set_level(1);
            });
        });
        let heading = twins.iter().find(|twin| attribute(twin, "role") == Some("heading")).expect("a heading");
        assert_eq!((heading.text.as_deref(), attribute(heading, "aria-level")), (Some("Smooth"), Some("2")));
    }

    #[test]
    fn a_field_takes_its_name_from_its_label() {
        let mut text = "aorta".to_owned();
        let twins = twins_of(1.0, |ui| {
            let label = ui.label("File:");
            ui.text_edit_singleline(&mut text).labelled_by(label.id);
        });
        assert_eq!(find(&twins, "textbox", "File").text.as_deref(), Some("aorta"));
    }

    #[test]
    fn states_are_told() {
        let (mut on, mut choice) = (true, 1);
        let twins = twins_of(1.0, |ui| {
            ui.checkbox(&mut on, "Wireframe");
            ui.radio_value(&mut choice, 2, "Hamming");
            ui.add_enabled(false, egui::Button::new("Save..."));
            ui.selectable_value(&mut choice, 1, "Before");
        });
        assert_eq!(attribute(find(&twins, "checkbox", "Wireframe"), "aria-checked"), Some("true"));
        assert_eq!(attribute(find(&twins, "radio", "Hamming"), "aria-checked"), Some("false"));
        assert_eq!(attribute(find(&twins, "button", "Save..."), "aria-disabled"), Some("true"));
        assert_eq!(attribute(find(&twins, "button", "Before"), "aria-pressed"), Some("true"));
    }

    #[test]
    fn a_sheet_is_called_as_it_begins_and_a_closed_list_says_so() {
        let twins = twins_of(1.0, |ui| {
            egui::ComboBox::from_id_salt("window").selected_text("Hamming").show_ui(ui, |_| {});
            egui::Modal::new(egui::Id::unique("help")).show(ui.ctx(), |ui| {
                ui.vertical(|ui| ui.label("Keys and gestures"));
                ui.label("Drag");
            });
        });
        find(&twins, "dialog", "Keys and gestures");
        let list = twins.iter().find(|twin| attribute(twin, "role") == Some("combobox")).expect("a list");
        assert_eq!(attribute(list, "aria-expanded"), Some("false"));
    }

    #[test]
    fn places_are_css_pixels_at_any_device_scale() {
        let mut drawn = egui::Rect::NOTHING;
        for scale in [1.0, 2.0, 1.25] {
            let twins = twins_of(scale, |ui| drawn = ui.button("Open...").rect);
            let place = find(&twins, "button", "Open...").place.expect("a button has a place");
            let expected = [drawn.min.x, drawn.min.y, drawn.width(), drawn.height()].map(f64::from);
            for (is, should) in place.iter().zip(expected) {
                assert!((is - should).abs() < 1e-3, "{place:?} is not {expected:?} at scale {scale}");
            }
        }
    }

    #[test]
    fn text_is_text_and_layouts_are_nothing() {
        let twins = twins_of(1.0, |ui| {
            ui.horizontal(|ui| ui.vertical(|ui| ui.label("66,982 triangles")));
        });
        assert_eq!(twins.len(), 1, "{twins:#?}");
        assert_eq!(twins[0].text.as_deref(), Some("66,982 triangles"));
        assert_eq!(twins[0].parent, None);
        assert_eq!(attribute(&twins[0], "role"), None);
    }
}
