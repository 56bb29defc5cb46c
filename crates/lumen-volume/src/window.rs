//! What a slice is shown with: the values that are black and white.

use super::survey::Survey;
use lumen_message::messages;

messages! {
    /// What a window shows.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum WindowName {
        /// Vessels with contrast, from fat to bone.
        "scan-window-vessels" Vessels => "Vessels",
        /// Soft tissue.
        "scan-window-soft" SoftTissue => "Soft tissue",
        /// Bone.
        "scan-window-bone" Bone => "Bone",
    }
}

/// A window with a name, in Hounsfield units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// What it shows.
    pub name: WindowName,
    /// The values that are black and white.
    pub ends: [f64; 2],
}

/// Windows for CT; the first is for vessels with contrast, from fat to bone, the others are radiology's usual ones (level 40
/// and width 400, level 400 and width 1800).
pub const WINDOWS: [Window; 3] = [
    Window { name: WindowName::Vessels, ends: [-150.0, 550.0] },
    Window { name: WindowName::SoftTissue, ends: [-160.0, 240.0] },
    Window { name: WindowName::Bone, ends: [-500.0, 1300.0] },
];

/// Of the values of a scan that is no CT so many are darker than black, and as many brighter than white.
const BEYOND: f64 = 0.005;

impl Survey {
    /// Where nearly all values lie: a window for what is no CT.
    pub fn bulk(&self) -> [f64; 2] {
        let [low, high] = self.range;
        let all: u64 = self.histogram.iter().sum();
        let beyond = (all as f64 * BEYOND) as u64;
        let first = |bins: &mut dyn Iterator<Item = &u64>| {
            let mut passed = 0;
            bins.take_while(|&&count| {
                passed += count;
                passed <= beyond
            })
            .count()
        };
        let width = (high - low) / self.histogram.len().max(1) as f64;
        let darker = first(&mut self.histogram.iter());
        let brighter = first(&mut self.histogram.iter().rev());
        let ends = [low + width * darker as f64, high - width * brighter as f64];
        if self.is_mask() || ends[0] >= ends[1] { self.range } else { ends }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_bright_values_leave_the_rest_its_contrast() {
        let mut histogram = vec![0; 256];
        histogram[..26].fill(1000);
        histogram[255] = 5;
        let survey = Survey { range: [0.0, 2560.0], histogram, labels: Vec::new() };
        assert_eq!(survey.bulk(), [0.0, 260.0]);
        let even = Survey { histogram: vec![1; 256], ..survey.clone() };
        assert_eq!(even.bulk(), [10.0, 2550.0]);
        let nothing = Survey { histogram: Vec::new(), ..survey };
        assert_eq!(nothing.bulk(), [0.0, 2560.0]);
    }
}
