//! What a device is known by.

/// A device's numbers and its name, as the system has them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Identity {
    /// Its vendor's.
    pub vendor: u16,
    /// Its own.
    pub product: u16,
    /// What it calls itself.
    pub name: String,
}
