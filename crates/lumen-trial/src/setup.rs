//! What a trial is to be: the wire, where it enters, where it should go.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::placement::{PlacementError, check_load};
use super::wire::Wire;

/// Where the wire comes out of its sheath or guide catheter, which is rigid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The mouth of the guide, inside the lumen, in mm.
    pub at: [f32; 3],
    /// Where it points, of length 1.
    pub direction: [f32; 3],
}

/// What presses the wire to the wall, away from the middle of the route: how hard, and from when on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Press {
    /// On each mm outside the guide, in N; 0 for none.
    pub n_per_mm: f32,
    /// While at least this much is outside, in mm: what is pressed all along is hard to feed.
    pub from_mm: f32,
}

/// All that decides a trial beside the surface and the input.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Setup {
    /// The wire.
    pub wire: Wire,
    /// Whether the wire is to be the one that the route proposes, in place of [`Self::wire`].
    #[serde(default)]
    pub proposes_wire: bool,
    /// Where it enters; `None` for the place that the route proposes.
    pub entry: Option<Entry>,
    /// Where it should go, a point in or near the lumen, in mm; `None` for what the route proposes.
    pub target: Option<[f32; 3]>,
    /// Load on each mm of the wire outside its guide, in N: its weight, or what flowing blood does to it.
    #[serde(default)]
    pub load: [f32; 3],
    /// What presses the wire to the wall.
    #[serde(default)]
    pub press: Press,
    /// Wires that go in one after another, where those before have failed; see [`Trial`](super::session::Trial).
    #[serde(default)]
    pub next_wires: Vec<Wire>,
    /// Varies the entry by 0.5 mm and 2 degrees, the roll, and friction by 20 %. 0 varies nothing.
    pub seed: u64,
}

impl Setup {
    /// A wire by its number: 0 for the one that goes in first, then [`Self::next_wires`].
    pub fn nth_wire(&self, number: usize) -> Option<&Wire> {
        number.checked_sub(1).map_or(Some(&self.wire), |i| self.next_wires.get(i))
    }

    /// Checks the loads on the wire.
    ///
    /// # Errors
    /// When one is more than a wire can bear, less than none, or no number.
    pub fn check_loads(&self) -> Result<(), PlacementError> {
        check_load(DVec3::from(self.load.map(f64::from)).length())?;
        check_load(f64::from(self.press.n_per_mm))
    }
}

/// What the operator does during a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// Speed of the feed in mm/s; negative withdraws. Up to 50 either way.
    pub feed: f32,
    /// Speed of the roll in rad/s, right-handed about the way in. Up to two turns a second.
    pub roll: f32,
}

/// Input, and the wire that it is for, from a step on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// The first step.
    pub step: u64,
    /// The input.
    pub input: Input,
    /// The wire's number: see [`Setup::nth_wire`].
    pub wire: usize,
}

impl Input {
    /// The fastest feed in mm/s.
    pub const MAX_FEED: f32 = 50.0;
    /// The fastest roll in rad/s: two turns a second.
    pub const MAX_ROLL: f32 = 4.0 * std::f32::consts::PI;

    /// The input within what is allowed; what is no number is 0, and nought has no sign.
    #[must_use]
    pub fn limited(self) -> Self {
        let within = |x: f32, most: f32| if x.is_finite() { x.clamp(-most, most) + 0.0 } else { 0.0 };
        Self { feed: within(self.feed, Self::MAX_FEED), roll: within(self.roll, Self::MAX_ROLL) }
    }
}
