//! Usages: what a field or a collection is, as the HID Usage Tables number them (USB-IF, HUT 1.5).
//!
//! The few that Lumen acts on are written here; the crate `hut` names them all, at the cost of tables that would go into the
//! browser's download, and checks these in a test.

use std::fmt;

/// A usage: page and number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Usage(u32);

impl Usage {
    /// Of a page and a number in it.
    pub const fn new(page: u16, id: u16) -> Self {
        Self((page as u32) << 16 | id as u32)
    }

    /// From page and number in one, as descriptors and browsers write it.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Page and number in one.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// The page.
    pub const fn page(self) -> u16 {
        (self.0 >> 16) as u16
    }

    /// The number in its page.
    pub const fn id(self) -> u16 {
        self.0 as u16
    }
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}:{:04X}", self.page(), self.id())
    }
}

/// Pages.
pub mod page {
    /// Joysticks, axes, dials.
    pub const GENERIC_DESKTOP: u16 = 0x01;
    /// Steering wheels, pedals.
    pub const SIMULATION: u16 = 0x02;
    /// Buttons by number.
    pub const BUTTON: u16 = 0x09;
    /// Ordinals: the first, the second.
    pub const ORDINAL: u16 = 0x0A;
    /// Jog and shuttle, among much else.
    pub const CONSUMER: u16 = 0x0C;
    /// Force feedback.
    pub const PHYSICAL_INTERFACE: u16 = 0x0F;
    /// The first of those that every vendor fills as it likes.
    pub const VENDOR: u16 = 0xFF00;
}

/// Generic desktop.
pub mod desktop {
    use super::{Usage, page::GENERIC_DESKTOP};

    const fn usage(id: u16) -> Usage {
        Usage::new(GENERIC_DESKTOP, id)
    }

    /// A joystick, or a wheel.
    pub const JOYSTICK: Usage = usage(0x04);
    /// A mouse with six axes.
    pub const MULTI_AXIS_CONTROLLER: Usage = usage(0x08);
    /// A dial that lies on the desk.
    pub const SYSTEM_MULTI_AXIS_CONTROLLER: Usage = usage(0x0E);
    /// Along x.
    pub const X: Usage = usage(0x30);
    /// Along y.
    pub const Y: Usage = usage(0x31);
    /// Along z.
    pub const Z: Usage = usage(0x32);
    /// About x.
    pub const RX: Usage = usage(0x33);
    /// About y.
    pub const RY: Usage = usage(0x34);
    /// About z.
    pub const RZ: Usage = usage(0x35);
    /// A slider.
    pub const SLIDER: Usage = usage(0x36);
    /// A dial.
    pub const DIAL: Usage = usage(0x37);
    /// A mouse wheel.
    pub const WHEEL: Usage = usage(0x38);
    /// A switch of eight directions.
    pub const HAT_SWITCH: Usage = usage(0x39);
}

/// Simulation controls.
pub mod simulation {
    use super::{Usage, page::SIMULATION};

    /// The first that is an axis: flight control stick's aileron.
    pub const FIRST_AXIS: Usage = Usage::new(SIMULATION, 0xB0);
    /// The last that is an axis: front brake.
    pub const LAST_AXIS: Usage = Usage::new(SIMULATION, 0xD0);
    /// A steering wheel.
    pub const STEERING: Usage = Usage::new(SIMULATION, 0xC8);
}

/// Physical interface devices (USB-IF, Device Class Definition for Physical Interface Devices 1.0).
pub mod pid {
    use super::{Usage, page::PHYSICAL_INTERFACE};

    const fn usage(id: u16) -> Usage {
        Usage::new(PHYSICAL_INTERFACE, id)
    }

    /// Collection: what an effect is, how long, along which axes.
    pub const SET_EFFECT_REPORT: Usage = usage(0x21);
    /// Which effect.
    pub const EFFECT_BLOCK_INDEX: Usage = usage(0x22);
    /// Which axis's condition.
    pub const PARAMETER_BLOCK_OFFSET: Usage = usage(0x23);
    /// Collection: the types that there are.
    pub const EFFECT_TYPE: Usage = usage(0x25);
    /// A force that stays.
    pub const ET_CONSTANT_FORCE: Usage = usage(0x26);
    /// A force by the distance from a centre.
    pub const ET_SPRING: Usage = usage(0x40);
    /// A force by the speed.
    pub const ET_DAMPER: Usage = usage(0x41);
    /// In ms, 0 or all ones for ever.
    pub const DURATION: Usage = usage(0x50);
    /// In ms.
    pub const SAMPLE_PERIOD: Usage = usage(0x51);
    /// Of one effect.
    pub const GAIN: Usage = usage(0x52);
    /// The button that starts it, none where it is null.
    pub const TRIGGER_BUTTON: Usage = usage(0x53);
    /// In ms.
    pub const TRIGGER_REPEAT_INTERVAL: Usage = usage(0x54);
    /// Collection: which axes an effect is on.
    pub const AXES_ENABLE: Usage = usage(0x55);
    /// Whether a direction counts, not the axes.
    pub const DIRECTION_ENABLE: Usage = usage(0x56);
    /// Collection: angles.
    pub const DIRECTION: Usage = usage(0x57);
    /// Collection: where parameters lie in the device's memory.
    pub const TYPE_SPECIFIC_BLOCK_OFFSET: Usage = usage(0x58);
    /// Collection: a spring's, a damper's parameters along one axis.
    pub const SET_CONDITION_REPORT: Usage = usage(0x5F);
    /// The spring's centre.
    pub const CP_OFFSET: Usage = usage(0x60);
    /// Force by distance, above the centre.
    pub const POSITIVE_COEFFICIENT: Usage = usage(0x61);
    /// Force by distance, below the centre.
    pub const NEGATIVE_COEFFICIENT: Usage = usage(0x62);
    /// The most force above the centre.
    pub const POSITIVE_SATURATION: Usage = usage(0x63);
    /// The most force below the centre.
    pub const NEGATIVE_SATURATION: Usage = usage(0x64);
    /// Where there is no force.
    pub const DEAD_BAND: Usage = usage(0x65);
    /// A constant force's or a wave's.
    pub const MAGNITUDE: Usage = usage(0x70);
    /// Collection: a constant force.
    pub const SET_CONSTANT_FORCE_REPORT: Usage = usage(0x73);
    /// Collection: start and stop.
    pub const EFFECT_OPERATION_REPORT: Usage = usage(0x77);
    /// Collection: which operation.
    pub const EFFECT_OPERATION: Usage = usage(0x78);
    /// Start beside others.
    pub const OP_EFFECT_START: Usage = usage(0x79);
    /// Start alone.
    pub const OP_EFFECT_START_SOLO: Usage = usage(0x7A);
    /// Stop.
    pub const OP_EFFECT_STOP: Usage = usage(0x7B);
    /// How often.
    pub const LOOP_COUNT: Usage = usage(0x7C);
    /// Collection: the gain of all.
    pub const DEVICE_GAIN_REPORT: Usage = usage(0x7D);
    /// The gain of all.
    pub const DEVICE_GAIN: Usage = usage(0x7E);
    /// Collection: what memory there is.
    pub const POOL_REPORT: Usage = usage(0x7F);
    /// Whether the device sees to its memory itself.
    pub const DEVICE_MANAGED_POOL: Usage = usage(0xA9);
    /// Collection: what became of a new effect.
    pub const BLOCK_LOAD_REPORT: Usage = usage(0x89);
    /// Collection: whether there is room.
    pub const BLOCK_LOAD_STATUS: Usage = usage(0x8B);
    /// There was.
    pub const BLOCK_LOAD_SUCCESS: Usage = usage(0x8C);
    /// There was none.
    pub const BLOCK_LOAD_FULL: Usage = usage(0x8D);
    /// It failed otherwise.
    pub const BLOCK_LOAD_ERROR: Usage = usage(0x8E);
    /// Collection: an effect is no longer needed.
    pub const BLOCK_FREE_REPORT: Usage = usage(0x90);
    /// Collection: the device's own word on its state.
    pub const STATE_REPORT: Usage = usage(0x92);
    /// Collection: on, off, stop, reset.
    pub const DEVICE_CONTROL: Usage = usage(0x96);
    /// Actuators on.
    pub const DC_ENABLE_ACTUATORS: Usage = usage(0x97);
    /// Actuators off.
    pub const DC_DISABLE_ACTUATORS: Usage = usage(0x98);
    /// All effects end.
    pub const DC_STOP_ALL_EFFECTS: Usage = usage(0x99);
    /// All effects are forgotten.
    pub const DC_DEVICE_RESET: Usage = usage(0x9A);
    /// Effects stand still.
    pub const DC_DEVICE_PAUSE: Usage = usage(0x9B);
    /// Effects go on.
    pub const DC_DEVICE_CONTINUE: Usage = usage(0x9C);
    /// Whether actuators are on.
    pub const ACTUATORS_ENABLED: Usage = usage(0xA0);
    /// How long after its start an effect begins, in ms.
    pub const START_DELAY: Usage = usage(0xA7);
    /// Collection: a new effect is asked for.
    pub const CREATE_NEW_EFFECT_REPORT: Usage = usage(0xAB);
}

#[cfg(test)]
mod tests {
    use hut::{AsUsage, GenericDesktop, PhysicalInputDevice as Pid, SimulationControls};

    use super::*;

    #[test]
    fn usages_are_those_of_the_published_tables() {
        let known = [
            (desktop::JOYSTICK, GenericDesktop::Joystick.usage_value()),
            (desktop::MULTI_AXIS_CONTROLLER, GenericDesktop::MultiaxisController.usage_value()),
            (desktop::SYSTEM_MULTI_AXIS_CONTROLLER, GenericDesktop::SystemMultiAxisController.usage_value()),
            (desktop::X, GenericDesktop::X.usage_value()),
            (desktop::RX, GenericDesktop::Rx.usage_value()),
            (desktop::RZ, GenericDesktop::Rz.usage_value()),
            (desktop::SLIDER, GenericDesktop::Slider.usage_value()),
            (desktop::DIAL, GenericDesktop::Dial.usage_value()),
            (desktop::WHEEL, GenericDesktop::Wheel.usage_value()),
            (desktop::HAT_SWITCH, GenericDesktop::HatSwitch.usage_value()),
            (simulation::STEERING, SimulationControls::Steering.usage_value()),
            (pid::SET_EFFECT_REPORT, Pid::SetEffectReport.usage_value()),
            (pid::EFFECT_BLOCK_INDEX, Pid::EffectParameterBlockIndex.usage_value()),
            (pid::PARAMETER_BLOCK_OFFSET, Pid::ParameterBlockOffset.usage_value()),
            (pid::EFFECT_TYPE, Pid::EffectType.usage_value()),
            (pid::ET_CONSTANT_FORCE, Pid::ETConstantForce.usage_value()),
            (pid::ET_SPRING, Pid::ETSpring.usage_value()),
            (pid::ET_DAMPER, Pid::ETDamper.usage_value()),
            (pid::DURATION, Pid::Duration.usage_value()),
            (pid::SAMPLE_PERIOD, Pid::SamplePeriod.usage_value()),
            (pid::GAIN, Pid::Gain.usage_value()),
            (pid::TRIGGER_BUTTON, Pid::TriggerButton.usage_value()),
            (pid::TRIGGER_REPEAT_INTERVAL, Pid::TriggerRepeatInterval.usage_value()),
            (pid::AXES_ENABLE, Pid::AxesEnable.usage_value()),
            (pid::DIRECTION_ENABLE, Pid::DirectionEnable.usage_value()),
            (pid::DIRECTION, Pid::Direction.usage_value()),
            (pid::TYPE_SPECIFIC_BLOCK_OFFSET, Pid::TypeSpecificBlockOffset.usage_value()),
            (pid::SET_CONDITION_REPORT, Pid::SetConditionReport.usage_value()),
            (pid::CP_OFFSET, Pid::CenterPointOffset.usage_value()),
            (pid::POSITIVE_COEFFICIENT, Pid::PositiveCoefficient.usage_value()),
            (pid::NEGATIVE_COEFFICIENT, Pid::NegativeCoefficient.usage_value()),
            (pid::POSITIVE_SATURATION, Pid::PositiveSaturation.usage_value()),
            (pid::NEGATIVE_SATURATION, Pid::NegativeSaturation.usage_value()),
            (pid::DEAD_BAND, Pid::DeadBand.usage_value()),
            (pid::MAGNITUDE, Pid::Magnitude.usage_value()),
            (pid::SET_CONSTANT_FORCE_REPORT, Pid::SetConstantForceReport.usage_value()),
            (pid::EFFECT_OPERATION_REPORT, Pid::EffectOperationReport.usage_value()),
            (pid::EFFECT_OPERATION, Pid::EffectOperation.usage_value()),
            (pid::OP_EFFECT_START, Pid::OpEffectStart.usage_value()),
            (pid::OP_EFFECT_START_SOLO, Pid::OpEffectStartSolo.usage_value()),
            (pid::OP_EFFECT_STOP, Pid::OpEffectStop.usage_value()),
            (pid::LOOP_COUNT, Pid::LoopCount.usage_value()),
            (pid::DEVICE_GAIN_REPORT, Pid::DeviceGainReport.usage_value()),
            (pid::DEVICE_GAIN, Pid::DeviceGain.usage_value()),
            (pid::POOL_REPORT, Pid::ParameterBlockPoolsReport.usage_value()),
            (pid::DEVICE_MANAGED_POOL, Pid::DeviceManagedPool.usage_value()),
            (pid::BLOCK_LOAD_REPORT, Pid::EffectParameterBlockLoadReport.usage_value()),
            (pid::BLOCK_LOAD_STATUS, Pid::EffectParameterBlockLoadStatus.usage_value()),
            (pid::BLOCK_LOAD_SUCCESS, Pid::BlockLoadSuccess.usage_value()),
            (pid::BLOCK_LOAD_FULL, Pid::BlockLoadFull.usage_value()),
            (pid::BLOCK_LOAD_ERROR, Pid::BlockLoadError.usage_value()),
            (pid::BLOCK_FREE_REPORT, Pid::EffectParameterBlockFreeReport.usage_value()),
            (pid::STATE_REPORT, Pid::PIDStateReport.usage_value()),
            (pid::DEVICE_CONTROL, Pid::PIDDeviceControl.usage_value()),
            (pid::DC_ENABLE_ACTUATORS, Pid::DCEnableActuators.usage_value()),
            (pid::DC_DISABLE_ACTUATORS, Pid::DCDisableActuators.usage_value()),
            (pid::DC_STOP_ALL_EFFECTS, Pid::DCStopAllEffects.usage_value()),
            (pid::DC_DEVICE_RESET, Pid::DCReset.usage_value()),
            (pid::DC_DEVICE_PAUSE, Pid::DCPause.usage_value()),
            (pid::DC_DEVICE_CONTINUE, Pid::DCContinue.usage_value()),
            (pid::ACTUATORS_ENABLED, Pid::ActuatorsEnabled.usage_value()),
            (pid::START_DELAY, Pid::StartDelay.usage_value()),
            (pid::CREATE_NEW_EFFECT_REPORT, Pid::CreateNewEffectParameterBlockReport.usage_value()),
        ];
        for (ours, theirs) in known {
            assert_eq!(ours.bits(), theirs);
        }
    }
}
