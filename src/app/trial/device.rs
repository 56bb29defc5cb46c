//! The haptic device in the panel: which one, which of its axes feed and roll, and its force.

use egui::{Button, ComboBox, DragValue, ProgressBar, Role, Slider, Ui};

use super::action::{Action, DeviceAsk};
use crate::app::assist::name;
use crate::app::overlay::NOT_CLINICAL;
use crate::app::platform::{Devices, Listing};
use crate::app::row::{number, remark, row, warning};
use crate::haptics::feeder::HALF_WAY;
use crate::haptics::latency::Percentiles;
use crate::haptics::learning::Ask;
use crate::haptics::mapping::{AxisMapping, Mapping, Mode};
use crate::haptics::safety::Halt;
use crate::haptics::service::{DeviceCommand, DeviceStatus};

/// What is known of haptic devices.
#[derive(Default)]
pub(super) struct Device {
    /// Names of those that can be chosen; `None` where the platform has none.
    choices: Option<Vec<String>>,
    /// Why the system lists none.
    problem: Option<String>,
    chosen: Option<usize>,
    status: Option<DeviceStatus>,
    /// Whether the user is being told what will move.
    is_confirming: bool,
    is_paused: bool,
    /// Whether it went in the middle of a trial, which waits for it.
    is_missed: bool,
}

/// What a device has to know of its trial.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrialState {
    /// Whether there is one.
    pub(super) is_open: bool,
    /// Whether it goes on by hand.
    pub(super) is_driven: bool,
    /// Whether it is paused.
    pub(super) is_paused: bool,
}

impl Device {
    /// Whether the platform has any to choose from.
    pub(super) fn is_offered(&self) -> bool {
        self.choices.is_some()
    }

    /// Whether one is served.
    pub(super) fn is_served(&self) -> bool {
        self.status.as_ref().is_some_and(|status| status.ended.is_none())
    }

    /// Whether its force is armed.
    pub(super) fn is_armed(&self) -> bool {
        self.is_served() && self.status.as_ref().is_some_and(|status| status.has_force && status.halted.is_none())
    }

    /// Hears how the device is. A window that is hidden, or has no keys, has no hand on it: its force ends. Devices are listed
    /// once there is a trial. Says whether the trial has to be paused, as the device that held its wire is gone, or has to go on,
    /// as one is there again.
    pub(super) fn follow(&mut self, devices: Option<&mut dyn Devices>, is_hidden: bool, trial: TrialState) -> bool {
        let Some(devices) = devices else { return false };
        if self.choices.is_none() && trial.is_open {
            self.look(devices);
        }
        if let Some(Listing { names, problem, chosen }) = devices.changed() {
            (self.choices, self.problem, self.chosen) = (Some(names), problem, chosen);
        }
        let was_served = self.is_served();
        self.status = devices.status();
        if is_hidden && self.is_armed() {
            devices.ask(DeviceCommand::Halt(Halt::Hidden));
        }
        let stands = !trial.is_driven || trial.is_paused;
        if stands != self.is_paused || self.is_served() && !was_served {
            self.is_paused = stands;
            devices.ask(DeviceCommand::Pause(stands));
        }
        if was_served && self.status.as_ref().is_some_and(|status| status.ended.is_some()) && trial.is_driven {
            self.is_missed = true;
            return !trial.is_paused;
        }
        self.is_served() && std::mem::take(&mut self.is_missed) && trial.is_paused
    }

    /// Does what is asked of it.
    pub(super) fn act(&mut self, ask: DeviceAsk, devices: Option<&mut dyn Devices>) {
        let Some(devices) = devices else { return };
        match ask {
            DeviceAsk::Look => self.look(devices),
            DeviceAsk::Choose(chosen) => {
                (self.chosen, self.is_confirming) = (chosen, false);
                devices.choose(chosen);
                devices.ask(DeviceCommand::Pause(self.is_paused));
                self.status = devices.status();
            }
            DeviceAsk::Confirm(on) => self.is_confirming = on,
            // Files are the app's.
            DeviceAsk::SaveLatency => {}
            DeviceAsk::Command(command) => {
                self.is_confirming = false;
                devices.ask(command);
            }
        }
    }

    /// The times of the device that is served, as a table of one line; `None` before it has any.
    pub(super) fn latency_table(&self) -> Option<String> {
        let DeviceStatus { name, latency, .. } = self.status.as_ref().filter(|status| status.latency.count > 0)?;
        let Percentiles { count, p50_ms, p95_ms, p99_ms } = latency;
        let (version, name) = (env!("CARGO_PKG_VERSION"), name.replace('"', "\"\""));
        Some(format!(
            "# From input report to output report; Lumen {version}. {NOT_CLINICAL}.\n\
             device,reports,p50_ms,p95_ms,p99_ms\n\"{name}\",{count},{p50_ms:.1},{p95_ms:.1},{p99_ms:.1}\n"
        ))
    }

    fn look(&mut self, devices: &mut dyn Devices) {
        let (choices, problem) = devices.look();
        (self.choices, self.problem, self.chosen) = (Some(choices), problem, None);
        devices.choose(None);
    }
}

/// Shows it; nothing where the platform has no devices.
pub(super) fn show(ui: &mut Ui, device: &Device, asked: &mut Vec<Action>) {
    let Some(choices) = &device.choices else { return };
    let mut ask = |what| asked.push(Action::Device(what));
    row(ui, "Device", "What the wire is held by, beside keys and pads", |ui| {
        if ui.button("Look again").on_hover_text("Lists the devices that are plugged in now").clicked() {
            ask(DeviceAsk::Look);
        }
        let chosen = device.chosen.and_then(|chosen| choices.get(chosen)).map_or("None", String::as_str);
        let list = ComboBox::from_id_salt("device").selected_text(chosen).show_ui(ui, |ui| {
            if ui.selectable_label(device.chosen.is_none(), "None").clicked() {
                ask(DeviceAsk::Choose(None));
            }
            for (i, choice) in choices.iter().enumerate() {
                if ui.selectable_label(device.chosen == Some(i), choice).clicked() {
                    ask(DeviceAsk::Choose(Some(i)));
                }
            }
        });
        name(&list.response, Role::ComboBox, "Device");
    });
    if let Some(problem) = &device.problem {
        warning(ui, problem);
    }
    let Some(status) = &device.status else { return };
    if let Some(ended) = &status.ended {
        warning(ui, ended);
        return;
    }
    if let Some(wanted) = status.wanted {
        hand(ui, wanted, &mut ask);
    }
    axes(ui, status, &mut ask);
    force(ui, device, status, &mut ask);
}

/// Where the hand on the virtual device wants it.
fn hand(ui: &mut Ui, mut wanted: [f64; 2], ask: &mut impl FnMut(DeviceAsk)) {
    let before = wanted;
    row(ui, "Hand at", "Where the hand on the virtual device wants its slide", |ui| {
        let slider = Slider::new(&mut wanted[0], -HALF_WAY[0]..=HALF_WAY[0]).suffix(" mm").fixed_decimals(1);
        name(&ui.add(slider), Role::Slider, "Hand at");
    });
    row(ui, "Turned to", "Where the hand on the virtual device wants its knob", |ui| {
        let slider = Slider::new(&mut wanted[1], -HALF_WAY[1]..=HALF_WAY[1]).suffix(" rad").fixed_decimals(2);
        name(&ui.add(slider), Role::Slider, "Turned to");
    });
    if wanted != before {
        ask(DeviceAsk::Command(DeviceCommand::Want(wanted)));
    }
}

/// The axes as they are, and what they do.
fn axes(ui: &mut Ui, status: &DeviceStatus, ask: &mut impl FnMut(DeviceAsk)) {
    for axis in &status.axes {
        row(ui, &axis.name, "Where the axis is between its ends, and its number", |ui| {
            let raw = axis.raw.map_or("-".to_owned(), |raw| raw.to_string());
            ui.add(ProgressBar::new((0.5 + 0.5 * axis.part) as f32).desired_width(120.0).text(raw));
        });
    }
    match status.asks {
        Some(Ask::Push) => remark(ui, "Push the device forward, as if to feed the wire."),
        Some(Ask::Turn) => remark(ui, "Turn it to the right, as if to roll the wire."),
        Some(Ask::Done) | None => {}
    }
    let mut mapping = status.mapping;
    mapped(ui, "Feed", "mm", &mut mapping.feed, status);
    mapped(ui, "Roll", "rad", &mut mapping.roll, status);
    if mapping != status.mapping {
        ask(DeviceAsk::Command(DeviceCommand::Map(mapping)));
    }
    ui.horizontal_wrapped(|ui| {
        let learn = Button::new("Learn axes").selected(status.asks.is_some());
        if ui.add(learn).on_hover_text("Finds out which axis you push and which you turn").clicked() {
            let stop = DeviceCommand::Map(status.mapping);
            ask(DeviceAsk::Command(if status.asks.is_some() { stop } else { DeviceCommand::Learn }));
        }
        if !status.has_force && status.mapping != Mapping::default() {
            ui.label("No force by these axes.");
        }
    });
}

/// Which axis, how far it moves, and whether the other way round.
fn mapped(ui: &mut Ui, what: &str, unit: &str, mapping: &mut Option<AxisMapping>, status: &DeviceStatus) {
    let Some(of) = mapping else { return };
    row(ui, what, "Which axis, what its way moves, and which way is forward", |ui| {
        ui.checkbox(&mut of.is_inverted, "Inverted");
        let (value, suffix) = match &mut of.mode {
            Mode::Absolute { travel } => (travel, format!(" {unit}")),
            Mode::Relative { per_count } => (per_count, format!(" {unit}/count")),
            Mode::Rate { full } => (full, format!(" {unit}/s")),
        };
        let far = ui.add(DragValue::new(value).range(0.01..=1000.0).suffix(suffix).max_decimals(2));
        name(&far, Role::SpinButton, &format!("{what}: how far"));
        let axis = status.axes.get(of.axis).map_or("-", |axis| axis.name.as_str());
        let list = ComboBox::from_id_salt(what).selected_text(axis).width(56.0).show_ui(ui, |ui| {
            for (i, axis) in status.axes.iter().enumerate() {
                ui.selectable_value(&mut of.axis, i, &axis.name);
            }
        });
        name(&list.response, Role::ComboBox, &format!("{what}: axis"));
    });
}

/// Its force: armed by the user who has read what will move, and stopped by one press.
fn force(ui: &mut Ui, device: &Device, status: &DeviceStatus, ask: &mut impl FnMut(DeviceAsk)) {
    if !status.has_force {
        return;
    }
    let mut factor = status.factor;
    row(ui, "Felt as", "The part of the device's most force that 1 N along the wire is felt as", |ui| {
        let value = DragValue::new(&mut factor[0]).range(0.0..=20.0).speed(0.01).suffix(" /N").max_decimals(2);
        name(&ui.add(value), Role::SpinButton, "Felt as");
    });
    row(ui, "Torque as", "The part of the device's most force that 1 N mm about the wire is felt as", |ui| {
        let value = DragValue::new(&mut factor[1]).range(0.0..=5.0).speed(0.001).suffix(" /N mm").max_decimals(3);
        name(&ui.add(value), Role::SpinButton, "Torque as");
    });
    if factor != status.factor {
        ask(DeviceAsk::Command(DeviceCommand::Factor(factor)));
    }
    let halt = DeviceAsk::Command(DeviceCommand::Halt(Halt::Stopped));
    if status.halted.is_none() {
        if ui.button("Stop force").on_hover_text("The device lets go at once (Esc)").clicked() {
            ask(halt);
        }
    } else if device.is_confirming {
        remark(
            ui,
            "The device will push back by itself, with up to 40 % of its force. Hold it loosely, and keep hair, cables and \
             cups away. Esc, the stop button, or leaving this window ends it.",
        );
        ui.horizontal(|ui| {
            if ui.button("Arm force").clicked() {
                ask(DeviceAsk::Command(DeviceCommand::Arm));
            }
            if ui.button("Not now").clicked() {
                ask(DeviceAsk::Confirm(false));
            }
        });
    } else if ui.button("Arm force...").on_hover_text("Says what will move, then lets it").clicked() {
        ask(DeviceAsk::Confirm(true));
    }
    if let Some(why) = status.halted.and_then(why) {
        remark(ui, why);
    }
    if let Some(felt) = status.felt {
        // Nought has no sign.
        let [force, torque] = felt.map(|value| if value.abs() < 5e-4 { 0.0 } else { value });
        number(ui, "Felt", &format!("{force:.3} N, {torque:.3} N mm"), "What the hand holds at the guide");
    }
    let latency = status.latency;
    if latency.count > 0 {
        let times = format!("{:.1} / {:.1} / {:.1} ms", latency.p50_ms, latency.p95_ms, latency.p99_ms);
        number(ui, "Latency", &times, "From input report to output report: half, 95 % and 99 % are not longer");
        let what = "Saves these times, the device's name and Lumen's version as a small table, and nothing else";
        if ui.button("Save latency").on_hover_text(what).clicked() {
            ask(DeviceAsk::SaveLatency);
        }
    }
}

/// Why its force has ended, where the user did not end it.
fn why(halt: Halt) -> Option<&'static str> {
    match halt {
        Halt::NotArmed | Halt::Stopped => None,
        Halt::Hidden => Some("The force was ended as the window was left."),
        Halt::Unplugged => Some("The force was ended as the device was unplugged."),
        Halt::NotANumber => Some("The force was ended: the trial gave no number for it."),
        Halt::Refused => Some("The force was ended: the device takes no more reports."),
    }
}
