//! What assistive tools are told of a control: what it is, what it is called, where it stands.

use egui::{Response, Role, WidgetInfo};

/// Tells what a control is called.
pub(super) fn name(response: &Response, kind: Role, label: &str) {
    response.widget_info(|| WidgetInfo::labeled(kind, response.enabled(), label));
}

/// Tells what a control is called and where it stands.
pub(super) fn describe(response: &Response, kind: Role, label: &str, value: f64) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(kind, response.enabled(), label);
        info.value = Some(value);
        info
    });
}
