"""An audit of the reduction rate that Lumen marks as safe, and of the next one above, into docs/benchmarks/calibre.md.

    python audit.py [NAME...]

The way of each vessel is Lumen's centreline; everything else is made here: VTK's cutter cuts the opened surface and the
reduced ones in planes across it, moved to the middle of what was cut; where a vessel ends or meets another is found from
the distances between centrelines. With names, only surfaces whose name holds one of them are audited.
"""
import csv
import sys
import tempfile
from pathlib import Path

import numpy as np
import vtk
from scipy.spatial import cKDTree
from vtk.util.numpy_support import vtk_to_numpy

from quality import polydata, volume
from real import crossing, read
from sections import DATA, TWO_VESSELS, document, largest_piece, lumen, mean_edge, optimise, stretch_radii, write_ply
from trees import stenosis, stepped

REAL = ["aorta-surface-open-ends.stl", "aorta-surface-segment-2.stl", "beamadapter_carotids.stl", "beamadapter_phantom.obj",
        "steve_mechanical_thrombectomy.obj", "steve_vessel_architecture.obj", "vampy_artery_C0015.vtp",
        "vmr_kawasaki_aorta_coronaries.vtp", "vmtk_aorta_mra_iso1000.ply", "vmtk_aorta_mra_iso800.stl"]
#: Percent of the radius that a vessel may change by; the rate above is this much higher, in percent.
TOLERANCE, NEXT = 2.0, 0.1


def surfaces():
    """(name, what Lumen is to open, given a folder)."""
    yield from ((f"sample:{name}", lambda _, name=name: f"sample:{name}") for name in ["aorta", "coronary"])

    def stored(surface, folder):
        file = Path(folder) / "opened.ply"
        write_ply(file, surface)
        return file

    for name in REAL:
        yield name, lambda folder, name=name: stored(read(DATA / "real" / name), folder)
    for phantom in [stepped(), stenosis(6)]:
        yield (f"{phantom.name}, voxels of 0.5 mm",
               lambda folder, phantom=phantom: stored(largest_piece(*phantom.masked(0.5))[0], folder))


class VtkCuts:
    """Sections by vtkCutter: the loop around a point, its area and centroid."""

    def __init__(self, P, F, edge=None):
        self.P, self.F, self.edge = P, F, edge or mean_edge(P, F)
        self.plane, self.cutter, self.strips = vtk.vtkPlane(), vtk.vtkCutter(), vtk.vtkStripper()
        data = polydata(P, F)
        data.BuildCells()
        # Only what lies in a box around the station is cut.
        self.box, near = vtk.vtkBox(), vtk.vtkExtractPolyDataGeometry()
        near.SetInputData(data)
        near.SetImplicitFunction(self.box)
        near.ExtractBoundaryCellsOn()
        self.cutter.SetInputConnection(near.GetOutputPort())
        self.cutter.SetCutFunction(self.plane)
        self.strips.SetInputConnection(self.cutter.GetOutputPort())
        self.strips.JoinContiguousSegmentsOn()
        self.strips.SetMaximumLength(1_000_000)

    def along(self, points, radius):
        """The part that sections of up to `radius` around `points` can reach, alone: it is cut sooner."""
        middle = self.P[self.F].mean(1)
        reach = 6 * radius + 12 * self.edge + np.linalg.norm(self.P[self.F] - middle[:, None], axis=2).max(1)
        far = cKDTree(points).query(middle)[0]
        return VtkCuts(self.P, self.F[far < reach], self.edge)

    def loop(self, point, normal, radius):
        """Area and centroid of the smallest closed loop around `point`; None where there is none."""
        reach = 3 * radius + 6 * self.edge
        self.box.SetBounds(*np.stack([point - reach, point + reach], 1).ravel())
        self.plane.SetOrigin(*point)
        self.plane.SetNormal(*normal)
        self.strips.Update()
        lines, best = self.strips.GetOutput().GetLines(), None
        if not lines.GetNumberOfCells():
            return None
        points = vtk_to_numpy(self.strips.GetOutput().GetPoints().GetData()).astype(float) - point
        offsets, ids = (vtk_to_numpy(a) for a in [lines.GetOffsetsArray(), lines.GetConnectivityArray()])
        for start, end in zip(offsets, offsets[1:]):
            chain = ids[start:end]
            if chain[0] != chain[-1] or len(chain) < 4:
                continue
            p, q = points[chain[:-1]], points[chain[1:]]
            turn = np.cross(p, q) @ normal
            if abs(np.arctan2(turn, np.einsum("ij,ij->i", p, q)).sum()) < np.pi:
                continue
            area = abs(turn.sum()) / 2
            if best is None or area < best[0]:
                best = area, point + ((p + q) * turn[:, None]).sum(0) / (3 * turn.sum())
        return best


def centrelines(file, folder):
    """Points, arc lengths and radii of each of Lumen's lines, at most 1 mm apart."""
    table, lines = Path(folder) / "lines.csv", {}
    lumen("centreline", file, "-o", table)
    for row in csv.DictReader(table.open()):
        lines.setdefault(int(row["branch"]), []).append([float(row[key]) for key in ["x_mm", "y_mm", "z_mm", "inscribed_radius_mm"]])
    return {branch: np.array(rows) for branch, rows in lines.items() if len(rows) > 4}


def directions(points, along, radius):
    """Of the chord over a diameter around each point."""
    at = lambda s: np.stack([np.interp(s, along, x) for x in points.T], 1)  # noqa: E731
    chord = at(along + radius) - at(along - radius)
    return chord / np.maximum(np.linalg.norm(chord, axis=1), 1e-12)[:, None]


def stations(lines, opened):
    """Of each line: points, directions, radii and arc lengths on the opened surface, and whether each counts."""
    found = {}
    for branch, rows in lines.items():
        points, radius = rows[:, :3].copy(), float(np.median(rows[:, 3]))
        cuts = opened.along(points, rows[:, 3].max())
        for step in range(2):
            along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
            across = directions(points, along, max(radius, 2 * opened.edge))
            loops = [cuts.loop(*station) for station in zip(points, across, np.maximum(rows[:, 3], radius))]
            for i, loop in enumerate(loops):
                # To the middle of the section, where that is one vessel.
                if step == 0 and loop and np.linalg.norm(loop[1] - points[i]) < 0.5 * rows[i, 3]:
                    points[i] = loop[1]
        areas = np.array([loop[0] if loop else np.nan for loop in loops])
        radii = np.where(np.isnan(areas), rows[:, 3], np.sqrt(areas / np.pi))
        found[branch] = dict(points=points, across=across, along=along, areas=areas, radii=radii, inside=rows[:, 3])
    for branch, one in found.items():
        radii, along = one["radii"], one["along"]
        counts = ~np.isnan(one["areas"]) & (along > radii) & (along < along[-1] - radii) & (2 * radii >= 2 * opened.edge)
        for other, two in found.items():
            if other != branch:
                gap = np.linalg.norm(one["points"][:, None] - two["points"][None], axis=2) - two["inside"]
                counts &= gap.min(1) > 1.5 * radii
        one["counts"] = counts & (radii < TWO_VESSELS * one["inside"])
    return found


def worst(found, areas, edge, leave_out, where="counts"):
    """The largest change of a stretch's radius in percent, and how many stations no longer close."""
    most, lost = 0.0, 0
    for branch, one in found.items():
        here = one["counts"] & one[where]
        if branch in leave_out or not here.any():
            continue
        lost += int(np.isnan(areas[branch][here]).sum())
        # Of the same sections on both. Beside a fork, where none is judged, a cut may go around one vessel on one surface and
        # around two on the other: those are not the same.
        closed = np.isfinite(one["areas"] + areas[branch])
        with np.errstate(invalid="ignore", divide="ignore"):
            apart = np.abs(np.log(areas[branch] / one["areas"])) > 2 * np.log(TWO_VESSELS)
            apart &= np.sqrt(np.fmax(areas[branch], one["areas"]) / np.pi) > TWO_VESSELS * one["inside"]
        closed &= one["counts"] | ~apart
        both = [stretch_radii(one["along"], np.where(closed, of, np.nan), one["radii"], edge)
                for of in [one["areas"], areas[branch]]]
        change = np.nan_to_num(100 * (both[1] / both[0] - 1)[here])
        most = max(most, float(change[np.abs(change).argmax()]), key=abs)
    return most, lost


def cut_again(found, cuts):
    """Areas on another surface, in the same planes."""
    areas = {}
    for branch, one in found.items():
        near = cuts.along(one["points"], one["radii"].max())
        loops = [near.loop(*station) for station in zip(one["points"], one["across"], one["radii"])]
        areas[branch] = np.array([loop[0] if loop else np.nan for loop in loops])
    return areas


def mark_counted(found, report):
    """Says of each station whether Lumen's own nearest one counts."""
    of = report["branches"]
    tree = cKDTree(np.concatenate([branch["at_mm"] for branch in of]))
    standings = np.array([standing for branch in of for standing in branch["standings"]])
    for one in found.values():
        one["lumen"] = standings[tree.query(one["points"])[1]] == "counts"


def row(name, make):
    with tempfile.TemporaryDirectory() as folder:
        file = make(folder)
        opened, _ = optimise(file, folder, "--smoothing", "none", "--reduction", 0)
        smoothed, _ = optimise(file, folder, "--reduction", 0)
        try:
            at_safe, report = optimise(file, folder, "--reduction", "safe", "--branches")
        except RuntimeError as error:
            return f"| {name} | none | | | | | | | | | {error} | |"
        safe = report["safe"]
        above, _ = optimise(file, folder, "--reduction", f"{safe['percent'] + NEXT:.1f}")
        lines = centrelines(file, folder)
    first = VtkCuts(*opened)
    found = stations(lines, first)
    mark_counted(found, report)
    changed = {branch["number"] for branch in safe["branches"] if branch["changed_by_smoothing"]}
    crossed, rows = crossing(*smoothed).sum(), []
    for surface in [at_safe, above]:
        areas = cut_again(found, VtkCuts(*surface))
        both = [worst(found, areas, first.edge, changed, where) for where in ["lumen", "counts"]]
        rows.append((*both, int(crossing(*surface).sum() - crossed)))
    here, there = rows
    own = [b["reduced"]["largest_change"]["percent"] for b in report["branches"]
           if b["number"] not in changed and b["reduced"]["largest_change"]]
    judged = sum(int(one["counts"].sum()) for branch, one in found.items() if branch not in changed)
    told = lambda found: f"{found[0]:+.2f}" + (f", {found[1]} no longer close" if found[1] else "")  # noqa: E731
    over, beside = (abs(found[0]) - TOLERANCE for found in here[:2])
    says = "not audited: vessels of less than two edges" if not judged else "holds" if over <= 0 else f"**over by {over:.3f}**"
    # A vessel that the plane no longer cuts around its line has lost its calibre there.
    says = f"**{here[0][1]} no longer close**" if here[0][1] else says
    says += f"; {beside:.2f} over where Lumen does not look" if beside > max(over, 0) else ""
    cells = [f"{name}" + (f" ({len(changed)} of {len(safe['branches'])} branches left out)" if changed else ""),
             f"{safe['percent']:.1f}", f"{judged}", f"{max(own, key=abs):+.2f}" if own else "–",
             told(here[0]), told(here[1]), told(there[0]), told(there[1]),
             f"{here[2]:+d}, {there[2]:+d}", f"{100 * (volume(*at_safe) / volume(*smoothed) - 1):+.2f}",
             (safe["stopped_by"] or "nothing").split(", at (")[0], says]
    print(cells, here, there, file=sys.stderr, flush=True)
    return "| " + " | ".join(cells) + " |"


HEAD = """| surface | marked, % | stations audited | largest change there: Lumen says | by the audit, where Lumen counts | everywhere | at the next rate, likewise | everywhere | newly crossing, there and at the next | volume from smoothed, % | what stops it, as Lumen says | the mark |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|---|"""


def main(names):
    chosen = [(name, make) for name, make in surfaces() if not names or any(part in name for part in names)]
    text = "\n".join([HEAD, *(row(f"`{name}`" if "voxels" not in name else name, make) for name, make in chosen)])
    print(text) if names else document("benchmarks/calibre.md", "audit", text)


if __name__ == "__main__":
    main(sys.argv[1:])
