//! `cargo xtask validation`: runs the wire's benchmarks, draws each, writes every answer into `docs/validation.csv` and a
//! line for each benchmark and tolerance into `docs/validation.md`.

mod plot;

use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, anyhow, bail};

use self::plot::{Kind, Plot, Series};
use crate::document;
use crate::step::{cargo, root, run, step, target};

/// A benchmark, and what its plot shows: name, title, axes, whether both are logarithmic.
const BENCHMARKS: [(&str, &str, [&str; 2], bool); 45] = [
    ("cantilever", "Cantilever under an end load", ["P L² / EI", "tip over L"], false),
    ("cantilever-order", "Cantilever: error of the tip", ["elements", "error over L"], true),
    ("ring", "Ring closed by an end moment", ["x / L", "y / L"], false),
    ("ring-order", "Ring: distance of its ends", ["elements", "distance over L"], true),
    (
        "euler",
        "Columns: stiffness across under a load along",
        ["P L² / EI", "stiffness over that without a load"],
        false,
    ),
    ("euler-order", "Clamped column: error of the critical load", ["elements", "error"], true),
    ("greenhill", "Columns: moment at which they buckle", ["P L² / EI", "M L / EI"], false),
    ("greenhill-order", "Clamped twisted column: error of the critical moment", ["elements", "error"], true),
    ("torsion", "Twist of a wire", ["distance from the tip over L", "turn over that of the tip"], false),
    ("michell", "A twisted ring leaves its plane", ["turn, rad", "stiffness across over that without a turn"], false),
    ("michell-order", "Twisted ring: error of the critical turn", ["elements", "error"], true),
    ("whip", "A bent tip in a bent tube", ["turn of the base, degrees", "turn of the tip, degrees"], false),
    ("whip-order", "Whip: error of the number from which on it snaps", ["elements", "error"], true),
    ("capstan", "Pull through half a turn", ["coefficient of friction", "pull over that at the tip"], false),
    ("push", "Push through half a turn", ["coefficient of friction", "push over that at the tip"], false),
    (
        "facets",
        "Push along a floor that is cut finer",
        ["length of the triangles, mm", "push of each mm over μ w"],
        true,
    ),
    ("sides", "Friction in a bend of more sides", ["sides of the tube", "work of friction over μ N"], true),
    ("stiff", "A stiff shaft in a bend", ["EI, N mm²", "push over EI, 1/mm²"], true),
    ("feed", "A wire that is fed faster", ["feed, mm/s", "tip from that at 20 mm/s, mm"], false),
    ("roll", "Torque that rolls a wire in a bend", ["sides of the tube", "torque, N mm"], false),
    ("stick-slip", "A piece of wire pushed to and fro", ["way, mm", "push over what presses it down"], false),
    (
        "snaking",
        "A wire that is pushed along the floor of a tube",
        ["push over √(EI w/r)", "angle up the wall, rad"],
        false,
    ),
    ("helix-onset", "A snake goes over into a helix", ["push over √(EI w/r)", "turns about the axis"], false),
    ("helix", "Pitch of a pushed wire", ["F r² / EI", "pitch over the clearance"], false),
    ("helix-wall", "What a pushed wire presses on the wall with", ["F r² / EI", "n r³ / EI"], false),
    ("return", "The tip on its way in and out", ["x, mm", "y, mm"], false),
    ("balance", "Wall force while a wire is steered", ["time, s", "sum over the wall, mN"], false),
    ("refinement", "Wall force on the way into a bend", ["length fed in, mm", "sum over the wall, mN"], false),
    ("self-contact", "Two pieces of a wire that cross", ["", ""], false),
    ("orders", "A vessel in five other orders", ["", ""], false),
    ("free-bar", "A free bar swings", ["time over the period", "bow, mm"], false),
    ("settled", "A force at a tip", ["", ""], false),
    ("step-size", "Steps of other lengths", ["", ""], false),
    ("readout-weight", "A wire that hangs along itself", ["", ""], false),
    (
        "readout-bend",
        "Pull and push through half a turn, as told",
        ["coefficient of friction", "over that at the tip"],
        false,
    ),
    ("readout-snaking", "Snaking, as told", ["push over √(EI w/r)", "angle up the wall, rad"], false),
    (
        "readout-whip",
        "Torque of a bent wire in a bent tube, as told",
        ["turn at the guide, degrees", "torque, N mm"],
        false,
    ),
    ("readout-sleeve", "Push of a wire that is bent at the mouth", ["length outside the guide, mm", "push, N"], false),
    ("readout-work", "Work of the hand", ["length outside the guide, mm", "push over EI, 1/mm²"], false),
    ("readout-mouth", "Deflection as it is fed", ["length outside the guide, mm", "deflection, mm"], false),
    ("turned", "A loaded rod that is turned", ["", ""], false),
    ("vessel", "A vessel in another order, and turned", ["", ""], false),
    ("felt-free", "A free wire in a hand that sways at 2 Hz", ["Hz", "amplitude felt, mN"], true),
    ("felt-push", "Push in the aorta, fed at 20 mm/s", ["Hz", "amplitude, mN"], true),
    ("felt-torque", "Torque in the aorta, rolled at 1 rad/s", ["Hz", "amplitude, N mm"], true),
];

/// Runs, draws and tabulates.
pub(crate) fn validation() -> Result<()> {
    let folder = target().join("validation");
    let mut tests = cargo();
    tests.args(["test", "--release", "--no-default-features", "--test", "validation"]).env("LUMEN_VALIDATION", &folder);
    step("Run the wire's benchmarks", || run(&mut tests))?;
    let pictures = root().join("docs/images/validation");
    std::fs::create_dir_all(&pictures).with_context(|| format!("{} cannot be made", pictures.display()))?;
    let mut all = "benchmark,what,analytic,ours,difference,tolerance,elements\n".to_owned();
    let mut summary = "| benchmark | values | difference | tolerance |\n|---|---:|---|---|\n".to_owned();
    for (name, title, axes, is_logarithmic) in BENCHMARKS {
        let plot = Plot { title, axes, is_logarithmic, series: series(&read(&folder, name, "points")?)? };
        let answers = answers(&read(&folder, name, "rows")?)?;
        answers.iter().for_each(|answer| all += &answer.row(name));
        summary += &summarised(title, &answers);
        if !plot.series.is_empty() {
            let file = pictures.join(format!("{name}.svg"));
            std::fs::write(&file, plot.drawn()).with_context(|| format!("{} cannot be written", file.display()))?;
        }
    }
    std::fs::write(root().join("docs/validation.csv"), all).context("docs/validation.csv cannot be written")?;
    document::replace("docs/validation.md", "results", &summary)
}

/// What a benchmark wrote.
fn read(folder: &Path, name: &str, what: &str) -> Result<String> {
    let file = folder.join(format!("{name}.{what}.csv"));
    std::fs::read_to_string(&file).with_context(|| format!("{} cannot be read", file.display()))
}

/// The columns of each line but the first.
fn cells<const N: usize>(csv: &str) -> Result<Vec<[&str; N]>> {
    let columns = |line| {
        let cells: Vec<&str> = str::split(line, ',').collect();
        <[&str; N]>::try_from(cells).map_err(|cells| anyhow!("{line}: {} columns instead of {N}", cells.len()))
    };
    csv.lines().skip(1).map(columns).collect()
}

/// A value that a benchmark compares.
struct Answer {
    what: String,
    expected: f64,
    found: f64,
    tolerance: String,
    elements: String,
}

impl Answer {
    /// In percent of the analytic value, or absolute where that is 0.
    fn difference(&self) -> f64 {
        if self.expected == 0.0 { self.found.abs() } else { 100.0 * (self.found / self.expected - 1.0) }
    }

    /// A row of `docs/validation.csv`.
    fn row(&self, benchmark: &str) -> String {
        let [expected, found] = [self.expected, self.found].map(plot::rounded);
        let cells = [benchmark, &self.what, &expected, &found, &self.told(), &self.tolerance, &self.elements];
        cells.map(|cell| document::field(&cell.replace("**", ""))).join(",") + "\n"
    }

    fn told(&self) -> String {
        if self.expected == 0.0 { format!("{:.1e}", self.found) } else { format!("{:+.3} %", self.difference()) }
    }
}

fn answers(csv: &str) -> Result<Vec<Answer>> {
    let answer = |[what, expected, found, tolerance, elements]: [&str; 5]| {
        let [what, tolerance, elements] = [what, tolerance, elements].map(str::to_owned);
        Ok(Answer { what, expected: expected.parse()?, found: found.parse()?, tolerance, elements })
    };
    cells(csv)?.into_iter().map(answer).collect()
}

/// A line for each tolerance: how many values it holds for, and the least and largest difference.
fn summarised(title: &str, answers: &[Answer]) -> String {
    let mut groups: Vec<Vec<&Answer>> = Vec::new();
    for answer in answers {
        let is_alike = |group: &Vec<&Answer>| {
            group[0].tolerance == answer.tolerance && (group[0].expected == 0.0) == (answer.expected == 0.0)
        };
        match groups.iter_mut().find(|group| is_alike(group)) {
            Some(group) => group.push(answer),
            None => groups.push(vec![answer]),
        }
    }
    let mut text = String::new();
    for mut group in groups {
        group.sort_by(|a, b| a.difference().total_cmp(&b.difference()));
        let [least, most] = [group[0], group[group.len() - 1]].map(Answer::told);
        let told = match group.len() {
            1 => most,
            _ if group[0].expected == 0.0 => format!("at most {most}"),
            _ => format!("{} to {most}", least.trim_end_matches(" %")),
        };
        let _ = writeln!(text, "| {title} | {} | {told} | {} |", group.len(), group[0].tolerance);
    }
    text
}

fn series(csv: &str) -> Result<Vec<Series>> {
    let mut all: Vec<Series> = Vec::new();
    for [name, kind, x, y] in cells(csv)? {
        let point = [x.parse()?, y.parse()?];
        let kind = match kind {
            "points" => Kind::Points,
            "line" => Kind::Line,
            "mark" => Kind::Mark,
            _ => bail!("a series is no {kind}"),
        };
        match all.iter_mut().find(|series| series.name == name) {
            Some(series) => series.points.push(point),
            None => all.push(Series { name: name.to_owned(), kind, points: vec![point] }),
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_says_how_far_off_it_is() {
        let text = "what,analytic,ours,tolerance,elements\nload,2,2.01,1 %,80\nlower load,2,1.99,1 %,80\ngap,0,0.001,1e-2,80\n";
        let found = answers(text).unwrap();
        assert_eq!(found[0].row("beam"), "beam,load,2.0000,2.0100,+0.500 %,1 %,80\n");
        assert_eq!(found[2].row("beam"), "beam,gap,0,0.0010000,1.0e-3,1e-2,80\n");
        let summary = "| Beam | 2 | -0.500 to +0.500 % | 1 % |\n| Beam | 1 | 1.0e-3 | 1e-2 |\n";
        assert_eq!(summarised("Beam", &found), summary);
        assert!(answers("head\nload,2\n").is_err());
    }

    #[test]
    fn points_of_one_name_are_one_series() {
        let all = series("series,kind,x,y\nours,points,1,2\nexact,line,0,0\nours,points,2,3\n").unwrap();
        assert_eq!(all.len(), 2);
        assert_eq!(all[0].points, [[1.0, 2.0], [2.0, 3.0]]);
        assert!(series("head\nours,dots,1,2\n").is_err());
    }
}
