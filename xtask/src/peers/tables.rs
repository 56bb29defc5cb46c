//! The tables of `docs/benchmarks/peers.md` and `quality.csv`, with what each number is meant to reach beside it.

use std::fmt::Write as _;

use super::report::{Quality, Reduced, Report, Surface, Time};

const RATES: [u32; 5] = [10, 50, 75, 90, 99];
/// From here on a surface is measured by the second of two targets.
const LARGE: usize = 300_000;

/// A row beside VTK.
struct Row {
    what: &'static str,
    vtk: Vec<(f64, String)>,
    /// Lumen's parts, without the prefix that says where it ran.
    lumen: Vec<(f64, &'static str)>,
    /// Targets for native and browser, small and large; none where nothing was set.
    targets: [Option<[f64; 2]>; 2],
    kind: Kind,
}

/// How a row compares.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Lumen's part of VTK's time: the less the better.
    Part,
    /// How many times faster Lumen is: the more the better.
    Faster,
}

fn one(key: &str) -> Vec<(f64, String)> {
    vec![(1.0, key.to_owned())]
}

fn vtk_pipeline(rates: &[u32]) -> Vec<(f64, String)> {
    let stages = ["vtk.connectivity", "vtk.smoothing60", "vtk.normals"].map(str::to_owned);
    stages.into_iter().chain(rates.iter().map(|rate| format!("vtk.pro{rate}"))).map(|key| (1.0, key)).collect()
}

/// Every stage of Lumen's to the level, the measuring of areas and volumes included, which VTK is not asked for.
const PIPELINE: [(f64, &str); 8] = [
    (1.0, "connectivity"),
    (1.0, "adjacency"),
    (1.0, "areas"),
    (1.0, "smoothing60"),
    (1.0, "normals"),
    (1.0, "decimation"),
    (1.0, "level90"),
    (1.0, "normals90"),
];

/// The same at the setting that the paper chose, which is the default.
const PAPER: [(f64, &str); 8] = [
    (1.0, "paper.connectivity"),
    (1.0, "paper.adjacency"),
    (1.0, "paper.areas"),
    (1.0, "paper.smoothing100"),
    (1.0, "paper.normals90"),
    (1.0, "paper.decimation"),
    (1.0, "paper.level90"),
    (1.0, "normals"),
];

fn rows() -> Vec<Row> {
    let smoothing = |what, key: &'static str, targets| Row {
        what,
        vtk: one(&format!("vtk.{key}")),
        lumen: vec![(1.0, "adjacency"), (1.0, key)],
        targets,
        kind: Kind::Part,
    };
    let mut five_levels = PIPELINE.to_vec();
    five_levels.extend([(4.0, "level0"), (4.0, "normals")]);
    vec![
        Row {
            what: "connectivity and compaction",
            vtk: one("vtk.connectivity"),
            lumen: vec![(1.0, "connectivity")],
            targets: [Some([0.15, 0.10]); 2],
            kind: Kind::Part,
        },
        smoothing("smoothing, 30 iterations", "smoothing30", [None; 2]),
        smoothing("smoothing, 60 iterations", "smoothing60", [None; 2]),
        smoothing("smoothing, 100 iterations", "smoothing100", [Some([0.32, 0.45]), Some([0.52, 0.90])]),
        Row {
            what: "normals, all vertices",
            vtk: one("vtk.normals"),
            lumen: vec![(1.0, "normals")],
            targets: [Some([0.05; 2]); 2],
            kind: Kind::Part,
        },
        Row {
            what: "decimation: all rates, DecimatePro five times",
            vtk: RATES.iter().map(|rate| (1.0, format!("vtk.pro{rate}"))).collect(),
            lumen: vec![(1.0, "decimation")],
            targets: [None; 2],
            kind: Kind::Part,
        },
        Row {
            what: "to the level at 90 %, 60 iterations",
            vtk: vtk_pipeline(&[90]),
            lumen: PIPELINE.to_vec(),
            targets: [Some([4.0, 5.0]), Some([2.5, 3.0])],
            kind: Kind::Faster,
        },
        Row {
            what: "to the levels at five rates, 60 iterations",
            vtk: vtk_pipeline(&RATES),
            lumen: five_levels,
            targets: [Some([10.0, 18.0]), None],
            kind: Kind::Faster,
        },
        Row {
            what: "to the level at 90 %, at the paper's setting (0.01, 100)",
            vtk: ["vtk.connectivity", "vtk.paper.smoothing100", "vtk.normals", "vtk.paper.pro90"]
                .map(|key| (1.0, key.to_owned()))
                .to_vec(),
            lumen: PAPER.to_vec(),
            targets: [None; 2],
            kind: Kind::Faster,
        },
    ]
}

/// Each block by name.
pub(crate) fn blocks(report: &Report) -> Vec<(&'static str, String)> {
    vec![
        ("conditions", conditions(report)),
        ("times", times(report)),
        ("quality", quality(report)),
        ("memory", memory(report)),
    ]
}

fn conditions(report: &Report) -> String {
    let versions: Vec<String> = report.versions.iter().map(|(what, version)| format!("{what} {version}")).collect();
    let machine = &report.machine;
    format!(
        "{} cores of {}, {}. {}. Medians of runs in turn, one thread each; the least in brackets.",
        machine.cores,
        machine.cpu,
        machine.system,
        versions.join(", ")
    )
}

fn times(report: &Report) -> String {
    let mut text = String::new();
    for surface in &report.surfaces {
        let size = usize::from(surface.triangles >= LARGE);
        let _ = writeln!(text, "### {}: {} triangles, {} runs\n", surface.name, surface.triangles, surface.runs);
        text += "| stage | VTK ms | Lumen ms | ratio | target | Lumen in the browser ms | ratio | target |\n";
        text += "|---|---|---|---|---|---|---|---|\n";
        for row in rows() {
            let Some(vtk) = surface.sum(&row.vtk.iter().map(|(n, key)| (*n, &key[..])).collect::<Vec<_>>()) else {
                continue;
            };
            let _ = write!(text, "| {} | {}", row.what, ms(Some(vtk)));
            for (place, target) in ["lumen", "wasm"].into_iter().zip(row.targets) {
                let keys: Vec<(f64, String)> =
                    row.lumen.iter().map(|(n, key)| (*n, format!("{place}.{key}"))).collect();
                let ours = surface.sum(&keys.iter().map(|(n, key)| (*n, &key[..])).collect::<Vec<_>>());
                let _ =
                    write!(text, " | {} | {}", ms(ours), compared(row.kind, vtk, ours, target.map(|both| both[size])));
            }
            text += " |\n";
        }
        text += &lumen_alone(surface);
        text += &waited_for(surface);
        text += &beside_vtkjs(surface);
        text += &decimation(surface);
        text += &same_surfaces(surface);
    }
    text
}

/// What Lumen does that has no filter beside it.
fn lumen_alone(surface: &Surface) -> String {
    let mut text = String::new();
    let parts = [
        ("adjacency (counted with smoothing above)", "adjacency"),
        ("areas and volumes", "areas"),
        ("a level at 90 % from the run that is there", "level90"),
        ("the level at 0 %", "level0"),
    ];
    for (what, key) in parts {
        let [native, wasm] = ["lumen", "wasm"].map(|place| surface.sum(&[(1.0, &format!("{place}.{key}"))]));
        let told = match wasm {
            Some(wasm) if key.starts_with("level") && surface.triangles < LARGE => {
                verdict(wasm.median < 2.0, "under 2 ms")
            }
            _ => String::new(),
        };
        let _ = writeln!(text, "| {what} | | {} | | | {} | | {told} |", ms(native), ms(wasm));
    }
    if let (Some(full), Some(other)) =
        (surface.sum(&[(1.0, "wasm.smoothing60")]), surface.sum(&[(1.0, "wasm.otherPassBand60")]))
    {
        let ratio = other.median / full.median;
        let told = verdict(ratio < 0.5, "under half of 60 iterations");
        let _ = writeln!(
            text,
            "| another pass band alone, 60 iterations | | | | | {} | {ratio:.2} | {told} |",
            ms(Some(other))
        );
    }
    text
}

/// What comes after the level natively, at the paper's setting, until the last number is there.
fn waited_for(surface: &Surface) -> String {
    let part = |key: &str| surface.sum(&[(1.0, &format!("lumen.paper.{key}"))]);
    let shown: Vec<(f64, String)> = PAPER.iter().map(|(n, key)| (*n, format!("lumen.{key}"))).collect();
    let mut all: Vec<(f64, &str)> = shown.iter().map(|(n, key)| (*n, &key[..])).collect();
    let level = surface.sum(&all);
    all.extend([(1.0, "lumen.paper.deviation"), (1.0, "lumen.paper.measures")]);
    let Some(everything) = surface.sum(&all) else { return String::new() };
    format!(
        "\n| natively, 90 % at the paper's setting | to the level | both deviations | shape and lumen | until the last number |\n\
         |---|---|---|---|---|\n| ms | {} | {} | {} | {} |\n",
        ms(level),
        ms(part("deviation")),
        ms(part("measures")),
        ms(Some(everything))
    )
}

/// Smoothing and normals beside VTK as it is in JavaScript.
fn beside_vtkjs(surface: &Surface) -> String {
    let mut text =
        String::from("\n| in JavaScript's engine | vtk.js ms | Lumen in the browser ms | ratio |\n|---|---|---|---|\n");
    let rows = [
        ("smoothing, 30 iterations", "smoothing30", &["adjacency", "smoothing30"][..]),
        ("smoothing, 60 iterations", "smoothing60", &["adjacency", "smoothing60"]),
        ("smoothing, 100 iterations", "smoothing100", &["adjacency", "smoothing100"]),
        ("normals, all vertices", "normals", &["normals"]),
    ];
    for (what, key, ours) in rows {
        let Some(theirs) = surface.sum(&[(1.0, &format!("vtkjs.{key}"))]) else { return String::new() };
        let keys: Vec<String> = ours.iter().map(|part| format!("wasm.{part}")).collect();
        let ours = surface.sum(&keys.iter().map(|key| (1.0, &key[..])).collect::<Vec<_>>());
        let ratio = ours.map_or_else(String::new, |ours| format!("{:.3}", ours.median / theirs.median));
        let _ = writeln!(text, "| {what} | {} | {} | {ratio} |", ms(Some(theirs)), ms(ours));
    }
    text
}

/// Decimation beside every peer.
fn decimation(surface: &Surface) -> String {
    let mut text = String::from(
        "\n| decimation | five rates ms | 90 % alone ms | in WebAssembly, five rates ms | 90 % alone ms |\n|---|---|---|---|---|\n",
    );
    let all = |prefix: &str| {
        let keys: Vec<String> = RATES.iter().map(|rate| format!("{prefix}{rate}")).collect();
        surface.sum(&keys.iter().map(|key| (1.0, &key[..])).collect::<Vec<_>>())
    };
    let single = |prefix: &str| surface.sum(&[(1.0, &format!("{prefix}90"))]);
    for (name, native, wasm) in [
        ("Lumen schroeder: every rate at once", "lumen", "wasm"),
        ("Lumen quadric: every rate at once", "lumen.quadric", "wasm.quadric"),
    ] {
        let [native, wasm] = [native, wasm].map(|prefix| surface.sum(&[(1.0, &format!("{prefix}.decimation"))]));
        if native.is_some() {
            let _ = writeln!(
                text,
                "| {name} | {} | | {} | |",
                beside(native, all("meshopt")),
                beside(wasm, all("meshoptWasm"))
            );
        }
    }
    let meshopt = [all("meshopt"), single("meshopt"), all("meshoptWasm"), single("meshoptWasm")].map(ms);
    let _ = writeln!(text, "| meshoptimizer | {} |", meshopt.join(" | "));
    for (name, prefix) in
        [("fast-simplification", "fast"), ("vtkQuadricDecimation", "vtk.quadric"), ("DecimatePro", "vtk.pro")]
    {
        let _ = writeln!(text, "| {name} | {} | {} | | |", ms(all(prefix)), ms(single(prefix)));
    }
    text
}

/// Lumen's one run, and its part of meshoptimizer's five.
fn beside(ours: Option<Time>, theirs: Option<Time>) -> String {
    match (ours, theirs) {
        (Some(a), Some(b)) => {
            let ratio = a.median / b.median;
            format!("{}: {ratio:.2} of meshoptimizer's five, {}", ms(ours), verdict(ratio < 1.0, "below 1"))
        }
        _ => ms(ours),
    }
}

/// Whether both places made the same level, and with which settings.
fn same_surfaces(surface: &Surface) -> String {
    let mut text = String::new();
    for (method, made) in &surface.lumen {
        let browser = match surface.wasm_fingerprints.get(method) {
            Some(found) if *found == made.fingerprint => "and in the browser the same",
            Some(_) => "but **another in the browser**",
            None => "and the browser was left out",
        };
        let _ = writeln!(
            text,
            "\nThe level at 90 % by {method} has the fingerprint `{}` natively {browser}; settings `{}`.",
            made.fingerprint, made.settings
        );
    }
    text + "\n"
}

fn ms(time: Option<Time>) -> String {
    let digits = |ms: f64| if ms < 10.0 { format!("{ms:.2}") } else { format!("{ms:.1}") };
    time.map_or_else(String::new, |Time { median, min }| format!("{} ({})", digits(median), digits(min)))
}

/// "0.31 | at most 0.32: met"
fn compared(kind: Kind, vtk: Time, ours: Option<Time>, target: Option<f64>) -> String {
    let Some(ours) = ours else { return " | ".to_owned() };
    let (ratio, sign) = match kind {
        Kind::Part => (ours.median / vtk.median, ""),
        Kind::Faster => (vtk.median / ours.median, "x"),
    };
    let told = match (kind, target) {
        (_, None) => String::new(),
        (Kind::Part, Some(most)) => verdict(ratio <= most, &format!("at most {most}")),
        (Kind::Faster, Some(least)) => verdict(ratio >= least, &format!("at least {least}x")),
    };
    format!("{ratio:.2}{sign} | {told}")
}

fn verdict(is_met: bool, target: &str) -> String {
    format!("{target}: {}", if is_met { "met" } else { "**missed**" })
}

fn quality(report: &Report) -> String {
    let mut text = String::new();
    for surface in &report.surfaces {
        for found in &surface.quality {
            let Quality { pass_band, iterations, rows } = found;
            let _ = writeln!(text, "### {}, pass band {pass_band}, {iterations} iterations\n", surface.name);
            text += "| rate, method | triangles | mean mm | RMS mm | max mm | volume % | angle < 10, % | self-intersecting | \
                     pieces | non-manifold | Euler | target |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
            for row in rows {
                let Reduced { rate, method, triangles, pieces, euler, .. } = row;
                let _ = writeln!(
                    text,
                    "| {rate} {method} | {triangles} | {:.4} | {:.4} | {:.3} | {:+.3} | {:.1} | {} | {pieces} | {} | {euler} | {} |",
                    row.mean,
                    row.rms,
                    row.max,
                    row.volume_percent,
                    row.slivers_percent,
                    row.self_intersecting,
                    row.non_manifold,
                    held(row, rows)
                );
            }
            text += "\n";
        }
    }
    text
}

/// What one of Lumen's rows has to hold against the peers' at the same rate, and what it misses.
fn held(row: &Reduced, rows: &[Reduced]) -> String {
    let peer = |name: &str| rows.iter().find(|other| other.rate == row.rate && other.method.starts_with(name));
    let entered = rows.iter().find(|other| other.rate == 0);
    let mut missed = Vec::new();
    let mut check = |holds: bool, what: &str| {
        if !holds {
            missed.push(what.to_owned());
        }
    };
    match (&row.method[..], peer("DecimatePro"), peer("vtkQuadric")) {
        ("Lumen schroeder", Some(pro), _) => {
            check(row.mean <= pro.mean, "mean");
            check(row.max <= pro.max, "max");
        }
        ("Lumen quadric", _, Some(vtk)) => {
            check(row.mean <= vtk.mean, "mean");
            check(row.max <= vtk.max, "max");
            check(row.volume_percent.abs() <= vtk.volume_percent.abs(), "volume");
            check(row.rate != 90 || row.slivers_percent <= 1.2, "angles");
        }
        _ => return String::new(),
    }
    if let Some(entered) = entered {
        let wanted = entered.triangles * (100 - row.rate as usize) / 100;
        check(row.triangles <= wanted && row.triangles + 2 > wanted, "count");
        check(row.self_intersecting <= entered.self_intersecting, "self-intersections");
        check((row.pieces, row.euler) == (entered.pieces, entered.euler), "topology");
        check(row.non_manifold <= entered.non_manifold, "manifold");
    }
    if missed.is_empty() { "met".to_owned() } else { format!("**missed**: {}", missed.join(", ")) }
}

fn memory(report: &Report) -> String {
    let mut text = String::from(
        "| surface | triangles | `lumen optimise`, peak MB | browser: page MB | Worker MB | both | seconds in the browser | target |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let mb = |bytes: Option<u64>| bytes.map_or_else(String::new, |bytes| format!("{:.0}", bytes as f64 / 1e6));
    for row in &report.memory {
        let both = row.page.zip(row.worker).map(|(page, worker)| page + worker);
        // The pipeline is in the process natively and in the Worker in the browser.
        let target = match row.triangles {
            0..2_000_000 => verdict(row.native.max(row.worker.unwrap_or(0)) < 500_000_000, "the pipeline below 500"),
            _ => "goes through".to_owned(),
        };
        let seconds = row.seconds.map_or_else(String::new, |seconds| format!("{seconds:.1}"));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {seconds} | {target} |",
            row.file,
            row.triangles,
            mb(Some(row.native)),
            mb(row.page),
            mb(row.worker),
            mb(both)
        );
    }
    text
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
