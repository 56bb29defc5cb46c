//! `lumen sweep`: what reduction does to the wire, rate by rate.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use clap::Args;

use super::misuse::misuse;
use super::options::percent;
use super::places::write_whole;
use super::rows::row;
use super::running::advance;
use super::source::{UNIT_HELP, UnitOption};
use super::trial::{SMOOTHING, settings, surface, wire};
use super::{interrupt, places};
use crate::pipeline::report::DISCLAIMER;
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::Target;
use crate::report::{svg_file, sweep_plot};
use crate::trial::setup::Setup;
use crate::trial::sweep::{Spread, SweepRow, settled_setup, sweep};

/// Shows what reduction does to a guidewire: trials by the autopilot at each rate, beside the unreduced surface.
#[derive(Debug, Args)]
pub struct Sweep {
    /// A surface file, or sample:aorta, sample:coronary
    file: String,
    /// Reduction rates in percent
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = percent, default_value = "0,50,75,90,95,99")]
    rates: Vec<f64>,
    /// Trials at each rate
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// The wire [default: what suits the way]
    #[arg(long, value_name = "NAME")]
    wire: Option<String>,
    /// Pass band of the smoothing that comes first, 0 to 2
    #[arg(long, value_name = "K", default_value_t = SMOOTHING.0)]
    pass_band: f64,
    /// Its iterations; 0 leaves the surface as it is
    #[arg(long, value_name = "N", default_value_t = SMOOTHING.1)]
    iterations: u32,
    /// Write a row for each rate here
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Write a plot here
    #[arg(long, value_name = "OUT.svg")]
    plot: Option<PathBuf>,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
}

impl Sweep {
    /// Runs the trials.
    pub(super) fn run(&self) -> Result<()> {
        let outputs = [("the table", &self.csv), ("the plot", &self.plot)];
        let outputs = outputs.into_iter().filter_map(|(what, path)| Some((what.to_owned(), path.as_deref()?)));
        places::check([Path::new(&self.file)], outputs)?;
        let wire = wire(self.wire.as_deref())?;
        let setup = Setup { wire, proposes_wire: self.wire.is_none(), ..Setup::default() };
        let (opened, sample) = surface(&self.file, None, self.unit)?;
        let at =
            |rate: f64| settings((self.pass_band, self.iterations), Target::Reduction((rate * 10.0).round() as u32));
        at(0.0).check().map_err(misuse)?;
        let mut pipeline = Pipeline::new(opened, at(0.0)).without_measures();
        let mut level = |rate: f64| -> Result<_> {
            pipeline.set(at(rate))?;
            advance(&mut pipeline)?;
            Ok(pipeline.reduced().context("the pipeline ended without a result")?.mesh.clone())
        };
        let original = level(0.0)?;
        let setup =
            settled_setup(&original, sample, setup).map_err(|error| anyhow!("no trial is possible: {error}"))?;
        row("wire", &setup.wire.name);
        println!(
            "{:>7} {:>10} {:>8} {:>14} {:>12} {:>14} {:>14}",
            "rate", "triangles", "arrive", "deviation mm", "noise mm", "peak force N", "mean force N"
        );
        let mut rows = Vec::new();
        for &rate in &self.rates {
            let mesh = level(rate)?;
            // Pinched shut at a rate: that is a result, and the others go on.
            match sweep(&mesh, &original, &setup, self.seeds, || interrupt::check().is_err()) {
                Ok(Some(found)) => {
                    println!("{}", line(rate, &found));
                    rows.push((rate, found));
                }
                Ok(None) => break,
                Err(error) => {
                    println!("{rate:>5} % {:>10} no trial is possible: {error}", mesh.triangles.len());
                    rows.push((rate, SweepRow { triangles: mesh.triangles.len(), ..SweepRow::default() }));
                }
            }
        }
        if let Some(path) = &self.csv {
            write_whole(path, &csv(&rows)?)?;
        }
        if let Some(path) = &self.plot {
            write_whole(path, svg_file(&sweep_plot(&self.file, &rows)).as_bytes())?;
        }
        println!("{DISCLAIMER}");
        interrupt::check()
    }
}

/// A row of the table on the screen: of each quantity the median and the largest of the seeds.
fn line(rate: f64, row: &SweepRow) -> String {
    let told = |spread: Option<Spread>, decimals: usize| {
        spread.map_or("-".to_owned(), |it| format!("{:.decimals$}, {:.decimals$}", it.median, it.largest))
    };
    format!(
        "{rate:>5} % {:>10} {:>8} {:>14} {:>12} {:>14} {:>14}",
        row.triangles,
        format!("{} of {}", row.arrived, row.seeds),
        told(row.deviation_mm, 2),
        told(row.noise_mm, 2),
        told(row.peak_force_n, 3),
        told(row.mean_force_n, 4)
    )
}

/// A row for each rate; medians and the largest of the seeds.
fn csv(rows: &[(f64, SweepRow)]) -> Result<Vec<u8>> {
    let mut table = csv::Writer::from_writer(format!("# {}\n", DISCLAIMER.to_lowercase()).into_bytes());
    let quantities = ["deviation_mm", "noise_mm", "peak_force_n", "mean_force_n", "time_s"];
    let of_each = quantities.iter().flat_map(|name| [format!("{name}_median"), format!("{name}_max")]);
    let heads = ["rate_percent", "triangles", "seeds", "arrived"].map(str::to_owned);
    table.write_record(heads.into_iter().chain(of_each))?;
    for (rate, row) in rows {
        let spreads = [row.deviation_mm, row.noise_mm, row.peak_force_n, row.mean_force_n, row.time_s];
        let values = spreads.iter().flat_map(|spread| {
            let text =
                |value: fn(&Spread) -> f64| spread.as_ref().map_or(String::new(), |it| format!("{:.6}", value(it)));
            [text(|spread| spread.median), text(|spread| spread.largest)]
        });
        let counts = [rate.to_string(), row.triangles.to_string(), row.seeds.to_string(), row.arrived.to_string()];
        table.write_record(counts.into_iter().chain(values))?;
    }
    Ok(table.into_inner()?)
}
