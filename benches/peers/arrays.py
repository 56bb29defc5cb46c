"""How well arrays are carried: what Lumen writes at 90 %, against VTK's values of the original at the closest point.

    python arrays.py LUMEN DATA [OUT]

LUMEN is the program, DATA the folder of the test data. For each surface that carries arrays, `lumen optimise` writes a
VTP file; points are then taken on it, its vertices and 50,000 samples over its area, and for each VTK
(`vtkStaticCellLocator`, the interpolation of `vtkProbeFilter`) says what the file as it was opened has at the closest
point. Scalars: the mean difference, in percent of the range of the original. Labels: the part of the samples that have
another one. Only the part of the original that Lumen keeps, its largest piece, is asked. Prints a table in Markdown.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkIdList
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SURFACES = [
    ("formats/legacy_binary_v42.vtk", "Height", None),
    ("formats/cowHead.vtp", "Gauss_Curvature", None),
    ("real/aorta-surface-branch-split.vtp", "ClippingArray", None),
    ("real/vmr_kawasaki_aorta_coronaries.vtp", None, "ModelFaceID"),
]
RUNS = [
    ("none", "schroeder"),
    ("none", "quadric"),
    ("auto", "schroeder"),
    ("auto", "quadric"),
]
SAMPLES = 50_000


def surface(path: Path) -> vtkPolyData:
    """A file's triangles with their arrays."""
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkPolyDataReader()
    reader.SetFileName(str(path))
    if path.suffix == ".vtk":
        reader.ReadAllFieldsOn()
        reader.ReadAllScalarsOn()
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.SetInputConnection(reader.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def corners(mesh: vtkPolyData) -> tuple[np.ndarray, np.ndarray]:
    """Positions, and vertices of each triangle."""
    positions = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return positions, triangles


def samples(mesh: vtkPolyData) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles, barycentric weights and places, spread evenly over the area."""
    positions, triangles = corners(mesh)
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(1)
    chosen = random.choice(len(triangles), SAMPLES, p=area / area.sum())
    root, along = np.sqrt(random.random(SAMPLES)), random.random(SAMPLES)
    weights = np.stack([1 - root, root * (1 - along), root * along], axis=1)
    places = np.einsum("ij,ijk->ik", weights, positions[triangles[chosen]])
    return chosen, weights, places


class Probe:
    """What a surface has at the closest point."""

    def __init__(self, mesh: vtkPolyData):
        self.mesh, self.locator = mesh, vtkStaticCellLocator()
        self.locator.SetDataSet(mesh)
        self.locator.BuildLocator()

    def __call__(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Vertices and weights at the closest points, and their triangles."""
        cell, point, ids = vtkGenericCell(), [0.0] * 3, vtkIdList()
        which, side, squared = mutable(0), mutable(0), mutable(0.0)
        vertices, weights, triangles = [], [], []
        for place in places:
            self.locator.FindClosestPoint(list(place), point, cell, which, side, squared)
            closest, parametric, weight = [0.0] * 3, [0.0] * 3, [0.0] * 3
            cell.EvaluatePosition(point, closest, mutable(0), parametric, mutable(0.0), weight)
            self.mesh.GetCellPoints(which.get(), ids)
            vertices.append([ids.GetId(i) for i in range(3)])
            weights.append(weight)
            triangles.append(which.get())
        return np.array(vertices), np.array(weights), np.array(triangles)


def difference(lumen: Path, file: Path, scalar, label, smoothing: str, method: str, out: Path) -> dict:
    """Runs Lumen and compares."""
    result = out / f"{file.stem}-{smoothing}-{method}.vtp"
    command = [lumen, "optimise", file, "-o", result, "--smoothing", smoothing, "--method", method]
    subprocess.run(command, check=True, capture_output=True)
    original, reduced = surface(file), surface(result)
    probe = Probe(original)
    chosen, weights, places = samples(reduced)
    positions, triangles = corners(reduced)
    found = {}
    if scalar:
        before = vtk_to_numpy(original.GetPointData().GetArray(scalar)).astype(float)
        after = vtk_to_numpy(reduced.GetPointData().GetArray(scalar)).astype(float)
        span = before.max() - before.min()
        vertices, at, _ = probe(positions)
        found["vertices"] = 100 * np.abs((before[vertices] * at).sum(1) - after).mean() / span
        vertices, at, _ = probe(places)
        here = (after[triangles[chosen]] * weights).sum(1)
        found["surface"] = 100 * np.abs((before[vertices] * at).sum(1) - here).mean() / span
    if label:
        before = vtk_to_numpy(original.GetCellData().GetArray(label))
        after = vtk_to_numpy(reduced.GetCellData().GetArray(label))
        _, _, below = probe(places)
        found["labels"] = 100 * (before[below] != after[chosen]).mean()
    return found


def main() -> None:
    lumen, data = sys.argv[1], Path(sys.argv[2])
    out = Path(sys.argv[3]) if len(sys.argv) > 3 else Path(tempfile.mkdtemp())
    print("| file | array | smoothing | method | at vertices, % of range | over the surface, % of range | other label, % of area |")
    print("|---|---|---|---|---|---|---|")
    for name, scalar, label in SURFACES:
        for smoothing, method in RUNS:
            found = difference(lumen, data / name, scalar, label, smoothing, method, out)
            cell = lambda key: f"{found[key]:.3f}" if key in found else ""
            arrays = ", ".join(array for array in (scalar, label) if array)
            row = [name, arrays, smoothing, method, cell("vertices"), cell("surface"), cell("labels")]
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
