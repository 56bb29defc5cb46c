"""Cross-sections of surfaces along a centreline, cut by this code alone, and the programs whose surfaces are cut.

A section is the closed loop around a point in the plane across a direction; its radius is that of the circle of its
area. None of it is Lumen's: planes through triangles, with NumPy and SciPy.
"""
import csv
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import vtk
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from quality import arrays, polydata, read_ply

ROOT = Path(__file__).resolve().parents[2]
#: The program that is measured, and the folder of the test meshes: as everywhere in this repository.
PROGRAM = os.environ.get("LUMEN_PROGRAM", str(ROOT / "target/release/lumen"))
DATA = Path(os.environ.get("LUMEN_DATA", ROOT / "../shared/data"))
#: The paper's setting: pass band and iterations, Hamming window.
PAPER = (0.01, 100)
#: A section so many times as wide as its vessel goes around two.
TWO_VESSELS = 1.6


def lumen(*arguments):
    """What the program warns of."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if run.returncode:
        raise RuntimeError(run.stderr.strip().splitlines()[-1] if run.stderr.strip() else f"status {run.returncode}")
    return [line for line in run.stderr.splitlines() if not line.endswith(": done")]


def optimise(file, folder, *options):
    """The surface that `lumen optimise` makes, and its report with the warnings."""
    output, report = Path(folder) / "lumen.ply", Path(folder) / "lumen.json"
    warnings = lumen("optimise", file, "-o", output, "--report", report, *options)
    return read_ply(output), json.loads(report.read_text()) | dict(warnings=warnings)


def windowed_sinc(surface, pass_band, iterations, window="Hamming", normalise=False):
    """vtkWindowedSincPolyDataFilter; without a window, VTK's own."""
    step = vtk.vtkWindowedSincPolyDataFilter()
    step.SetInputData(polydata(*surface))
    step.SetPassBand(pass_band)
    step.SetNumberOfIterations(iterations)
    step.SetNormalizeCoordinates(normalise)
    if window:
        getattr(step, f"SetWindowFunctionTo{window}")()
    step.Update()
    return arrays(step.GetOutput())


def write_ply(path, surface):
    writer = vtk.vtkPLYWriter()
    writer.SetFileTypeToBinary()
    writer.SetFileName(str(path))
    writer.SetInputData(polydata(*surface))
    writer.Write()


def largest_piece(P, F):
    """The piece of most triangles, and how many pieces there are."""
    graph = coo_matrix((np.ones(len(F) * 2), (F[:, [0, 1]].ravel("F"), F[:, [1, 2]].ravel("F"))), shape=(len(P), len(P)))
    _, label = connected_components(graph, directed=False)
    of = label[F[:, 0]]
    pieces = np.bincount(of)
    used, corners = np.unique(F[of == pieces.argmax()], return_inverse=True)
    return (P[used], corners.reshape(-1, 3)), int((pieces > 0).sum())


def mean_edge(P, F):
    return float(np.mean([np.linalg.norm(P[F[:, i]] - P[F[:, i - 1]], axis=1).mean() for i in range(3)]))


class Cuts:
    """A surface, ready to be cut."""

    def __init__(self, P, F):
        self.P, self.F, self.edge = P, F, mean_edge(P, F)
        self.tree = cKDTree(P[F].mean(1))

    def area(self, point, normal, radius):
        """Area of the loop around `point` in the plane across `normal`; NaN where none closes within some `radius`."""
        near = self.F[self.tree.query_ball_point(point, 3 * radius + 6 * self.edge)]
        height = (self.P[near.ravel()] - point).reshape(-1, 3, 3) @ normal
        above = height > 0
        cut = above.any(1) & ~above.all(1)
        near, height, above = near[cut], height[cut], above[cut]
        if not len(near):
            return np.nan
        # The two sides that the plane goes through: in along the one, out along the other, as the winding has it.
        ends = []
        for into in [True, False]:
            side = np.argmax((above != np.roll(above, -1, axis=1)) & (above == into), axis=1)
            rows, other = np.arange(len(near)), (side + 1) % 3
            a, b, ha, hb = near[rows, side], near[rows, other], height[rows, side], height[rows, other]
            # From the lower number, so that both triangles of a side find the same point.
            key = np.minimum(a, b) * len(self.P) + np.maximum(a, b)
            ends.append((key, self.P[a] + (self.P[b] - self.P[a]) * (ha / (ha - hb))[:, None] - point))
        (first, p), (second, q) = ends
        keys, nodes = np.unique(np.concatenate([first, second]), return_inverse=True)
        first, second = nodes[: len(p)], nodes[len(p):]
        graph = coo_matrix((np.ones(len(p)), (first, second)), shape=(len(keys), len(keys)))
        loops, label = connected_components(graph, directed=False)
        closed = np.ones(loops, bool)
        np.logical_and.at(closed, label, np.bincount(nodes, minlength=len(keys)) == 2)
        of, turn = label[first], np.cross(p, q) @ normal
        angle = np.arctan2(turn, np.einsum("ij,ij->i", p, q))
        around = np.abs(np.bincount(of, angle, loops)) > np.pi
        areas = np.abs(np.bincount(of, turn, loops)) / 2
        found = areas[closed & around]
        return float(found.min()) if len(found) else np.nan

    def areas(self, points, normals, radii):
        return np.array([self.area(*station) for station in zip(points, normals, radii)])


def stretch_radii(along, areas, radii, edge):
    """Radius of the circle of the mean area over a stretch as long as the vessel is wide, or eight edges.

    The mean is weighted by 1 - |s - t| / half the stretch; where more of the vessel is on one side than on the other, the
    line of least squares stands for it, so that a taper does not tell.
    """
    found = np.full(len(along), np.nan)
    for i, (s, r) in enumerate(zip(along, radii)):
        if np.isnan(areas[i]):
            continue
        half = max(r, 4 * edge)
        weight = np.where(np.isnan(areas), 0, np.maximum(0, 1 - np.abs(along - s) / half))
        t, a = along - s, np.where(np.isnan(areas), 0, areas)
        w, wt, wtt = weight.sum(), (weight * t).sum(), (weight * t * t).sum()
        wa, wta = (weight * a).sum(), (weight * t * a).sum()
        level = (wtt * wa - wt * wta) / (w * wtt - wt * wt) if w * wtt - wt * wt > 1e-12 * w * w else wa / w
        found[i] = np.sqrt(max(level, 0) / np.pi)
    return found


def document(page, name, text):
    """Puts `text` between the marks of `name` in a page under docs/, as `cargo xtask` does."""
    file, mark, end = ROOT / "docs" / page, f"<!-- generated: {name} -->\n", "<!-- end -->"
    before, rest = file.read_text().split(mark, 1)
    file.write_text(f"{before}{mark}\n{text.strip()}\n\n{end}{rest.split(end, 1)[1]}")


def write_rows(page, lines):
    """Writes the rows of a Markdown table as a CSV file under docs/."""
    with open(ROOT / "docs" / page, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for line in (line for line in lines if set(line) - set("|-: ")):
            writer.writerow(cell.strip().replace("**", "").replace("`", "") for cell in line.strip()[1:-1].split("|"))
