//! `cargo xtask validation`: runs the wire's benchmarks, draws each and writes their answers into `docs/validation.md`.

mod plot;

use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context as _, Result, anyhow, bail};

use self::plot::{Kind, Plot, Series};
use crate::document;
use crate::step::{cargo, root, run, step, target};

/// A benchmark, and what its plot shows: name, title, axes, whether both are logarithmic.
const BENCHMARKS: [(&str, &str, [&str; 2], bool); 38] = [
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
    for (name, title, axes, is_logarithmic) in BENCHMARKS {
        let plot = Plot { title, axes, is_logarithmic, series: series(&read(&folder, name, "points")?)? };
        let mut text = table(&read(&folder, name, "rows")?)?;
        if !plot.series.is_empty() {
            let file = pictures.join(format!("{name}.svg"));
            std::fs::write(&file, plot.drawn()).with_context(|| format!("{} cannot be written", file.display()))?;
            let _ = write!(text, "\n![{title}](images/validation/{name}.svg)\n");
        }
        document::replace_in("docs/validation.md", name, &text)?;
    }
    Ok(())
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

fn table(csv: &str) -> Result<String> {
    let mut text =
        "| what | analytic | ours | difference | tolerance | elements |\n|---|---|---|---|---|---|\n".to_owned();
    for [what, analytic, ours, tolerance, elements] in cells(csv)? {
        let [expected, found]: [f64; 2] = [analytic.parse()?, ours.parse()?];
        let difference = if expected == 0.0 {
            format!("{found:.1e}")
        } else {
            format!("{:+.3} %", 100.0 * (found / expected - 1.0))
        };
        let _ = writeln!(
            text,
            "| {what} | {} | {} | {difference} | {tolerance} | {elements} |",
            plot::rounded(expected),
            plot::rounded(found)
        );
    }
    Ok(text)
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
        let text = table("what,analytic,ours,tolerance,elements\nload,2,2.01,1 %,80\ngap,0,0.001,1e-2,80\n").unwrap();
        assert!(text.contains("| load | 2.0000 | 2.0100 | +0.500 % | 1 % | 80 |"), "{text}");
        assert!(text.contains("| gap | 0 | 0.0010000 | 1.0e-3 | 1e-2 | 80 |"), "{text}");
        assert!(table("head\nload,2\n").is_err());
    }

    #[test]
    fn points_of_one_name_are_one_series() {
        let all = series("series,kind,x,y\nours,points,1,2\nexact,line,0,0\nours,points,2,3\n").unwrap();
        assert_eq!(all.len(), 2);
        assert_eq!(all[0].points, [[1.0, 2.0], [2.0, 3.0]]);
        assert!(series("head\nours,dots,1,2\n").is_err());
    }
}
