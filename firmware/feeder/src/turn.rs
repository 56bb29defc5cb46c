//! Whose turn it is to talk: two lines reach the device, and one host at a time drives it. The other is heard once the first
//! has been silent for [`WATCHDOG_MS`], when nothing that it told pushes any more, or has left.

use crate::feeder::WATCHDOG_MS;

/// A way to the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// USB's human interface.
    Hid,
    /// A serial port over USB.
    Serial,
}

/// What comes of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// It is taken.
    Taken,
    /// It is taken, and another line had the turn before.
    FromAnother,
    /// It is another's turn.
    Refused,
}

impl Heard {
    /// Whether it is taken.
    pub fn is_taken(self) -> bool {
        self != Self::Refused
    }

    /// Whether another had the turn before.
    pub fn is_another(self) -> bool {
        self == Self::FromAnother
    }
}

/// Whose turn it is.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Who has talked last.
    line: Option<Line>,
    silent_ms: u32,
}

impl Default for Turn {
    fn default() -> Self {
        Self::new()
    }
}

impl Turn {
    /// Nobody's.
    pub const fn new() -> Self {
        Self { line: None, silent_ms: 0 }
    }

    /// Lets a ms pass.
    pub fn advance(&mut self) {
        self.silent_ms = self.silent_ms.saturating_add(1);
    }

    /// Whether `line` has talked last.
    pub fn is_of(&self, line: Line) -> bool {
        self.line == Some(line)
    }

    /// `line` talks.
    pub fn take(&mut self, line: Line) -> Heard {
        let heard = match self.line {
            Some(other) if other != line && self.silent_ms < WATCHDOG_MS => return Heard::Refused,
            Some(other) if other != line => Heard::FromAnother,
            _ => Heard::Taken,
        };
        *self = Self { line: Some(line), silent_ms: 0 };
        heard
    }
}
