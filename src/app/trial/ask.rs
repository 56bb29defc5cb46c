//! What passes between the trial's controls and the trial.

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Ask {
    /// Begin: with the level that is shown.
    Start,
    /// Smooth less, so that thin vessels stay open, and begin with the level that this makes.
    SmoothLess,
    /// Begin again; anew where the level or the setup have changed.
    Restart,
    /// Steer by itself, or no longer.
    Autopilot,
    /// Stand still, or go on.
    Pause,
    /// Slow motion, or no longer.
    Slow,
    /// A second back.
    StepBack,
    /// The log as files.
    Save,
    /// Replay what a chosen log holds.
    OpenLog,
    /// Compare with the surface that was not reduced.
    Compare,
    /// Compare no more.
    CancelComparison,
    /// Run the paper's tables.
    Tables,
    /// Back to the surface.
    Close,
}

/// What the next click on the vessel chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pick {
    /// Where the wire enters.
    Entry,
    /// Where it should go.
    Target,
}

/// How far a trial is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Stage {
    /// There is none.
    #[default]
    Off,
    /// The wall and the route are being found: the part that is done.
    Preparing(f32),
    /// The wire is in the vessel.
    On,
}

/// A file for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}
