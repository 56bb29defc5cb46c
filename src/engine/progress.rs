//! How far work is, told without piling up.

use std::collections::VecDeque;

use super::message::{Event, Work};

/// Says how far the work is; of several words in a row only the last is kept.
pub(super) fn tell_progress(work: Work, fraction: f32, events: &mut VecDeque<Event>) {
    let event = Event::Progress { work, fraction };
    match events.back_mut() {
        Some(last @ Event::Progress { .. }) => *last = event,
        _ => events.push_back(event),
    }
}
