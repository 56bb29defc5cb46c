//! What does each stage cost as the surface grows? `cargo bench --bench stages`, then `cargo xtask curve`.
//!
//! Each time is that of the stage as the program runs it, by the pipeline's own clock: what a stage needs is there
//! already, and a changed setting makes it alone stale. Smoothing is that of a surface just opened: nothing that an
//! earlier one left is there. The two filters alone are the passes by one pass band and by one for each vertex, on the
//! same surface: half of the vertices have their own, up to 0.083, as on the sample. Sizes are those of the aorta
//! sample's largest piece; `LUMEN_BENCH_TRIANGLES` is the largest that is measured.

use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use lumen::mesh::{TriMesh, Vec3};
use lumen::phantom::{Sample, generate};
use lumen::pipeline::filter::Filter;
use lumen::pipeline::normals::{Weighting, vertex_normals};
use lumen::pipeline::results::StageTimes;
use lumen::pipeline::run::{Advance, Pipeline};
use lumen::pipeline::settings::{Boundary, Settings, Smoothing, Target};
use lumen::pipeline::smoothing::{smooth, smooth_varying};
use lumen::pipeline::stage::Stage;
use lumen::pipeline::task::{Budget, Yielder, at_once};

const SIZES: [usize; 6] = [10_000, 30_000, 100_000, 300_000, 1_000_000, 4_000_000];

/// Milliseconds of one run of a stage.
type Measure = fn(&mut Bench) -> f64;

/// The stages, and how their time is taken.
const STAGES: [(&str, Measure); 13] = [
    ("connectivity", |bench| bench.anew().connectivity),
    ("topology", |bench| bench.anew().adjacency),
    ("filter-plain", Bench::plain_filter),
    ("filter-adapted", Bench::adapted_filter),
    ("smoothing-paper", |bench| bench.smoothed_anew(&Smoothing::PAPER)),
    ("smoothing-unguarded", |bench| bench.smoothed_anew(&Smoothing { guard: false, ..Smoothing::default() })),
    ("smoothing-auto", |bench| bench.smoothed_anew(&Smoothing::default())),
    ("normals", Bench::normals),
    ("decimation", |bench| {
        bench
            .again(Stage::Decimation, |settings| other(&mut settings.decimation.feature_angle, [60.0, 60.01]))
            .decimation
    }),
    ("level-90", |bench| bench.another_level(Stage::Level).level),
    ("areas", |bench| bench.anew().areas),
    ("deviation", |bench| bench.another_level(Stage::Deviation).deviation),
    ("measures", |bench| bench.another_level(Stage::Measures).measures),
];

/// Sets `value` to the one of two that it is not.
fn other<T: Copy + PartialEq>(value: &mut T, [first, second]: [T; 2]) {
    *value = if *value == first { second } else { first };
}

/// A surface, and a pipeline that has gone through it.
struct Bench {
    opened: Arc<TriMesh>,
    pipeline: Pipeline,
}

impl Bench {
    fn new(triangles: usize) -> Self {
        let opened = Arc::new(generate(Sample::Aorta, triangles).expect("the size is in range"));
        let settings = Settings { target: Target::Reduction(900), ..Settings::default() };
        let mut pipeline = Pipeline::new(opened.clone(), settings);
        run_to(&mut pipeline, Stage::Level);
        Self { opened, pipeline }
    }

    /// The times of the first stage of a pipeline of its own.
    fn anew(&mut self) -> StageTimes {
        let mut pipeline = Pipeline::new(self.opened.clone(), Settings::default());
        run_to(&mut pipeline, Stage::Connectivity);
        pipeline.times()
    }

    /// The times after a change of settings, up to `stage`.
    fn again(&mut self, stage: Stage, change: impl FnOnce(&mut Settings)) -> StageTimes {
        let mut settings = self.pipeline.settings().clone();
        change(&mut settings);
        self.pipeline.set(settings).expect("the settings are in range");
        run_to(&mut self.pipeline, stage);
        self.pipeline.times()
    }

    /// The time to smooth a surface that was just opened.
    fn smoothed_anew(&mut self, smoothing: &Smoothing) -> f64 {
        let settings = Settings { smoothing: *smoothing, ..Settings::default() };
        let mut pipeline = Pipeline::new(self.opened.clone(), settings);
        run_to(&mut pipeline, Stage::Smoothing);
        pipeline.times().smoothing
    }

    fn plain_filter(&mut self) -> f64 {
        let kept = self.pipeline.kept().expect("the pipeline went through").clone();
        let begun = Instant::now();
        let (topology, filter) = (&*kept.topology, Filter::new(&Smoothing::PAPER));
        std::hint::black_box(smooth(&kept.mesh.positions, topology, Boundary::Loop, &filter));
        begun.elapsed().as_secs_f64() * 1e3
    }

    fn adapted_filter(&mut self) -> f64 {
        let kept = self.pipeline.kept().expect("the pipeline went through").clone();
        let positions = &kept.mesh.positions;
        let (low, high) = bounds(positions);
        let band = |p: &Vec3| 0.01 + 0.146 * ((p.z - low) / (high - low) - 0.5).max(0.0);
        let bands: Vec<f32> = positions.iter().map(band).collect();
        let begun = Instant::now();
        std::hint::black_box(
            at_once(smooth_varying(positions, &kept.topology, &Smoothing::default(), &bands, 0, &Yielder::never())).0,
        );
        begun.elapsed().as_secs_f64() * 1e3
    }

    fn another_level(&mut self, stage: Stage) -> StageTimes {
        self.again(stage, |settings| other(&mut settings.target, [Target::Reduction(900), Target::Reduction(899)]))
    }

    fn normals(&mut self) -> f64 {
        let begun = Instant::now();
        std::hint::black_box(vertex_normals(&self.opened.positions, &self.opened.triangles, Weighting::Area));
        begun.elapsed().as_secs_f64() * 1e3
    }
}

/// How far down and up positions reach.
fn bounds(positions: &[Vec3]) -> (f32, f32) {
    positions.iter().fold((f32::MAX, f32::MIN), |(low, high), p| (low.min(p.z), high.max(p.z)))
}

/// Runs a pipeline until `stage` is finished.
fn run_to(pipeline: &mut Pipeline, stage: Stage) {
    loop {
        match pipeline.advance(Budget::UNLIMITED).expect("the settings fit the surface") {
            Advance::Finished(done) if done == stage => return,
            Advance::Idle => panic!("{stage:?} was finished before"),
            _ => {}
        }
    }
}

fn stages(criterion: &mut Criterion) {
    let most = std::env::var("LUMEN_BENCH_TRIANGLES").ok().and_then(|text| text.parse().ok()).unwrap_or(usize::MAX);
    for triangles in SIZES.into_iter().filter(|&size| size <= most) {
        let mut bench = Bench::new(triangles);
        for (stage, measure) in STAGES {
            let mut group = criterion.benchmark_group(stage);
            // A run can take a minute: one a sample, and no more samples than there have to be.
            group.sampling_mode(SamplingMode::Flat).sample_size(10);
            group.warm_up_time(Duration::from_millis(1)).measurement_time(Duration::from_millis(200));
            group.throughput(Throughput::Elements(triangles as u64));
            group.bench_function(BenchmarkId::from_parameter(triangles), |bencher| {
                bencher.iter_custom(|runs| (0..runs).map(|_| Duration::from_secs_f64(measure(&mut bench) / 1e3)).sum());
            });
            group.finish();
        }
    }
}

criterion_group!(benches, stages);
criterion_main!(benches);
