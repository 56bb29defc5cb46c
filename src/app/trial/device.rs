//! The haptic device in the panel: which one, which of its axes feed and roll, and its force.

use egui::{Button, ComboBox, DragValue, ProgressBar, Role, Slider, Ui};

use super::action::{Action, DeviceAsk};
use crate::app::assist::name;
use crate::app::control::reads_comma;
use crate::app::platform::{Devices, Listing};
use crate::app::row::{number, remark, row, warning};
use crate::haptics::feeder::HALF_WAY;
use crate::haptics::known::KnownMappings;
use crate::haptics::latency::Percentiles;
use crate::haptics::learning::Ask;
use crate::haptics::mapping::{AxisMapping, Mapping, Mode};
use crate::haptics::safety::Halt;
use crate::haptics::service::{DeviceCommand, DeviceStatus};
use crate::language::{Key, decimal, parse};
use crate::say;

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
    plug: Plug,
    /// What feeds and rolls by devices that were used before.
    known: KnownMappings,
}

/// What the plug of the device has done.
#[derive(Default)]
enum Plug {
    /// Nothing.
    #[default]
    In,
    /// It was pulled out.
    Out {
        /// Whether the trial waits for it.
        is_missed: bool,
        /// How the device was before.
        before: Box<DeviceStatus>,
    },
    /// It, or another, is there again, and its force was not armed yet.
    Back,
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

    /// What feeds and rolls by devices that were used before.
    pub(super) fn known(&self) -> &KnownMappings {
        &self.known
    }

    /// The same, as it was kept; nothing where it is to be forgotten.
    pub(super) fn set_known(&mut self, known: KnownMappings) {
        self.known = known;
    }

    /// The trial is over: nothing is known of a device any more but what was learnt.
    pub(super) fn forget_trial(&mut self) {
        *self = Self { known: std::mem::take(&mut self.known), ..Self::default() };
    }

    /// By what the one that is served is remembered; empty where none is open.
    fn key(&self) -> &str {
        self.status.as_ref().filter(|status| status.ended.is_none()).map_or("", |status| status.key.as_str())
    }

    /// A device that was used before is held as it was then; what was learnt is remembered.
    fn remember(&mut self, before: Option<&DeviceStatus>, devices: &mut dyn Devices) {
        let Some(status) = self.status.as_ref().filter(|status| status.ended.is_none()) else { return };
        let (key, axes, mapping) = (&status.key, status.axes.len(), status.mapping);
        match before.filter(|before| before.ended.is_none() && before.key == *key) {
            Some(before) => {
                if before.asks.is_some() && status.asks.is_none() && before.mapping != mapping {
                    self.known.remember(key, axes, mapping);
                }
            }
            None => {
                if let Some(known) = self.known.get(key, axes).filter(|known| *known != mapping) {
                    devices.ask(DeviceCommand::Map(known));
                }
            }
        }
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
        let (was_served, was_open) = (self.is_served(), !self.key().is_empty());
        let before = std::mem::replace(&mut self.status, devices.status());
        self.remember(before.as_ref(), devices);
        if is_hidden && self.is_armed() {
            devices.ask(DeviceCommand::Halt(Halt::Hidden));
        }
        let stands = !trial.is_driven || trial.is_paused;
        if stands != self.is_paused || self.is_served() && !was_served {
            self.is_paused = stands;
            devices.ask(DeviceCommand::Pause(stands));
        }
        if was_open && self.status.as_ref().is_some_and(|status| status.ended.is_some()) {
            self.plug = Plug::Out { is_missed: trial.is_driven, before: Box::new(before.unwrap_or_default()) };
            self.is_confirming = false;
            return trial.is_driven && !trial.is_paused;
        }
        self.take_up(devices) && trial.is_paused
    }

    /// A device that was pulled out is there again, felt as before once it is armed. Says whether the trial has waited for it.
    fn take_up(&mut self, devices: &mut dyn Devices) -> bool {
        if self.is_armed() {
            self.plug = Plug::In;
        }
        // One that is not open yet has no key.
        if self.key().is_empty() || !matches!(self.plug, Plug::Out { .. }) {
            return false;
        }
        let Plug::Out { is_missed, before } = std::mem::replace(&mut self.plug, Plug::Back) else { return false };
        if before.key == self.key() {
            devices.ask(DeviceCommand::Factor(before.factor));
        }
        is_missed
    }

    /// Does what is asked of it.
    pub(super) fn act(&mut self, ask: DeviceAsk, devices: Option<&mut dyn Devices>) {
        let Some(devices) = devices else { return };
        match ask {
            DeviceAsk::Look => self.look(devices),
            DeviceAsk::Choose(chosen) => {
                (self.chosen, self.is_confirming) = (chosen, false);
                if matches!(self.plug, Plug::Back) {
                    self.plug = Plug::In;
                }
                devices.choose(chosen);
                devices.ask(DeviceCommand::Pause(self.is_paused));
                // Another, even where it is of the same kind.
                self.status = None;
            }
            DeviceAsk::Confirm(on) => self.is_confirming = on,
            // Files are the app's, and neither gamepads nor loudspeakers are devices.
            DeviceAsk::SaveLatency | DeviceAsk::Rumble(_) | DeviceAsk::Sound(_) => {}
            DeviceAsk::Forget => {
                let key = self.key().to_owned();
                self.known.forget(&key);
                devices.ask(DeviceCommand::Propose);
            }
            DeviceAsk::Command(command) => {
                self.is_confirming = false;
                // To stop learning maps as before, which nobody has chosen.
                if let (DeviceCommand::Map(mapping), Some(status)) = (command, &self.status)
                    && status.asks.is_none()
                {
                    self.known.remember(&status.key, status.axes.len(), mapping);
                }
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
            "# From input report to output report; Lumen {version}. Not for clinical decisions.\n\
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
    row(ui, &say!("devices-device"), &say!("devices-device-help"), |ui| {
        if ui.button(say!("devices-look-again")).on_hover_text(say!("devices-look-again-help")).clicked() {
            ask(DeviceAsk::Look);
        }
        let none = say!("devices-none");
        let chosen = device.chosen.and_then(|chosen| choices.get(chosen)).map_or(none.as_str(), String::as_str);
        let list = ComboBox::from_id_salt("device").selected_text(chosen).show_ui(ui, |ui| {
            if ui.selectable_label(device.chosen.is_none(), none.as_str()).clicked() {
                ask(DeviceAsk::Choose(None));
            }
            for (i, choice) in choices.iter().enumerate() {
                if ui.selectable_label(device.chosen == Some(i), choice).clicked() {
                    ask(DeviceAsk::Choose(Some(i)));
                }
            }
        });
        name(&list.response, Role::ComboBox, &say!("devices-device"));
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
    if matches!(device.plug, Plug::Back) {
        let again = if status.has_force { Key("devices-again-unarmed") } else { Key("devices-again") };
        remark(ui, &again.say());
    }
    axes(ui, status, device.known.has(&status.key), &mut ask);
    force(ui, device, status, &mut ask);
}

/// Where the hand on the virtual device wants it.
fn hand(ui: &mut Ui, mut wanted: [f64; 2], ask: &mut impl FnMut(DeviceAsk)) {
    let before = wanted;
    row(ui, &say!("devices-hand-at"), &say!("devices-hand-at-help"), |ui| {
        let slider = Slider::new(&mut wanted[0], -HALF_WAY[0]..=HALF_WAY[0]).suffix(" mm").fixed_decimals(1);
        let slider = slider.custom_parser(|text| parse(text, false));
        name(&ui.add(slider), Role::Slider, &say!("devices-hand-at"));
    });
    row(ui, &say!("devices-turned-to"), &say!("devices-turned-to-help"), |ui| {
        let slider = Slider::new(&mut wanted[1], -HALF_WAY[1]..=HALF_WAY[1]).suffix(" rad").fixed_decimals(2);
        let slider = slider.custom_parser(|text| parse(text, false));
        name(&ui.add(slider), Role::Slider, &say!("devices-turned-to"));
    });
    if wanted != before {
        ask(DeviceAsk::Command(DeviceCommand::Want(wanted)));
    }
}

/// The axes as they are, and what they do.
fn axes(ui: &mut Ui, status: &DeviceStatus, is_known: bool, ask: &mut impl FnMut(DeviceAsk)) {
    for axis in &status.axes {
        row(ui, &axis.name, &say!("devices-axis-help"), |ui| {
            let raw = axis.raw.map_or("-".to_owned(), |raw| raw.to_string());
            ui.add(ProgressBar::new((0.5 + 0.5 * axis.part) as f32).desired_width(120.0).text(raw));
        });
    }
    match status.asks {
        Some(Ask::Push) => remark(ui, &say!("devices-push")),
        Some(Ask::Turn) => remark(ui, &say!("devices-turn")),
        Some(Ask::Done) | None => {}
    }
    let mut mapping = status.mapping;
    mapped(ui, ["Feed", &say!("devices-feed")], "mm", &mut mapping.feed, status);
    mapped(ui, ["Roll", &say!("devices-roll")], "rad", &mut mapping.roll, status);
    if mapping != status.mapping {
        ask(DeviceAsk::Command(DeviceCommand::Map(mapping)));
    }
    ui.horizontal_wrapped(|ui| {
        let learn = Button::new(say!("devices-learn")).selected(status.asks.is_some());
        if ui.add(learn).on_hover_text(say!("devices-learn-help")).clicked() {
            let stop = DeviceCommand::Map(status.mapping);
            ask(DeviceAsk::Command(if status.asks.is_some() { stop } else { DeviceCommand::Learn }));
        }
        if is_known && ui.button(say!("devices-forget")).on_hover_text(say!("devices-forget-help")).clicked() {
            ask(DeviceAsk::Forget);
        }
        if !status.has_force && status.mapping != Mapping::default() {
            ui.label(say!("devices-no-force"));
        }
    });
}

/// Which axis, how far it moves, and whether the other way round; what it moves has a name for ids, and one for the eye.
fn mapped(ui: &mut Ui, [salt, what]: [&str; 2], unit: &str, mapping: &mut Option<AxisMapping>, status: &DeviceStatus) {
    let Some(of) = mapping else { return };
    row(ui, what, &say!("devices-mapped-help"), |ui| {
        ui.checkbox(&mut of.is_inverted, say!("devices-inverted"));
        let (value, suffix) = match &mut of.mode {
            Mode::Absolute { travel } => (travel, format!(" {unit}")),
            Mode::Relative { per_count } => (per_count, format!(" {}", say!("devices-per-count", unit = unit))),
            Mode::Rate { full } => (full, format!(" {unit}/s")),
        };
        let far = reads_comma(DragValue::new(value), false).range(0.01..=1000.0).suffix(suffix).max_decimals(2);
        let far = ui.add(far);
        name(&far, Role::SpinButton, &say!("devices-mapped-far", what = what));
        let axis = status.axes.get(of.axis).map_or("-", |axis| axis.name.as_str());
        let list = ComboBox::from_id_salt(salt).selected_text(axis).width(56.0).show_ui(ui, |ui| {
            for (i, axis) in status.axes.iter().enumerate() {
                ui.selectable_value(&mut of.axis, i, &axis.name);
            }
        });
        name(&list.response, Role::ComboBox, &say!("devices-mapped-axis", what = what));
    });
}

/// Its force: armed by the user who has read what will move, and stopped by one press.
fn force(ui: &mut Ui, device: &Device, status: &DeviceStatus, ask: &mut impl FnMut(DeviceAsk)) {
    if !status.has_force {
        return;
    }
    let mut factor = status.factor;
    row(ui, &say!("devices-felt-as"), &say!("devices-felt-as-help"), |ui| {
        let value = DragValue::new(&mut factor[0]).range(0.0..=20.0).speed(0.01).suffix(" /N").max_decimals(2);
        name(&ui.add(reads_comma(value, false)), Role::SpinButton, &say!("devices-felt-as"));
    });
    row(ui, &say!("devices-torque-as"), &say!("devices-torque-as-help"), |ui| {
        let value = DragValue::new(&mut factor[1]).range(0.0..=5.0).speed(0.001).suffix(" /N mm").max_decimals(3);
        name(&ui.add(reads_comma(value, false)), Role::SpinButton, &say!("devices-torque-as"));
    });
    if factor != status.factor {
        ask(DeviceAsk::Command(DeviceCommand::Factor(factor)));
    }
    let halt = DeviceAsk::Command(DeviceCommand::Halt(Halt::Stopped));
    if status.halted.is_none() {
        if ui.button(say!("devices-stop-force")).on_hover_text(say!("devices-stop-force-help")).clicked() {
            ask(halt);
        }
    } else if device.is_confirming {
        remark(ui, &say!("devices-force-warning"));
        ui.horizontal(|ui| {
            if ui.button(say!("devices-arm-force")).clicked() {
                ask(DeviceAsk::Command(DeviceCommand::Arm));
            }
            if ui.button(say!("devices-not-now")).clicked() {
                ask(DeviceAsk::Confirm(false));
            }
        });
    } else if ui.button(say!("devices-ask-arm-force")).on_hover_text(say!("devices-ask-arm-force-help")).clicked() {
        ask(DeviceAsk::Confirm(true));
    }
    if let Some(why) = status.halted.and_then(why) {
        remark(ui, &why.say());
    }
    if let Some(felt) = status.felt {
        // Nought has no sign.
        let [force, torque] = felt.map(|value| if value.abs() < 5e-4 { 0.0 } else { value });
        let felt = format!("{} N, {} N mm", decimal(force, 3), decimal(torque, 3));
        number(ui, &say!("devices-felt"), &felt, &say!("devices-felt-help"));
    }
    let latency = status.latency;
    if latency.count > 0 {
        let [half, most, nearly_all] = [latency.p50_ms, latency.p95_ms, latency.p99_ms].map(|ms| decimal(ms, 1));
        let times = format!("{half} / {most} / {nearly_all} ms");
        number(ui, &say!("devices-latency"), &times, &say!("devices-latency-help"));
        if ui.button(say!("devices-save-latency")).on_hover_text(say!("devices-save-latency-help")).clicked() {
            ask(DeviceAsk::SaveLatency);
        }
    }
}

/// Why its force has ended, where the user did not end it.
pub(super) fn why(halt: Halt) -> Option<Key> {
    match halt {
        Halt::NotArmed | Halt::Stopped => None,
        Halt::Hidden => Some(Key("devices-ended-hidden")),
        Halt::Unplugged => Some(Key("devices-ended-unplugged")),
        Halt::NotANumber => Some(Key("devices-ended-no-number")),
        Halt::Refused => Some(Key("devices-ended-refused")),
    }
}
