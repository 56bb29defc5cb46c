"""What VTK makes of the two volumes of the test data: the facts that tests/real/scans.rs holds Lumen to.

    python volumes.py [FOLDER]

Python is one with requirements.txt (`cargo xtask peers` makes it: target/peers/venv). FOLDER is that of the test data;
else LUMEN_DATA, else ../shared/data beside the checkout. A line of JSON for each surface: triangles, vertices and bounds in
mm of vtkFlyingEdges3D and of vtkMarchingCubes, which agree.
"""
import json
import os
import sys
from pathlib import Path

import vtk

ROOT = Path(__file__).resolve().parents[2]
VOLUMES = [
    ("vmtk_aorta_mra.mha", vtk.vtkMetaImageReader, [600, 800, 1000]),
    ("seqseg_PA000016_mask.nii.gz", vtk.vtkNIFTIImageReader, [0.5]),
]


def surface(method, image, value):
    made = method()
    made.SetInputData(image)
    made.SetValue(0, value)
    made.ComputeNormalsOff()
    made.ComputeGradientsOff()
    made.Update()
    return made.GetOutput()


def main():
    beside = os.environ.get("LUMEN_DATA", ROOT.parent / "shared" / "data")
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else beside) / "volumes"
    for name, kind, values in VOLUMES:
        reader = kind()
        reader.SetFileName(str(folder / name))
        reader.Update()
        image = reader.GetOutput()
        place = {"dimensions": image.GetDimensions(), "spacing": image.GetSpacing(), "range": image.GetScalarRange()}
        for value in values:
            found = {}
            for method in [vtk.vtkFlyingEdges3D, vtk.vtkMarchingCubes]:
                made = surface(method, image, value)
                counts = [made.GetNumberOfPolys(), made.GetNumberOfPoints()]
                found[method.__name__] = {"triangles": counts[0], "vertices": counts[1], "bounds": made.GetBounds()}
            print(json.dumps({"volume": name, "value": value, **place, **found}), flush=True)


main()
