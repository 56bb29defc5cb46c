//! Protocol of the open guidewire feeder: its report descriptor, and HID reports framed over a serial line.
//!
//! Firmware and host share this crate. It needs nothing but `core` and allocates nothing.

#![no_std]

pub mod feeder;
pub mod framing;
