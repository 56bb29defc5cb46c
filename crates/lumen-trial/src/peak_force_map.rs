//! The largest force that each place of the wall has felt, by every step that was balanced.
//!
//! Frames come less often than steps, and where drawing is slow or the window is hidden most of them are never looked
//! at: a force of a tenth of a second would be in the summary and nowhere on the vessel. So what a place feels more than
//! before is told apart from the frames, once. A place is as large as the spots that show it are at full colour, so that a
//! wire which slides over fine triangles has little to tell; of two triangles that meet in one it tells the larger force.

use std::collections::{BTreeMap, HashMap};

use super::frame::Touch;

/// The side of a place in mm.
const PLACE: f32 = 1.0;

/// Peak forces, place by place.
#[derive(Clone, Debug, Default)]
pub struct PeakForceMap {
    /// Each with its largest force so far.
    peaks: HashMap<[i32; 3], Touch>,
    /// What of that was not told yet.
    news: BTreeMap<[i32; 3], Touch>,
}

impl PeakForceMap {
    /// Takes what the wall feels in a step.
    pub fn take(&mut self, touches: impl Iterator<Item = Touch>) {
        for touch in touches {
            let place = touch.at.map(|x| (x / PLACE).floor() as i32);
            if self.peaks.get(&place).is_none_or(|peak| touch.force > peak.force) {
                self.peaks.insert(place, touch);
                self.news.insert(place, touch);
            }
        }
    }

    /// The largest force of each place, in the order of places.
    pub fn peaks(&self) -> Vec<Touch> {
        let places: BTreeMap<_, _> = self.peaks.iter().collect();
        places.into_values().copied().collect()
    }

    /// Tells all of it anew, as to someone who has heard nothing.
    pub fn tell_again(&mut self) {
        self.news = self.peaks.iter().map(|(&place, &touch)| (place, touch)).collect();
    }

    /// The places that have felt more since this was asked for last, each with its largest force and where that was.
    pub fn news(&mut self) -> Vec<Touch> {
        std::mem::take(&mut self.news).into_values().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(x: f32, force: f32) -> Touch {
        Touch { at: [x, -0.5, 0.0], triangle: 3, force }
    }

    #[test]
    fn each_place_tells_its_largest_force_once() {
        let mut felt = PeakForceMap::default();
        assert!(felt.news().is_empty());
        // A peak between two frames, beside another place.
        for touches in [[touch(0.1, 0.01), touch(5.0, 0.2)], [touch(0.9, 0.04), touch(5.0, 0.1)], [touch(0.2, 0.0); 2]]
        {
            felt.take(touches.into_iter());
        }
        assert_eq!(felt.news(), [touch(0.9, 0.04), touch(5.0, 0.2)]);
        felt.take([touch(0.1, 0.04), touch(-0.1, 0.03)].into_iter());
        assert_eq!(felt.news(), [touch(-0.1, 0.03)], "what is no more than before is no news");
        felt.tell_again();
        assert_eq!(felt.news(), [touch(-0.1, 0.03), touch(0.9, 0.04), touch(5.0, 0.2)]);
        assert!(felt.news().is_empty());
    }
}
