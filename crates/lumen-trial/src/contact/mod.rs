//! Contact of a rod with the wall, with Coulomb friction.
//!
//! ```text
//! wall --detection--> gaps --law--> multipliers, friction --spring--> what a search direction knows of contacts
//! ```
//!
//! `detection` finds where the rod is near the wall and measures the gaps, `law` says what a contact does by its gap and
//! slip, `set` is all contacts of a rod through a step, and `spring` is a contact along a straight change of the rod, for
//! `descent`, which finds out which contacts press.

mod detection;
mod law;
mod set;
mod spring;

pub use law::Contact;
pub use set::Contacts;
#[cfg(test)]
pub(super) use spring::{Open, spread};
pub(super) use spring::{Spring, Springs};
