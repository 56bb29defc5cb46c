//! How much of a vessel tree is measured: what a verdict on its calibre rests on.
//!
//! A station stands for the part of the centreline that is nearer to it than to its neighbours. Coverage is the length that
//! the stations that count stand for, over the length of all branches. What lies at ends and forks is in the whole, though
//! no cross-section there is that of one vessel: a change there is not seen either.

use serde::{Deserialize, Serialize};

use super::{BranchCalibre, Certificate, StationStatus, Verdict};

/// The least part of the length away from forks, in percent, that has to be measured for a verdict to speak for the whole
/// surface. So has half of the vessels to be, by number. Below that the vessels are kept where they are measured, and of the
/// surface nothing is said.
///
/// Forks are left out of this part and of no other number: no cross-section there is that of one vessel, whatever the surface,
/// and a tree of short branches is mostly forks.
pub const ENOUGH_PERCENT: f64 = 75.0;

/// How much of some branches is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// Length of all centrelines, in mm.
    pub length_mm: f64,
    /// The part of it that is measured.
    pub measured_mm: f64,
    /// The part at ends.
    pub ends_mm: f64,
    /// The part at forks.
    pub forks_mm: f64,
    /// The part where the vessel is less than two mean edges wide.
    pub thin_mm: f64,
    /// The part where a cross-section does not close, or has more than one outline.
    pub unclear_mm: f64,
    /// Branches.
    pub vessels: usize,
    /// Those that are measured somewhere.
    pub vessels_measured: usize,
}

impl Coverage {
    /// Of these branches.
    pub fn of(branches: &[BranchCalibre]) -> Self {
        let mut found = Self { vessels: branches.len(), ..Self::default() };
        for branch in branches {
            found.vessels_measured += usize::from(branch.verdict != Verdict::NotMeasured);
            for (i, standing) in branch.standings.iter().enumerate() {
                let length = branch.length_at(i);
                found.length_mm += length;
                *found.part(*standing) += length;
            }
        }
        found
    }

    /// The same, with nothing of this branch among what is measured.
    #[must_use]
    pub fn without(mut self, branch: &BranchCalibre) -> Self {
        self.vessels_measured -= usize::from(branch.verdict != Verdict::NotMeasured);
        for (i, standing) in branch.standings.iter().enumerate() {
            if *standing == StationStatus::Counts {
                self.measured_mm -= branch.length_at(i);
            }
        }
        self
    }

    fn part(&mut self, standing: StationStatus) -> &mut f64 {
        match standing {
            StationStatus::Counts => &mut self.measured_mm,
            StationStatus::End => &mut self.ends_mm,
            StationStatus::Fork => &mut self.forks_mm,
            StationStatus::Thin => &mut self.thin_mm,
            StationStatus::NotClosed | StationStatus::Ambiguous => &mut self.unclear_mm,
        }
    }

    /// The part of the length that is measured, in percent; 0 where there is no length.
    pub fn percent(&self) -> f64 {
        self.percent_of(self.measured_mm)
    }

    /// A part of the length in percent; 0 where there is no length.
    pub fn percent_of(&self, part_mm: f64) -> f64 {
        if self.length_mm > 0.0 { 100.0 * part_mm / self.length_mm } else { 0.0 }
    }

    /// Whether so much is measured that a verdict speaks for the whole surface.
    pub fn is_enough(&self) -> bool {
        let away_from_forks = self.length_mm - self.forks_mm;
        self.measured_mm > 0.0
            && self.measured_mm >= ENOUGH_PERCENT / 100.0 * away_from_forks
            && 2 * self.vessels_measured >= self.vessels
    }
}

impl BranchCalibre {
    /// How much of it is measured.
    pub fn coverage(&self) -> Coverage {
        Coverage::of(std::slice::from_ref(self))
    }

    /// Length of the centreline that station `i` stands for, in mm.
    fn length_at(&self, i: usize) -> f64 {
        let at = |k: usize| self.abscissas_mm.get(k).copied().map(f64::from);
        let Some(own) = at(i) else { return 0.0 };
        let before = i.checked_sub(1).and_then(at).unwrap_or(own);
        (at(i + 1).unwrap_or(own) - before) / 2.0
    }

    /// The station in the middle of the longest stretch that is not measured; `None` where all is.
    pub fn unmeasured(&self) -> Option<usize> {
        let is_counted = |i: &usize| self.standings[*i] == StationStatus::Counts;
        let stations: Vec<usize> = (0..self.standings.len()).collect();
        let stretches = stations.chunk_by(|a, b| is_counted(a) == is_counted(b)).filter(|run| !is_counted(&run[0]));
        let length = |run: &[usize]| run.iter().map(|&i| self.length_at(i)).sum::<f64>();
        let longest = stretches.reduce(|longest, next| if length(next) > length(longest) { next } else { longest })?;
        Some(longest[longest.len() / 2])
    }
}

impl Certificate {
    /// The branch that most has to be said of that is not measured, and the station in the middle of what is not: the longest
    /// that is measured nowhere, else the one with the greatest length that is not.
    pub fn least_measured(&self) -> Option<(&BranchCalibre, usize)> {
        let weight = |branch: &BranchCalibre| {
            let found = branch.coverage();
            (branch.verdict == Verdict::NotMeasured, found.length_mm - found.measured_mm)
        };
        let mut most: Option<(&BranchCalibre, usize)> = None;
        for branch in &self.branches {
            let Some(station) = branch.unmeasured() else { continue };
            if most.is_none_or(|(other, _)| weight(branch) > weight(other)) {
                most = Some((branch, station));
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::fixtures::branch;

    /// A branch with stations at these arc lengths.
    fn with(number: u32, stations: &[(f32, StationStatus)]) -> BranchCalibre {
        let is_measured = stations.iter().any(|station| station.1 == StationStatus::Counts);
        BranchCalibre {
            abscissas_mm: stations.iter().map(|station| station.0).collect(),
            standings: stations.iter().map(|station| station.1).collect(),
            ..branch(number, is_measured.then_some(0.0))
        }
    }

    #[test]
    fn a_station_stands_for_half_of_the_way_to_its_neighbours() {
        use StationStatus::{Ambiguous, Counts, End, Fork, NotClosed, Thin};
        // 0.5 + 1.5 + 3 + 5 = 10 mm, then 4 + 3 + 1 = 8 mm.
        let one = with(1, &[(0.0, End), (1.0, Counts), (3.0, Counts), (7.0, Fork), (10.0, Counts)]);
        let other = with(2, &[(0.0, Thin), (8.0, NotClosed), (10.0, Ambiguous)]);
        let found = Coverage::of(&[one.clone(), other.clone()]);
        let lengths = [found.length_mm, found.ends_mm, found.forks_mm, found.thin_mm, found.unclear_mm];
        assert_eq!(lengths, [20.0, 0.5, 3.5, 4.0, 6.0]);
        assert_eq!((found.measured_mm, found.percent(), found.is_enough()), (6.0, 30.0, false));
        assert_eq!((found.vessels, found.vessels_measured), (2, 1));
        assert_eq!((one.unmeasured(), other.unmeasured()), (Some(3), Some(1)));
        let certificate = Certificate::new(vec![one.clone(), other], 2.0, 0);
        let (worst, station) = certificate.least_measured().unwrap();
        assert_eq!((worst.number, station), (2, 1), "what is measured nowhere comes first");
        assert_eq!(Certificate::new(vec![one], 2.0, 0).least_measured().unwrap().1, 3);
    }

    #[test]
    fn three_quarters_away_from_forks_of_half_of_the_vessels_are_enough() {
        use StationStatus::{Counts, Fork, Thin};
        let measured = |to: f32, rest| with(1, &[(0.0, Counts), (to, Counts), (100.0, rest)]);
        let [enough, less] = [50.0, 49.0].map(|to| measured(to, Thin).coverage());
        assert_eq!((enough.percent(), enough.is_enough()), (75.0, true));
        assert_eq!((less.percent(), less.is_enough()), (74.5, false));
        assert_eq!(less.text().to_string(), "74 % of the length, 1 of 1 vessel", "never more than it is");
        assert!(measured(10.0, Fork).coverage().is_enough(), "forks are left out");
        // Of vessels that are nowhere measured no more than there are others, however short they are.
        let short = || with(2, &[(0.0, Fork), (1.0, Fork)]);
        assert!(Coverage::of(&[measured(90.0, Thin), short()]).is_enough());
        assert!(!Coverage::of(&[measured(90.0, Thin), short(), short()]).is_enough());
        // What has no length is measured nowhere.
        let place = with(1, &[(0.0, Counts)]).coverage();
        assert_eq!((place.percent(), place.is_enough(), Coverage::default().is_enough()), (0.0, false, false));
    }
}
