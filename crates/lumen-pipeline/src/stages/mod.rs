//! What each stage does, a file each: from the slots that it rests on to its own.

mod bound;
mod calibre;
mod carry;
mod connectivity;
mod decimation;
mod deviation;
mod faults;
mod level;
mod measures;
mod mending;
mod running;
mod safe;
mod smoothing;

use super::stage::Stage;
use super::store::Store;
pub(super) use running::Run;

/// Starts a stage on what it rests on; `None` while that is not there.
pub(super) fn start(stage: Stage, store: &Store) -> Option<Box<dyn Run>> {
    Some(match stage {
        Stage::Mending => Box::new(mending::Mending::start(store)),
        Stage::Connectivity => Box::new(connectivity::Connecting::start(store)?),
        Stage::Smoothing => Box::new(smoothing::Filtering::start(store)?),
        Stage::Decimation => Box::new(decimation::Decimating::start(store)?),
        Stage::Bound => Box::new(bound::Bounding::start(store)?),
        Stage::Level => Box::new(level::Taking::start(store)?),
        Stage::Deviation => Box::new(deviation::Deviating::start(store)?),
        Stage::Arrays => Box::new(carry::Carrying::start(store)?),
        Stage::SmoothedMeasures => Box::new(measures::OfSmoothed::start(store)?),
        Stage::Measures => Box::new(measures::OfLevel::start(store)?),
        Stage::Faults => Box::new(faults::Looking::start(store)),
        Stage::Vessels => Box::new(calibre::Finding::start(store)?),
        Stage::Certificate => Box::new(calibre::Certifying::start(store)?),
        Stage::Safe => Box::new(safe::Searching::start(store)?),
    })
}
