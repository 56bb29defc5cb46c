//! An elastic rod with stretch, bending, twist and a curved rest shape: discrete elastic rods (Bergou et al., "Discrete
//! elastic rods", 2008, and "Discrete viscous threads", 2010, for the derivatives).
//!
//! Nodes have positions, the edges between them a material frame: the tangent and a director `m` across it. At an inner
//! node the discrete curvature `2 tan(turn / 2)` has a component about each director; its twist is the angle between
//! one director, carried over the bend without turning, and the other. Energies are
//!
//! ```text
//! bend   EI / 2c |kappa - rest|^2     twist   GJ / 2c tau^2     stretch   EA / 2 l (|e| / l - 1)^2
//! ```
//!
//! where the bend is the mean of what it is in the frames of the two edges, so that twist does not soften it, and `c` is
//! the length of the node's cell, which reaches half-way to its neighbours. A time step is implicit (backward Euler): it
//! is found by Newton's method with all second derivatives (`bend`), and with fewer where those are not positive definite
//! ([`Hessian`]). The matrix has a half bandwidth of 10 (`band`). The gradient is exact, so what a step comes to, and what
//! stands still, are too.
//!
//! Nodes are numbered from the tip; tangents point away from it.
//!
//! ```text
//! section --state--> frame --energy--> band <--bend     the equations of a step (step), solved in change
//! ```

mod band;
mod bend;
mod change;
mod coupling;
mod energy;
mod frame;
mod hessian;
mod section;
mod state;
mod step;

pub use change::Direction;
pub(crate) use coupling::Coupling;
pub use hessian::Hessian;
pub use section::{Fixed, Section};
pub use state::Rod;
