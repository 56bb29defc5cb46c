//! The wire against what is known of rods and of wires in tubes: each benchmark beside its analytic answer, with its
//! tolerance. `cargo xtask validation` draws them into `docs/validation.md`.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod balance;
mod benchmark;
mod bend;
mod buckling;
mod dynamics;
mod elastica;
mod facets;
mod feed;
mod friction;
mod helix;
mod invariance;
mod readout;
mod refinement;
mod rods;
mod self_contact;
mod spectrum;
mod torsion;
mod tube_buckling;
