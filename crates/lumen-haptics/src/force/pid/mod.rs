//! USB physical interface devices (USB-IF, Device Class Definition for Physical Interface Devices 1.0): effects that the
//! device plays by itself. [`layout`] finds their reports by usages and fills them, [`driver`] says which goes when.

pub mod driver;
pub mod layout;

pub use driver::PidDriver;

#[cfg(test)]
mod tests;
