"""What VTK's surface nets make of a map of labels and of the mask in the test data: the facts of the tests of
crates/lumen-volume/src/surface_nets.rs and of tests/real/scans.rs, with time and memory.

    python nets.py [FOLDER]
    python nets.py --write MASK OUT

Python is one with requirements.txt (`cargo xtask peers` makes it: target/peers/venv). FOLDER is that of the test data;
else LUMEN_DATA, else ../shared/data beside the checkout. With --write the surface of label 1 of MASK, NIfTI or MetaImage, goes
into OUT as PLY, which `masks.py` takes the time of. A line of JSON for each: vertices, triangles, and how many of these
have which two labels beside them. VTK has more vertices than places: some lie where others do.
"""
import json
import os
import resource
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = Path(__file__).resolve().parents[2]


def labels():
    """Three labels in a ball, k running slowest."""
    k, j, i = np.mgrid[0:32, 0:36, 0:40]
    x, y, z = i - 19, j - 17, 2 * (k - 15)
    found = np.where(x + 2 * y + z > 8, 1, np.where(x - y > 3, 2, 5))
    return np.where(x * x + y * y + z * z < 225, found, 0).astype(np.uint8)


def image(values, spacing, origin=(0, 0, 0)):
    """Labels, k running slowest, as an image of VTK."""
    made = vtk.vtkImageData()
    made.SetDimensions(values.shape[::-1])
    made.SetSpacing(spacing)
    made.SetOrigin(origin)
    made.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    return made


def read(path):
    reader = vtk.vtkMetaImageReader() if path.endswith(".mha") else vtk.vtkNIFTIImageReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def nets(made, values, smooth=True):
    """The surface of some labels, and the seconds that VTK takes for it."""
    method = vtk.vtkSurfaceNets3D()
    method.SetInputData(made)
    for n, value in enumerate(values):
        method.SetValue(n, value)
    method.SetBackgroundLabel(0)
    method.SetSmoothing(smooth)
    method.SetOutputMeshTypeToTriangles()
    began = time.perf_counter()
    method.Update()
    return method.GetOutput(), time.perf_counter() - began


def facts(made, values, smooth):
    found, took = nets(made, values, smooth)
    places = len(np.unique(vtk_to_numpy(found.GetPoints().GetData()), axis=0))
    pairs = vtk_to_numpy(found.GetCellData().GetArray("BoundaryLabels"))
    sides = Counter(tuple(int(label) for label in pair) for pair in pairs)
    print(json.dumps({
        "smoothed": smooth, "vertices": found.GetNumberOfPoints(), "places": places, "triangles": found.GetNumberOfCells(),
        "between": {f"{a} {b}": n for (a, b), n in sorted(sides.items())}, "seconds": round(took, 3),
        "peak MB of the program": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024,
    }), flush=True)


def write(mask, out):
    writer = vtk.vtkPLYWriter()
    writer.SetInputData(nets(read(mask), [1])[0])
    writer.SetFileName(out)
    writer.Write()


def main(arguments):
    vtk.vtkSMPTools.Initialize(1)
    if arguments[:1] == ["--write"]:
        return write(*arguments[1:])
    facts(image(labels(), (0.5, 0.5, 1.0)), [1, 2, 5], False)
    beside = os.environ.get("LUMEN_DATA", ROOT.parent / "shared" / "data")
    mask = read(str(Path(arguments[0] if arguments else beside) / "volumes" / "seqseg_PA000016_mask.nii.gz"))
    for smooth in [False, True]:
        facts(mask, [1], smooth)


if __name__ == "__main__":
    main(sys.argv[1:])
