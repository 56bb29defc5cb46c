//! What of a scan or a mask is the vessel, as the command line asks for it.

use anyhow::Result;
use clap::{Args, ValueEnum};
use glam::DVec3;

use super::misuse::misuse;
use crate::volume::Region;

/// What of a scan or a mask is the vessel.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct ScanOptions {
    /// Of a scan: make the surface where values reach this, in its own unit (Hounsfield units for CT)
    #[arg(long, value_name = "HU", allow_negative_numbers = true, conflicts_with = "label")]
    pub(super) threshold: Option<f64>,
    /// Of a mask: make the surface of this label; without it, of all that is not 0
    #[arg(long, value_name = "N")]
    pub(super) label: Option<i64>,
    /// Only what is connected to this point: x, y and z in mm in the axes of the scan; of a scan without --threshold, where it
    /// is half way between the vessel and what is around it
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = point)]
    pub(super) seed: Option<DVec3>,
    /// Of a mask: how the surface is made
    #[arg(long, value_enum, value_name = "METHOD")]
    pub(super) surface_by: Option<SurfaceMethod>,
    /// Of files that hold several volumes: this one, from 1; without it, the one of most slices
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) volume: Option<u32>,
    /// Look only at these voxels: first and last column, row and slice, from 0
    #[arg(long = "box", value_name = "I0,I1,J0,J1,K0,K1", value_parser = region)]
    pub(super) region: Option<Region>,
}

/// How the surface of a mask is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SurfaceMethod {
    /// Marching cubes: the steps of the voxels stay
    Cubes,
    /// Surface nets: relaxed within each voxel, as without --surface-by; where it is said, `lumen surface` without --label makes
    /// the borders of all labels
    Nets,
}

fn point(text: &str) -> Result<DVec3, String> {
    let along: Result<Vec<f64>, _> = text.split(',').map(|along| along.trim().parse::<f64>()).collect();
    match along.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|along| along.is_finite()) => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("{text} is not a point: x, y and z in mm")),
    }
}

fn region(text: &str) -> Result<Region, String> {
    let ends: Result<Vec<usize>, _> = text.split(',').map(|end| end.trim().parse::<usize>()).collect();
    match ends.as_deref() {
        Ok(&[i0, i1, j0, j1, k0, k1]) if i0 < i1 && j0 < j1 && k0 < k1 => {
            Ok(Region { first: [i0, j0, k0], last: [i1, j1, k1] })
        }
        _ => Err(format!("{text} is not six voxel numbers, the first of each axis below the last")),
    }
}

impl ScanOptions {
    /// Whether anything is asked for that only a volume has.
    pub(super) fn is_any(&self) -> bool {
        self.is_chosen() || self.region.is_some() || self.volume.is_some() || self.surface_by.is_some()
    }

    /// Whether a part of the volume is asked for.
    pub(super) fn has_box(&self) -> bool {
        self.region.is_some()
    }

    /// Whether they say what the surface is of.
    pub(super) fn is_chosen(&self) -> bool {
        self.threshold.is_some() || self.label.is_some() || self.seed.is_some()
    }

    /// Refuses where these options are given for what is no volume.
    pub(super) fn refuse(&self, name: &str) -> Result<()> {
        if self.is_any() {
            return Err(misuse(format!(
                "{name} is a surface: --threshold, --label, --seed, --surface-by, --volume and --box are for scans and masks"
            )));
        }
        Ok(())
    }
}
