//! What became of one branch: which of its stations count, its radii on all three surfaces, and the largest change.

use super::stretch::stretches;
use super::{BranchCalibre, Change, OnSurface, Spread, StationStatus, Verdict};
use crate::calibre::Calibre;
use crate::stations::Station;
use crate::tree::Branch;
use crate::variation::{Along, variations};
use crate::width::circle;
use crate::zones::Zone;

/// A vessel is measured from so many mean edges of diameter on.
const EDGES: f64 = 2.0;
/// A cross-section of more than so many times the inscribed radius is of a cleft or of two vessels: one of a vessel would
/// be nine times as wide as high.
const FLAT: f64 = 3.0;

/// Of the branch, at its stations, by what was measured there on the surface as opened, smoothed and reduced.
pub(super) fn branch_calibre(
    branch: &Branch,
    stations: &[Station],
    zones: &[Zone],
    calibres: [&[Calibre]; 3],
    edge_mm: f64,
    tolerance_percent: f64,
) -> BranchCalibre {
    let is_ambiguous = |i: usize| {
        let Calibre { area_mm2, inscribed_mm, .. } = calibres[0][i];
        let is_flat = area_mm2.zip(inscribed_mm).is_some_and(|(area, inscribed)| circle(area) > FLAT * inscribed);
        is_flat || calibres.iter().any(|of| of[i].is_another_loop)
    };
    let standing = |i: usize| {
        let areas = calibres.map(|of| of[i].area_mm2);
        match (zones[i], areas) {
            (Zone::End, _) => StationStatus::End,
            (Zone::Fork, _) => StationStatus::Fork,
            (Zone::Vessel, _) if is_ambiguous(i) => StationStatus::Ambiguous,
            (Zone::Vessel, [Some(opened), Some(_), Some(_)]) if 2.0 * circle(opened) >= EDGES * edge_mm => {
                StationStatus::Counts
            }
            (Zone::Vessel, [Some(_), Some(_), Some(_)]) => StationStatus::Thin,
            (Zone::Vessel, _) => StationStatus::NotClosed,
        }
    };
    let standings: Vec<StationStatus> = (0..stations.len()).map(standing).collect();
    // Of a branch that is nowhere one vessel, all of it.
    let is_vessel = |standing: &StationStatus| matches!(standing, StationStatus::Counts | StationStatus::Thin);
    let has_vessel = standings.iter().any(is_vessel);
    let shown: Vec<usize> = (0..stations.len()).filter(|&i| !has_vessel || is_vessel(&standings[i])).collect();
    let stretches = calibres.map(|of| stretches(stations, of, calibres[0], &standings, edge_mm));
    let radii = |surface: usize| stretches[surface].iter().map(|stretch| stretch.map(|stretch| stretch.radius));
    let of = |surface: usize| {
        let change = |i: usize| {
            let is_counted = surface > 0 && standings[i] == StationStatus::Counts;
            let [before, after] = [0, surface].map(|surface| stretches[surface][i].filter(|_| is_counted));
            Some(100.0 * (after?.mean / before?.mean.max(f64::MIN_POSITIVE) - 1.0))
        };
        let changes: Vec<Option<f64>> = (0..stations.len()).map(change).collect();
        let all = changes.iter().enumerate().filter_map(|(i, change)| Some(((*change)?, i)));
        let most = all.reduce(|most, next| if next.0.abs() > most.0.abs() { next } else { most });
        let largest_change = most.map(|(percent, i)| Change {
            percent,
            at_mm: stations[i].at.as_vec3().to_array(),
            abscissa_mm: stations[i].abscissa_mm,
        });
        let single = |value: Option<f64>| value.map(|value| value as f32);
        OnSurface {
            radius_mm: spread(shown.iter().filter_map(|&i| Some(stretches[surface][i]?.radius))),
            inscribed_radius_mm: spread(shown.iter().filter_map(|&i| calibres[surface][i].inscribed_mm)),
            largest_change,
            areas_mm2: calibres[surface].iter().map(|found| single(found.area_mm2)).collect(),
            radii_mm: radii(surface).map(single).collect(),
            inscribed_radii_mm: calibres[surface].iter().map(|found| single(found.inscribed_mm)).collect(),
            changes_percent: changes.into_iter().map(single).collect(),
        }
    };
    let [opened, smoothed, reduced] = [0, 1, 2].map(of);
    let verdict = |of: &OnSurface| match of.largest_change {
        None => Verdict::NotMeasured,
        Some(change) if change.percent.abs() <= tolerance_percent => Verdict::Kept,
        Some(_) => Verdict::Changed,
    };
    let ends = stations.first().zip(stations.last()).map_or(0.0, |(from, to)| from.at.distance(to.at));
    let length_mm = stations.last().map_or(0.0, |station| station.abscissa_mm);
    let abscissas_mm: Vec<f32> = stations.iter().map(|station| station.abscissa_mm as f32).collect();
    let at_mm: Vec<[f32; 3]> = stations.iter().map(|station| station.at.as_vec3().to_array()).collect();
    let variations = variations(Along {
        abscissas_mm: &abscissas_mm,
        at_mm: &at_mm,
        standings: &standings,
        opened: &opened,
        reduced: &reduced,
    });
    BranchCalibre {
        number: branch.id + 1,
        name: branch.name.clone(),
        parent: branch.parent.map(|parent| parent + 1),
        length_mm,
        tortuosity: (ends > 1e-6 * length_mm).then(|| length_mm / ends),
        verdict: verdict(&reduced),
        verdict_smoothed: verdict(&smoothed),
        stations_counted: standings.iter().filter(|&&standing| standing == StationStatus::Counts).count(),
        abscissas_mm,
        at_mm,
        standings,
        opened,
        smoothed,
        reduced,
        variations,
    }
}

fn spread(values: impl Iterator<Item = f64>) -> Option<Spread> {
    let (mut count, mut sum, mut least, mut largest) = (0usize, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (count, sum, least, largest) = (count + 1, sum + value, least.min(value), largest.max(value));
    }
    (count > 0).then(|| Spread { least, mean: sum / count as f64, largest })
}
