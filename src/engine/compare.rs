//! Several settings of one surface, one after another: what the compare view and the figures show.
//!
//! Each is run on a fork of a pipeline that has made most of what it needs: the one in force, or the one of the settings
//! before it. Where only the reduction rate differs, that is all but a level and its deviation.

use std::collections::VecDeque;

use super::found::Compared;
use super::message::{Event, Work};
use super::progress::tell_progress;
use crate::language::tell;
use crate::pipeline::report::Report;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::settings::{Settings, SettingsError};
use crate::pipeline::stage::Stage;
use crate::pipeline::task::Budget;

/// Settings that are compared.
pub(super) struct Comparing {
    /// That of the command.
    pub id: u64,
    total: usize,
    /// Those that have no answer yet, with their place in the command.
    waiting: VecDeque<(u32, Settings)>,
    /// What the first of them is run on.
    running: Option<Pipeline>,
    /// What the one before was run on.
    last: Option<Pipeline>,
}

impl Comparing {
    pub(super) fn new(id: u64, settings: Vec<Settings>) -> Self {
        let waiting: VecDeque<_> = (0..).zip(settings).collect();
        Self { id, total: waiting.len(), waiting, running: None, last: None }
    }

    /// Goes on with what `before`, on the same surface, has under way.
    pub(super) fn after(mut self, before: Self) -> Self {
        let first = self.waiting.front();
        self.running = before.running.filter(|run| first.is_some_and(|(_, settings)| settings == run.settings()));
        self.last = before.last;
        self
    }

    /// Works for about `budget`; `main` has the settings in force, `name` is the surface's. Whether there is more to do.
    pub(super) fn advance(
        &mut self,
        main: &Pipeline,
        name: &str,
        budget: Budget,
        events: &mut VecDeque<Event>,
    ) -> bool {
        while let Some(&(index, _)) = self.waiting.front() {
            match self.step(main, budget) {
                Ok(Advance::Working(stage, fraction)) => self.tell(stage, fraction, events),
                Ok(Advance::Finished(_)) => {}
                Ok(Advance::Idle) => {
                    self.last = self.running.take();
                    self.waiting.pop_front();
                    events.extend(self.last.as_ref().and_then(|pipeline| answer(self.id, index, name, pipeline)));
                }
                Err(error) => {
                    self.running = None;
                    self.waiting.pop_front();
                    events.push_back(Event::NotCompared { id: self.id, index, message: tell(&error) });
                }
            }
            if budget.is_spent() {
                break;
            }
        }
        !self.waiting.is_empty()
    }

    /// Goes on with the first that waits.
    fn step(&mut self, main: &Pipeline, budget: Budget) -> Result<Advance, SettingsError> {
        let Some((_, settings)) = self.waiting.front() else { return Ok(Advance::Idle) };
        if self.running.is_none() {
            let last = self.last.take().filter(|last| shared(last, settings) > shared(main, settings));
            // What is compared is the surface: its arrays stay behind.
            let mut pipeline = last.unwrap_or_else(|| main.fork().with_arrays(Vec::new()).with_measures());
            pipeline.set(settings.clone())?;
            self.running = Some(pipeline);
        }
        // Shape and lumen are not shown, nor are the vessels, but where a level goes by them.
        let is_shown =
            |stage: Stage| !stage.is_background() && !matches!(stage, Stage::SmoothedMeasures | Stage::Measures);
        let is_needed = |pipeline: &Pipeline| pipeline.is_deciding() || pipeline.next_stage().is_none_or(is_shown);
        let running = self.running.as_mut().filter(|pipeline| is_needed(pipeline));
        running.map_or(Ok(Advance::Idle), |pipeline| pipeline.advance(budget))
    }

    fn tell(&self, stage: Stage, fraction: f32, events: &mut VecDeque<Event>) {
        // The stages of one, each taken to be as long as the others.
        const STAGES: [Stage; 5] =
            [Stage::Connectivity, Stage::Smoothing, Stage::Decimation, Stage::Level, Stage::Deviation];
        // How far is safe is found, where a level goes by it, before that is taken.
        let place = if stage > Stage::Deviation { Stage::Level } else { stage };
        let before = STAGES.iter().filter(|&&other| other < place).count() as f32;
        let done = (self.total - self.waiting.len()) as f32 + (before + fraction) / STAGES.len() as f32;
        tell_progress(Work::Comparing, done / self.total as f32, events);
    }
}

/// How many stages of `pipeline` stand under `settings` as well.
fn shared(pipeline: &Pipeline, settings: &Settings) -> usize {
    let has = pipeline.settings();
    let alike = [
        has.keep == settings.keep,
        has.smoothing.gives_same(&settings.smoothing),
        has.decimation.gives_same(&settings.decimation),
    ];
    let made = [pipeline.kept().is_some(), pipeline.smoothed().is_some(), pipeline.progressive().is_some()];
    alike.into_iter().zip(made).take_while(|&(alike, made)| alike && made).count()
}

fn answer(id: u64, index: u32, name: &str, pipeline: &Pipeline) -> Option<Event> {
    let (report, reduced) = (Report::new(name, pipeline)?, pipeline.reduced()?);
    Some(Event::Compared(Box::new(Compared { id, index, report, mesh: reduced.mesh.clone() })))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::engine::{Command, Compared, Engine, Source};
    use crate::phantom::Sample;
    use crate::pipeline::paper;
    use crate::pipeline::settings::{Keep, Target};

    const SLICE: Duration = Duration::from_millis(2);

    fn source() -> Source {
        Source::Sample { sample: Sample::Aorta, triangles: 10_000 }
    }

    fn open() -> Engine {
        let mut engine = Engine::new();
        engine.handle(Command::Open { id: 1, source: source(), settings: Settings::default() });
        while engine.advance(SLICE) {}
        while engine.poll().is_some() {}
        engine
    }

    fn answers(engine: &mut Engine) -> Vec<Compared> {
        let events = std::iter::from_fn(|| engine.poll());
        events.filter_map(|event| if let Event::Compared(compared) = event { Some(*compared) } else { None }).collect()
    }

    #[test]
    fn every_setting_gets_the_level_and_the_numbers_that_it_gets_alone() {
        let mut engine = open();
        let settings = [paper::figure_6(Keep::Largest), paper::figure_7(Keep::Largest)].concat();
        engine.handle(Command::Compare { id: 2, settings: settings.clone() });
        while engine.advance(SLICE) {}
        let found = answers(&mut engine);
        assert_eq!(
            found.iter().map(|one| (one.id, one.index)).collect::<Vec<_>>(),
            (0..9).map(|i| (2, i)).collect::<Vec<_>>()
        );
        for (compared, settings) in found.iter().zip(settings) {
            let mut alone = Engine::new();
            alone.handle(Command::Open { id: 1, source: source(), settings: settings.clone() });
            while alone.advance(SLICE) {}
            let mut report = None;
            while let Some(event) = alone.poll() {
                if let Event::Measured { complete: true, report: measured, .. } = event {
                    report = Some(*measured);
                }
            }
            let report = report.expect("numbers");
            assert_eq!(compared.report.settings, settings);
            assert_eq!(compared.report.output, report.output);
            assert_eq!(compared.report.deviation_mm, report.deviation_mm);
            assert_eq!(compared.report.deviation_from_original_mm, report.deviation_from_original_mm);
            assert_eq!(compared.report.volume_change_percent, report.volume_change_percent);
            assert_eq!(compared.mesh.triangles.len(), report.output.triangles);
        }
    }

    #[test]
    fn another_rate_takes_the_levels_that_are_there() {
        let mut engine = open();
        let rough = |per_mille| {
            let mut settings = Settings { target: Target::Reduction(per_mille), ..Settings::default() };
            settings.smoothing.iterations = 20;
            settings
        };
        let settings = vec![Settings { target: Target::Reduction(500), ..Settings::default() }, rough(500), rough(990)];
        engine.handle(Command::Compare { id: 2, settings });
        let mut worked = Vec::new();
        while engine.advance(Duration::ZERO) {
            if let Some(comparing) = &engine.comparing {
                let stage = comparing.running.as_ref().and_then(Pipeline::next_stage);
                worked.extend(comparing.waiting.front().map(|&(index, _)| index).zip(stage));
            }
        }
        let stages =
            |index| worked.iter().filter(|of| of.0 == index).map(|of| of.1).collect::<std::collections::BTreeSet<_>>();
        assert!(!stages(0).contains(&Stage::Smoothing) && !stages(0).contains(&Stage::Decimation), "as in force");
        assert!(stages(1).contains(&Stage::Smoothing) && !stages(1).contains(&Stage::Connectivity), "another filter");
        assert!(!stages(2).contains(&Stage::Smoothing) && !stages(2).contains(&Stage::Decimation), "as the one before");
    }

    #[test]
    fn settings_in_force_go_first_and_a_cancel_ends_the_comparison() {
        let mut engine = open();
        engine.handle(Command::Compare { id: 2, settings: paper::figure_6(Keep::Largest) });
        while answers(&mut engine).is_empty() {
            assert!(engine.advance(SLICE));
        }
        let settings = Settings { target: Target::Reduction(500), ..Settings::default() };
        engine.handle(Command::Set { generation: 3, settings });
        while engine.advance(SLICE) {}
        let (mut order, mut deviations) = (String::new(), Vec::new());
        while let Some(event) = engine.poll() {
            match event {
                Event::Measured { generation: 3, complete: true, deviation, .. } => {
                    order.push('m');
                    deviations.push(deviation.is_some());
                }
                Event::Compared(_) => order.push('c'),
                _ => {}
            }
        }
        // With the deviation, and again with shape and lumen.
        assert_eq!(order, "mmccccc", "the numbers first, then what is left of the comparison");
        assert_eq!(deviations, [true, false], "that of each node is told once");
        engine.handle(Command::Compare { id: 4, settings: paper::figure_6(Keep::Largest) });
        engine.advance(SLICE);
        engine.handle(Command::Cancel);
        assert!(!engine.advance(SLICE) && answers(&mut engine).is_empty());
    }

    #[test]
    fn a_setting_that_is_asked_for_again_goes_on_where_it_was() {
        let mut engine = open();
        let mut settings = paper::figure_6(Keep::Largest);
        engine.handle(Command::Compare { id: 2, settings: settings.clone() });
        let running = |engine: &Engine| engine.comparing.as_ref()?.running.as_ref()?.next_stage();
        while running(&engine) < Some(Stage::Decimation) {
            assert!(engine.advance(Duration::ZERO));
        }
        let answered = answers(&mut engine).len();
        settings.drain(..answered);
        settings.push(Settings::default());
        engine.handle(Command::Compare { id: 3, settings: settings.clone() });
        assert_eq!(running(&engine), Some(Stage::Decimation), "the smoothing is not made again");
        while engine.advance(SLICE) {}
        let found = answers(&mut engine);
        assert!(found.iter().zip(&settings).all(|(one, settings)| one.id == 3 && one.report.settings == *settings));
        assert_eq!(found.len(), settings.len());
    }

    #[test]
    fn a_comparison_belongs_to_one_surface() {
        let mut engine = open();
        engine.handle(Command::Compare { id: 2, settings: paper::figure_7(Keep::Largest) });
        engine.handle(Command::Open { id: 3, source: source(), settings: Settings::default() });
        while engine.advance(SLICE) {}
        assert!(answers(&mut engine).is_empty(), "asked for before the surface was opened");
        engine.handle(Command::Open { id: 4, source: source(), settings: Settings::default() });
        engine.handle(Command::Compare { id: 5, settings: paper::figure_7(Keep::Largest) });
        while engine.advance(SLICE) {}
        assert_eq!(answers(&mut engine).len(), 3, "asked for after it");
    }
}
