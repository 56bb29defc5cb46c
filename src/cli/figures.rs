//! `lumen figures`: Figures 6 and 7 of the paper, made again for any surface and drawn without a window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::Args;

use super::places::write_whole;
use super::rows::row;
use super::running::advance;
use super::source::{self, UNIT_HELP, UnitOption};
use crate::app::compare::figure::{Figure, Studio};
use crate::app::compare::{Arrangement, Made};
use crate::phantom::Sample;
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::paper;
use crate::pipeline::report::{DISCLAIMER, Report};
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::{Keep, Settings};
use crate::render::Picture;

/// Draws Figures 6 and 7 of the paper.
#[derive(Debug, Args)]
pub struct Figures {
    /// A surface file, or sample:aorta, sample:coronary
    #[arg(default_value = "sample:aorta")]
    file: String,
    /// The folder to write to, made where it is missing: figure-6.png and figure-7.png
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Width of a figure in pixels, 600 to 8000; text and lines grow with it
    #[arg(long, value_name = "PIXELS", default_value_t = 2400, value_parser = clap::value_parser!(u32).range(600..=8000))]
    width: u32,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
}

impl Figures {
    /// Runs the pipeline at the settings of each figure, draws it and writes it.
    pub(super) fn run(&self) -> Result<()> {
        // Before the work: where nothing can be drawn it would be in vain.
        let studio = Studio::open()?;
        let imported = source::read(&self.file, self.unit)?;
        std::fs::create_dir_all(&self.output).with_context(|| format!("cannot make {}", self.output.display()))?;
        let (name, axes) = (shown_name(&self.file), imported.report.axes);
        let settings = paper::reduced(0, Keep::Largest);
        let mut pipeline = Pipeline::new(Arc::new(imported.mesh), settings).with_samples(REPORT_SAMPLES);
        let figures = [
            // The last of these is smoothed as those of Figure 7 are.
            (
                "figure-6.png",
                "Figure 6. Effect of pass band and iterations",
                paper::figure_6(Keep::Largest),
                Arrangement::Shaded,
            ),
            (
                "figure-7.png",
                "Figure 7. Effect of the reduction rate",
                paper::figure_7(Keep::Largest),
                Arrangement::Stacked,
            ),
        ];
        for (file, title, settings, arrangement) in figures {
            let cells =
                settings.into_iter().map(|settings| self.make(&mut pipeline, settings)).collect::<Result<Vec<_>>>()?;
            let picture = studio.draw(&Figure { title, name: &name, axes, cells: &cells, arrangement }, self.width)?;
            let path = self.output.join(file);
            write_whole(&path, &encode(&picture)?)?;
            row(&format!("{} x {} pixels", picture.width, picture.height), path.display());
        }
        println!("{DISCLAIMER}");
        Ok(())
    }

    fn make(&self, pipeline: &mut Pipeline, settings: Settings) -> Result<Made> {
        pipeline.set(settings)?;
        advance(pipeline)?;
        let report = Report::new(&self.file, pipeline).context("the pipeline ended without a result")?;
        let reduced = pipeline.reduced().context("the pipeline ended without a result")?;
        Ok(Made { report, mesh: reduced.mesh.clone() })
    }
}

/// What a file or sample is called in a picture.
fn shown_name(file: &str) -> String {
    let sample = file.strip_prefix("sample:").and_then(|sample| sample.parse::<Sample>().ok());
    match (sample, Path::new(file).file_name()) {
        (Some(sample), _) => format!("{} (sample)", sample.label()),
        (None, Some(name)) => name.to_string_lossy().into_owned(),
        (None, None) => file.to_owned(),
    }
}

/// A picture as PNG. It is opaque: alpha is left out.
fn encode(picture: &Picture) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    for (keyword, text) in [("Software", concat!("Lumen ", env!("CARGO_PKG_VERSION"))), ("Disclaimer", DISCLAIMER)] {
        encoder.add_text_chunk(keyword.to_owned(), text.to_owned())?;
    }
    let rgb: Vec<u8> = picture.rgba.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
    encoder.write_header()?.write_image_data(&rgb)?;
    Ok(bytes)
}
