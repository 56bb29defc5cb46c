//! `lumen tables --trial`: Tables III and IV of the paper, its trial at several reduction rates, by autopilot.
//!
//! A frame is 1/60 s of simulated time and a picture; without a window there is no picture, so the rates here are those
//! of the simulation alone, and the notes say so.

use anyhow::{Context, Result};

use super::running::advance;
use super::sheet::{Entry, Item, Sheet, Table};
use super::source::UnitOption;
use super::trial::{SMOOTHING, settings, surface, trial};
use crate::pipeline::paper::{TABLE_III, TABLE_IV, TrialRow};
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::Target;
use crate::trial::setup::Setup;
use crate::trial::summary::Summary;

/// The tables of a surface: Table III for the aorta, Table IV for the whole tree or a file. For the default, the aorta,
/// both are made.
pub(super) fn sheet(file: &str, unit: Option<UnitOption>) -> Result<Sheet> {
    let mut notes = vec![
        format!(
            "Autopilot, steps of 2 ms, seed 0; smoothed with pass band {} and {} iterations, which leave vessels of \
             1.5 mm open (the paper's 0.01 and 100 draw them shut).",
            SMOOTHING.0, SMOOTHING.1
        ),
        "A frame a second here is 1 / (time to compute 1/60 s): no window is open, so no picture is drawn. The app's \
         button makes the same tables with the time to draw one of 1280x800 beside it."
            .to_owned(),
        "The paper steered by hand, on a computer of 2016, and its vessels are not published.".to_owned(),
    ];
    let tables = if file == "sample:aorta" {
        vec![table("III", file, unit, &mut notes)?, table("IV", "sample:coronary", None, &mut notes)?]
    } else {
        vec![table("IV", file, unit, &mut notes)?]
    };
    Ok(Sheet { notes, tables })
}

fn table(number: &'static str, file: &str, unit: Option<UnitOption>, notes: &mut Vec<String>) -> Result<Table> {
    let (rates, printed): (&[u32], &[TrialRow]) =
        if number == "III" { (&[10, 50, 75, 90, 99], &TABLE_III) } else { (&[0, 90, 95, 99], &TABLE_IV) };
    let (opened, sample) = surface(file, None, unit)?;
    let mut setup = Setup { proposes_wire: true, ..Setup::default() };
    let mut pipeline = Pipeline::new(opened, settings(SMOOTHING, Target::Reduction(rates[0] * 10))).without_measures();
    let mut items = Vec::new();
    for &rate in rates {
        pipeline.set(settings(SMOOTHING, Target::Reduction(rate * 10)))?;
        advance(&mut pipeline)?;
        let mesh = pipeline.reduced().context("the pipeline ended without a result")?.mesh.clone();
        let paper = printed.iter().find(|row| row.rate == rate);
        match trial(&mesh, sample, setup.clone(), None, false) {
            Ok(run) => {
                if items.is_empty() {
                    notes.push(format!("Table {number}: {file}, wire {}.", run.setup().wire.name));
                }
                // The same wire, entry and target at every rate.
                setup = run.setup().clone();
                items.push(item(rate, &run.summary(), paper));
            }
            Err(error) => notes.push(format!("At {rate} % there is no trial: {error}.")),
        }
    }
    Ok(Table {
        number,
        title: if number == "III" { "The trial in the aorta" } else { "The trial in the whole tree" },
        input: file.to_owned(),
        of: "reduction rate",
        items,
        notes: Vec::new(),
    })
}

fn item(rate: u32, summary: &Summary, paper: Option<&TrialRow>) -> Item {
    let fps = |ms: f64| 1e3 / ms.max(1e-6);
    let passed: Vec<f64> = summary.stations.iter().filter_map(|station| station.simulation_ms).collect();
    let rates = || passed.iter().map(|&ms| fps(ms));
    let average = (!passed.is_empty()).then(|| rates().sum::<f64>() / passed.len() as f64);
    let number = |quantity, unit, decimals, value| Entry::number(quantity, unit, decimals, None, value);
    let beside = |quantity, printed: Option<u32>, value| Entry::number(quantity, "", 0, printed.map(f64::from), value);
    Item {
        name: format!("{rate} %"),
        entries: vec![
            Entry::count("triangles", None, summary.triangles),
            beside("initial fps", paper.map(|row| row.initial_fps), Some(fps(summary.initial_simulation_ms))),
            beside("average fps", paper.map(|row| row.average_fps), average),
            number("worst fps", "", 0, rates().reduce(f64::min)),
            number("steps a second", "", 0, Some(summary.steps_per_second)),
            beside("success", paper.map(|row| u32::from(row.success)), Some(f64::from(u8::from(summary.success)))),
            number("peak wall force", "N", 3, Some(summary.max_wall_force_n)),
            number("mean wall force", "N", 4, Some(summary.mean_wall_force_n)),
            number("unbalanced steps", "%", 1, Some(100.0 * summary.unbalanced_share)),
            number("time to target", "s", 1, summary.success.then_some(summary.time_s)),
        ],
    }
}
