"""Lumen's centrelines beside those of others: vmtk's of its aorta and carotid, stEVE's 25 curves made in 3D Slicer.

    python benches/peers/centrelines.py LUMEN SURFACE REFERENCE...

A reference is a .vtp with MaximumInscribedSphereRadius or a Slicer curve (.mrk.json) with Radius, in the surface's
coordinates. Printed for each surface: the part of the references' length that has a line of Lumen within its radius
(*found*), the distance and the difference of the inscribed radius there, reference lines of which less than half is
found (*missed*), and branches of which less than half is within the radius of a reference (*invented*, with what share of
Lumen's length they are). References need not be complete: look at what is called invented.
"""
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

STEP = 0.25


def fine(points, radii):
    """A line at places no farther than STEP mm apart."""
    at, radius = [points[:1]], [radii[:1]]
    for i in range(1, len(points)):
        parts = np.arange(1, max(int(np.ceil(np.linalg.norm(points[i] - points[i - 1]) / STEP)), 1) + 1)[:, None]
        parts = parts / parts[-1]
        at.append(points[i - 1] + (points[i] - points[i - 1]) * parts)
        radius.append((radii[i - 1] + (radii[i] - radii[i - 1]) * parts).ravel())
    return np.concatenate(at), np.concatenate(radius)


def reference(path):
    """The lines of a file: points, radii."""
    if path.name.endswith(".json"):
        lines = []
        for curve in json.loads(path.read_text())["markups"]:
            points = np.array([point["position"] for point in curve["controlPoints"]])
            radius = next(m for m in curve["measurements"] if m["name"] == "Radius")
            lines.append((points, np.array(radius["controlPointValues"], float).ravel()))
        return lines
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutput()
    points = vtk_to_numpy(found.GetPoints().GetData())
    radii = vtk_to_numpy(found.GetPointData().GetArray("MaximumInscribedSphereRadius"))
    ids = [found.GetCell(i).GetPointIds() for i in range(found.GetNumberOfCells())]
    ids = [[cell.GetId(j) for j in range(cell.GetNumberOfIds())] for cell in ids]
    return [(points[i], radii[i]) for i in ids]


def branches(lumen, surface):
    """Lumen's, by their numbers."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "lines.csv"
        subprocess.run([lumen, "centreline", surface, "-o", out], check=True, stdout=subprocess.DEVNULL)
        lines = {}
        for row in csv.DictReader(out.open()):
            at = [float(row[name]) for name in ("x_mm", "y_mm", "z_mm", "inscribed_radius_mm")]
            lines.setdefault(row["branch"], []).append(at)
    lines = {name: np.array(line) for name, line in lines.items()}
    return {name: (line[:, :3], line[:, 3]) for name, line in lines.items()}


def main(lumen, surface, *references):
    wanted = [fine(*line) for path in references for line in reference(Path(path))]
    own = {name: fine(*line) for name, line in branches(lumen, surface).items() if len(line[0]) > 1}
    points, radii = (np.concatenate([line[i] for line in own.values()]) for i in range(2))
    tree = cKDTree(points)
    distance, place = tree.query(np.concatenate([line[0] for line in wanted]))
    radius = np.concatenate([line[1] for line in wanted])
    found = distance <= radius
    wider = 100 * (radii[place][found] / radius[found] - 1)
    missed = sum((tree.query(line[0])[0] <= line[1]).mean() < 0.5 for line in wanted)
    of = np.concatenate([line[0] for line in wanted])
    back = cKDTree(of)

    def is_invented(line):
        far, nearest = back.query(line[0])
        return (far <= np.maximum(radius[nearest], line[1])).mean() < 0.5

    invented = [name for name, line in own.items() if is_invented(line)]
    share = sum(len(own[name][0]) for name in invented) / len(points)
    name = Path(surface).name
    print(f"| {name} | {len(wanted)} | {100 * found.mean():.1f} % | {np.median(distance[found]):.2f}, "
          f"{np.percentile(distance[found], 95):.2f} mm | {np.median(wider):+.1f} % | {missed} | {len(own)} | "
          f"{len(invented)} ({100 * share:.1f} %) |")


if __name__ == "__main__":
    main(*sys.argv[1:])
