//! What assistive tools are told of a control: what it is, what it is called, where it stands.

use egui::{AsIdSalt, Response, RichText, Role, Ui, WidgetInfo};

use crate::say;

/// Writes a heading, and tells that it is one, of the second level: the first is the page's own. AccessKit counts from 0.
pub(super) fn heading(ui: &mut Ui, text: &str) {
    let response = ui.label(RichText::new(text).heading());
    name(&response, Role::Heading, text);
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_level(1));
}

/// Tells what a control is called.
pub(super) fn name(response: &Response, kind: Role, label: &str) {
    response.widget_info(|| WidgetInfo::labeled(kind, response.enabled(), label));
}

/// Tells what the edge of a panel is called that is drawn to another size: egui says it in English. `panel` is the panel's
/// name in `ui`.
pub(super) fn name_edge(ui: &Ui, panel: impl AsIdSalt) {
    let edge = ui.scope_id().with(panel).with("__resize");
    if ui.ctx().has_accesskit_node(edge) {
        ui.ctx().accesskit_node_builder(edge, |node| node.set_label(say!("app-panel-edge")));
    }
}

/// Tells what a control is called and where it stands.
pub(super) fn describe(response: &Response, kind: Role, label: &str, value: f64) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(kind, response.enabled(), label);
        info.value = Some(value);
        info
    });
}
