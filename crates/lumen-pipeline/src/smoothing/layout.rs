//! What is laid out in strips: the surface in the order of the passes.

use glam::Vec3;

use super::gains::Mix;
use super::order::Order;
use super::stencil::Stencil;

/// What the strips are made from.
pub(super) struct Layout<'a> {
    pub(super) order: Order,
    pub(super) stencil: Stencil<'a>,
    /// Three numbers at each vertex, and the middle of them, strays not counted.
    pub(super) values: Vec<Vec3>,
    pub(super) centre: Vec3,
    /// The place of each vertex in the row of filters; empty where there is one filter.
    pub(super) mixes: Vec<Mix>,
}
