//! The guidewire trial on the samples and in tubes.

#[path = "../common/long.rs"]
mod long;
#[path = "../common/tubes.rs"]
mod tubes;

mod autopilot;
mod fuzz;
mod hold;
mod route;
mod steps;
mod wire;
