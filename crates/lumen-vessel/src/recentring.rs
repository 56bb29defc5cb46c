//! Moves stations to the middle of their cross-sections.
//!
//! A centreline is smoothed along itself, which in a bend draws it inwards, by half a millimetre in an aortic arch.
//! Where a station lies in one vessel, the centroid of its cross-section is its middle; the move is within the plane,
//! so the cross-section stays the same one. Moves are evened out over a stretch as long as the vessel is wide, in which
//! ends and forks count as not moved, so that the line has no steps.

use glam::DVec3;

use super::calibre::Calibre;
use super::stations::Stations;
use super::zones::Zone;

/// A move is at most this part of the radius.
const FARTHEST: f64 = 0.5;

/// Moves the stations that `calibres` and `zones` are of, and tells their abscissas anew.
pub(super) fn recentre(stations: &mut Stations, calibres: &[Calibre], zones: &[Zone]) {
    let all = &mut stations.all;
    for range in &stations.of {
        let moves: Vec<DVec3> = range
            .clone()
            .map(|i| match calibres[i].middle_mm {
                Some(middle) if zones[i] == Zone::Vessel => {
                    (middle - all[i].at).clamp_length_max(FARTHEST * all[i].radius_mm)
                }
                _ => DVec3::ZERO,
            })
            .collect();
        let first = range.start;
        let evened: Vec<DVec3> = range
            .clone()
            .map(|i| {
                let reach = all[i].radius_mm;
                let part = |k: &usize| (all[*k].abscissa_mm - all[i].abscissa_mm).abs() / reach.max(f64::MIN_POSITIVE);
                let before = (first..i).rev().take_while(|k| part(k) < 1.0);
                let after = (i..range.end).take_while(|k| part(k) < 1.0);
                let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
                for k in before.chain(after) {
                    let weight = 1.0 - part(&k);
                    (sum, weights) = (sum + moves[k - first] * weight, weights + weight);
                }
                // The sections beside it lie in other planes.
                let moved = sum / weights;
                moved - all[i].direction * moved.dot(all[i].direction)
            })
            .collect();
        let mut abscissa = 0.0;
        for (i, by) in range.clone().zip(evened) {
            all[i].at += by;
            if i > first {
                abscissa += all[i].at.distance(all[i - 1].at);
            }
            all[i].abscissa_mm = abscissa;
        }
    }
}
