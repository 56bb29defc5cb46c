"""Calibre of phantoms of known radius after Lumen's smoothing and after VTK's, into docs/benchmarks/phantoms.csv
and docs/benchmarks/calibre.md.

    python phantoms.py [NAME...]

Python is one with requirements.txt (`cargo xtask peers` makes it: target/peers/venv); LUMEN_PROGRAM names the program if
it is not target/release/lumen. With names, only phantoms whose name holds one of them are measured, and the table is
printed alone. What was found is in target/peers/phantoms.json too, which `pictures.py` draws.
"""
import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from sections import PAPER, ROOT, TWO_VESSELS, Cuts, document, largest_piece, optimise, stretch_radii, windowed_sinc, write_ply, write_rows
from trees import NARROW, cone, sample, stenosis, stepped, tube

VOXELS = [0.3, 0.5, 0.7]
DIAMETERS = [1, 2, 3, 5, 10, 20, 30]
#: What is asked of a vessel of three voxels or more: percent of its radius, and part of a voxel.
PERCENT, OF_VOXEL, WIDE = 1.0, 0.1, 3.0
SURFACES = ["opened", "lumen", "vtk"]


def phantoms():
    yield from map(tube, DIAMETERS)
    yield stepped()
    yield from [stenosis(6), stenosis(3.5)]
    yield from [cone(12, 3, 60), cone(6, 2, 40)]
    yield from map(sample, ["aorta", "coronary"])


def measured(phantom, voxel, folder):
    """Radii along each line on the opened and on both smoothed surfaces, and what Lumen says of itself."""
    opened, pieces = largest_piece(*phantom.masked(voxel))
    file = Path(folder) / "phantom.ply"
    write_ply(file, opened)
    smoothed, report = optimise(file, folder, "--smoothing", "auto", "--reduction", 0, "--branches")
    surfaces = [Cuts(*surface) for surface in [opened, smoothed, windowed_sinc(opened, *PAPER)]]
    found = dict(name=phantom.name, voxel=voxel, triangles=len(opened[1]), pieces=pieces, certificate=certificate(report, phantom.lines),
                 warnings=report["warnings"], lines=[])
    for line in phantom.lines:
        row = dict(name=line.name, along=line.along.tolist(), truth=line.radii.tolist(), counts=line.counts.tolist())
        cut = [cuts.areas(line.points, line.directions, line.radii) for cuts in surfaces]
        # Beside a fork, where nothing is judged, a cut may go around two vessels, and on another surface around one: such are of
        # no vessel, and on none a part of the stretch of the next station.
        with np.errstate(invalid="ignore"):
            two = ~line.counts.astype(bool) & (np.sqrt(np.fmax.reduce(cut) / np.pi) > TWO_VESSELS * line.radii)
        # The truth too, over the same stretches: a narrow place is no wider for being measured.
        truth = np.where(two, np.nan, np.pi * line.radii**2)
        row["stretched"] = stretch_radii(line.along, truth, line.radii, surfaces[0].edge).tolist()
        for name, areas in zip(SURFACES, cut):
            areas = np.where(two, np.nan, areas)
            row[name] = stretch_radii(line.along, areas, line.radii, surfaces[0].edge).tolist()
            row[f"{name}_single"] = np.sqrt(areas / np.pi).tolist()
        found["lines"].append(row)
    return found


def certificate(report, lines):
    """The largest change by smoothing that Lumen certifies, in percent: beside stations that are judged here, and anywhere."""
    tree = cKDTree(np.concatenate([line.points for line in lines]))
    judged = np.concatenate([line.counts for line in lines])
    there, anywhere = [], []
    for branch in report["branches"]:
        stations = zip(branch["standings"], branch["opened"]["radii_mm"], branch["smoothed"]["radii_mm"], branch["at_mm"])
        for standing, opened, smoothed, at in stations:
            if standing == "counts":
                anywhere.append(100 * (smoothed / opened - 1))
                there += anywhere[-1:] if judged[tree.query(at)[1]] else []
    return [max(changes, key=abs) if changes else None for changes in [there, anywhere]]


def errors(rows, over, under, keep=lambda truth: truth > 0, single=False):
    """Percent and mm by which radii differ at the stations that count; where a vessel is gone it is -100 %."""
    parts = []
    for row in rows:
        line = {key: np.array(value, float) for key, value in row.items() if key != "name"}
        a, b = (line[key] if single is False else line[f"{key}_single"] if key != "stretched" else line["truth"]
                for key in [over, "stretched" if under == "truth" else under])
        here = line["counts"].astype(bool) & keep(line["truth"]) & ~np.isnan(line["opened"])
        a = np.where(np.isnan(a), 0, a)[here]
        parts.append((100 * (a / b[here] - 1), a - b[here]))
    return tuple(np.concatenate(part) for part in zip(*parts))


def told(pair):
    """Mean and worst in percent."""
    percent, _ = pair
    return f"{percent.mean():+.2f}, {worst(percent):+.2f}" if len(percent) else "–"


def worst(values):
    return values[np.abs(values).argmax()]


def verdict(pair, voxel, across):
    """Of the bound, at every station: met, or which part of it is missed and by what."""
    percent, mm = pair
    if not len(percent) or across < WIDE - 1e-9:
        return "not asked"
    missed = []
    if np.abs(percent).max() > PERCENT:
        missed.append(f"{np.abs(percent).max():.1f} %")
    if np.abs(mm).max() > OF_VOXEL * voxel:
        missed.append(f"{np.abs(mm).max() / voxel:.2f} voxel")
    return f"**missed**: {', '.join(missed)}" if missed else "met"


def table_row(found, title, across, certified, keep=lambda truth: truth > 0):
    rows, voxel = found["lines"], found["voxel"]
    truth = {name: errors(rows, name, "truth", keep) for name in SURFACES}
    change = {name: errors(rows, name, "opened", keep) for name in SURFACES[1:]}
    cells = [title, f"{voxel}", across if isinstance(across, str) else f"{across:.1f}", told(truth["opened"]),
             told(truth["lumen"]), told(truth["vtk"]), told(change["lumen"]), told(change["vtk"]),
             ", ".join("–" if change is None else f"{change:+.2f}" for change in certified)]
    least = across if not isinstance(across, str) else float(across.split()[0])
    cells += [verdict(change["lumen"], voxel, least), verdict(truth["lumen"], voxel, least)]
    return "| " + " | ".join(cells) + " |"


HEAD = """| vessel | voxel mm | voxels across | opened, against the truth | Lumen, against the truth | VTK, against the truth | Lumen, against opened | VTK, against opened | Lumen's certificate: there, anywhere | bound, against opened | bound, against the truth |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---|---|"""

#: Least and most voxels across of the classes that the samples' vessels are told in.
CLASSES = [(0, 3), (3, 6), (6, np.inf)]


def rows_of(found):
    voxel, name = found["voxel"], found["name"]
    if found["pieces"] > 1 and not name.startswith("sample"):
        return [f"| {name} | {voxel} | | the mask is in {found['pieces']} pieces |" + " |" * 7]
    truth = np.concatenate([np.array(row["truth"])[row["counts"]] for row in found["lines"]]) * 2 / voxel
    if not name.startswith("sample"):
        across = truth[0] if np.ptp(truth) < 1e-9 else f"{truth.min():.1f} to {truth.max():.1f}"
        return [table_row(found, name, across, found["certificate"])]
    rows = []
    for low, high in CLASSES:
        here = truth[(truth >= low) & (truth < high)]
        if len(here):
            keep = lambda r, low=low, high=high: (2 * r / voxel >= low) & (2 * r / voxel < high)  # noqa: E731
            certified = [] if rows else found["certificate"]
            across = f"{here.min():.1f} to {here.max():.1f}"
            rows.append(table_row(found, f"`{name}`, {len(here)} stations", across, certified, keep))
    return rows


def degree(row, name):
    """Of a stenosis, by diameter, in percent: areas in the middle half of the narrow place against those outside."""
    along, radii = np.array(row["along"]), np.array(row["truth"] if name == "truth" else row[f"{name}_single"])
    middle = np.abs(along - along[-1] / 2)
    counts = np.array(row["counts"])
    narrow, wide = radii[middle < NARROW / 4], radii[counts & (np.array(row["truth"]) > 0.999 * max(row["truth"]))]
    if np.isnan(narrow).any() or np.isnan(wide).any():
        return np.nan
    return 100 * (1 - np.sqrt((narrow**2).mean() / (wide**2).mean()))


def stenoses(all_found):
    lines = ["| vessel | voxel mm | voxels across where it is narrowest | true | opened | Lumen | VTK | Lumen within 2 points of opened | of the truth |",
             "|---|---:|---:|---:|---:|---:|---:|---|---|"]
    for found in all_found:
        if not found["name"].startswith("stenosis"):
            continue
        row, voxel = found["lines"][0], found["voxel"]
        truth, opened, ours, theirs = (degree(row, name) for name in ["truth", *SURFACES])
        cell = lambda value: "closed" if np.isnan(value) else f"{value:.1f} %"  # noqa: E731
        says = lambda by: "**missed**: in pieces" if np.isnan(by) else "met" if abs(by) <= 2 else f"**missed**: {by:+.1f}"  # noqa: E731
        across = 2 * min(row["truth"]) / voxel
        if found["pieces"] > 1:
            lines.append(f"| {found['name']} | {voxel} | {across:.1f} | 70.0 % | the mask is in {found['pieces']} pieces |" + " |" * 4)
            continue
        lines.append(f"| {found['name']} | {voxel} | {across:.1f} | {cell(truth)} | {cell(opened)} | {cell(ours)} | {cell(theirs)} | "
                     f"{says(ours - opened)} | {says(ours - truth)} |")
    return "\n".join(lines)


def summary(results, rows):
    """How many rows meet the bound, and the worst that single cross-sections have."""
    asked = [row.rstrip(" |").rsplit(" | ", 2)[1:] for row in rows if "not asked" not in row and "pieces" not in row]
    met = [sum(row[i] == "met" for row in asked) for i in range(2)]
    wide = [found["lines"] for found in results if found["pieces"] == 1 and found["name"].startswith("tube")
            and min(found["lines"][0]["truth"]) * 2 >= WIDE * found["voxel"] - 1e-9]
    single = [max(np.abs(errors(rows, name, "truth", single=True)[0]).max() for rows in wide) if wide else 0
              for name in SURFACES[:2]]
    return (f"The bound is met in {met[0]} of {len(asked)} rows against the opened surface, in {met[1]} against the truth. "
            f"Single cross-sections of the tubes, of three voxels and more, are up to {single[0]:.1f} % off the truth as opened "
            f"and {single[1]:.1f} % after Lumen.")


def main(names):
    results = []
    for phantom in phantoms():
        if names and not any(name in phantom.name for name in names):
            continue
        for voxel in VOXELS:
            with tempfile.TemporaryDirectory() as folder:
                results.append(measured(phantom, voxel, folder))
            print(*rows_of(results[-1]), *results[-1]["warnings"], sep="\n", file=sys.stderr, flush=True)
    rows = [row for found in results for row in rows_of(found)]
    table, text = [*HEAD.splitlines(), *rows], "\n".join([summary(results, rows), "", stenoses(results)])
    if names:
        print(*table, "", text, sep="\n")
        return
    folder = ROOT / "target/peers"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "phantoms.json").write_text(json.dumps(results))
    write_rows("benchmarks/phantoms.csv", table)
    document("benchmarks/calibre.md", "phantoms", text)


if __name__ == "__main__":
    main(sys.argv[1:])
