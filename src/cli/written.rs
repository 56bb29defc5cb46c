//! What of a result is written: the arrays of the file, what Lumen adds to them, and in which axes.

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};

use crate::io::{Axes, Format};
use crate::mesh::Array;
use crate::mesh::arrays::{Association, Values};
use crate::pipeline::run::Pipeline;

/// The options that say so.
#[derive(Clone, Debug, Args)]
pub(super) struct WrittenOptions {
    /// Which arrays of the file go out with the surface, where the format has a place for them
    #[arg(long, value_name = "WHICH", value_enum, default_value_t = WhichArrays::All)]
    arrays: WhichArrays,
    /// What Lumen writes at each vertex: its normal, the mean deviation around it from the smoothed surface in mm, or none
    #[arg(long, value_name = "WHAT", value_enum, value_delimiter = ',', default_value = "normals")]
    with: Vec<With>,
    /// What the written coordinates grow towards: left, posterior and superior; right, anterior and superior; or what the
    /// file has
    #[arg(long, value_name = "AXES", value_enum, default_value_t = WrittenAxes::Keep)]
    axes: WrittenAxes,
    /// What the file's coordinates grow towards, where it does not say
    #[arg(long, value_name = "AXES", value_enum)]
    axes_in: Option<FileAxes>,
    /// Write coarser levels too, with a half, a quarter and so on of the triangles, for viewers that know glTF's MSFT_lod:
    /// GLB alone
    #[arg(long)]
    levels: bool,
}

/// What the coordinates of the output grow towards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WrittenAxes {
    Lps,
    Ras,
    Keep,
}

/// What those of a file do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FileAxes {
    Lps,
    Ras,
}

impl From<FileAxes> for Axes {
    fn from(axes: FileAxes) -> Self {
        match axes {
            FileAxes::Lps => Self::Lps,
            FileAxes::Ras => Self::Ras,
        }
    }
}

/// Which arrays of the file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WhichArrays {
    All,
    None,
}

/// What is written beside the file's own arrays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum With {
    Normals,
    Deviation,
    None,
}

impl WrittenOptions {
    /// Whether the arrays of the file are carried to the result.
    pub(super) fn takes_arrays(&self) -> bool {
        self.arrays == WhichArrays::All
    }

    /// Whether coarser levels are written.
    ///
    /// # Errors
    /// Where the format has no place for them.
    pub(super) fn has_levels(&self, format: Format) -> Result<bool> {
        if self.levels && format != Format::Glb {
            bail!("coarser levels stand in GLB alone: let the output end in .glb, or leave out --levels");
        }
        Ok(self.levels)
    }

    /// Whether normals are written.
    pub(super) fn has_normals(&self) -> bool {
        self.with.contains(&With::Normals)
    }

    /// The axes of the surface, where the file itself has `stated` ones, and those that are written.
    ///
    /// # Errors
    /// Where what is said of the file is not what it says itself, and where unknown axes would have to be turned.
    pub(super) fn axes(&self, stated: Axes) -> Result<(Axes, Axes)> {
        let axes = match self.axes_in.map(Axes::from) {
            Some(said) if stated != Axes::Unknown && stated != said => {
                bail!("the file itself says that its axes are {stated}: leave out --axes-in")
            }
            Some(said) => said,
            None => stated,
        };
        let to = match self.axes {
            WrittenAxes::Lps => Axes::Lps,
            WrittenAxes::Ras => Axes::Ras,
            WrittenAxes::Keep => axes,
        };
        if axes == Axes::Unknown && to != axes {
            bail!("the file does not say which way its axes point: say it with --axes-in lps or --axes-in ras");
        }
        Ok((axes, to))
    }

    /// What is written beside the surface.
    pub(super) fn arrays(&self, pipeline: &Pipeline) -> Vec<Array> {
        let mut arrays = pipeline.level_arrays().map_or_else(Vec::new, |arrays| arrays.to_vec());
        if let (true, Some(found)) = (self.with.contains(&With::Deviation), pipeline.deviations())
            && let Some(comparison) = &found.from_smoothed
        {
            arrays.push(Array::new("deviation_mm", Association::Point, 1, Values::from_floats(&comparison.map)));
        }
        arrays
    }
}
