//! Contact of a rod with the wall, with Coulomb friction, and with itself, without.
//!
//! ```text
//! wall --detection--> gaps --law--> multipliers, friction --spring--> what a search direction knows of contacts
//! ```
//!
//! `detection` finds where the rod is near the wall and measures the gaps, `law` says what a contact does by its gap and
//! slip, `set` is all contacts of a rod through a step, and `spring` is a contact along a straight change of the rod, for
//! `descent`, which finds out which contacts press. `self_contact` does the same where a rod touches itself.

mod detection;
mod law;
mod self_contact;
mod set;
mod spring;

pub use law::Contact;
pub(crate) use self_contact::Link;
pub use self_contact::Pair;
pub use set::Contacts;
#[cfg(test)]
pub(super) use spring::{Open, spread};
pub(super) use spring::{Spring, Springs};
