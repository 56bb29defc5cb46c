"""Reads one surface in every format that Lumen writes, with VTK, trimesh and meshio: equal counts, places and normals.

    read_back.py FOLDER

FOLDER has surface.vtp, .vtk, .stl, .ply, .obj and .glb, and report.json from `lumen optimise --report`.
"""

import json
import sys
from pathlib import Path

import meshio
import numpy as np
import trimesh
import vtk
from vtk.util.numpy_support import vtk_to_numpy

VTK_READERS = {
    "vtp": vtk.vtkXMLPolyDataReader,
    "vtk": vtk.vtkPolyDataReader,
    "stl": vtk.vtkSTLReader,
    "ply": vtk.vtkPLYReader,
    "obj": vtk.vtkOBJReader,
}


def with_vtk(path):
    """Points, triangles and point normals (or None) as VTK reads them."""
    reader = VTK_READERS[path.suffix[1:]]()
    reader.SetFileName(str(path))
    if path.suffix == ".stl":
        reader.MergingOff()
    reader.Update()
    data = reader.GetOutput()
    cells = data.GetPolys()
    assert cells.GetNumberOfCells() == data.GetNumberOfCells(), "cells that are no polygons"
    triangles = vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 3)
    normals = data.GetPointData().GetNormals()
    return vtk_to_numpy(data.GetPoints().GetData()), triangles, None if normals is None else vtk_to_numpy(normals)


def with_trimesh(path):
    """The same as trimesh reads them, GLB upright and without its node's scale; normals of GLB alone, for trimesh makes its
    own where it reads none."""
    if path.suffix != ".glb":
        mesh = trimesh.load(path, process=False, force="mesh")
        return np.array(mesh.vertices), np.array(mesh.faces), None
    scene = trimesh.load_scene(path, process=False)
    (mesh,) = scene.geometry.values()
    apart = np.abs(1000 * scene.extents - mesh.extents).max()
    assert apart < 1e-3, f"GLB is not in metres: {apart} mm apart"
    upright = lambda vectors: np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], 1)
    return upright(np.array(mesh.vertices)), np.array(mesh.faces), upright(np.array(mesh.vertex_normals))


def with_meshio(path):
    """The same as meshio reads them, without normals; it knows no polygonal data of VTK."""
    mesh = meshio.read(path)
    return mesh.points, mesh.cells_dict["triangle"], None


def main():
    folder = Path(sys.argv[1])
    facts = json.loads((folder / "report.json").read_text())["output"]
    wanted = facts["triangles"]
    points, triangles, normals = with_vtk(folder / "surface.vtp")
    assert len(triangles) == wanted, f"VTK reads {len(triangles)} triangles of {wanted} from VTP"
    corners = points[triangles]
    assert normals is not None and np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-5, "normals of VTP"
    rows = [(with_vtk, VTK_READERS), (with_trimesh, ["stl", "ply", "obj", "glb"]), (with_meshio, ["stl", "ply", "obj"])]
    for read, formats in rows:
        for extension in formats:
            path = folder / f"surface.{extension}"
            other_points, other_triangles, other_normals = read(path)
            what = f"{read.__name__[5:]} {extension}"
            assert len(other_triangles) == wanted, f"{what}: {len(other_triangles)} triangles of {wanted}"
            # Text and metres are rounded by the reader; everything else is the same to the bit.
            bound = 1e-4 if extension in ("glb", "obj") else 0
            apart = np.abs(other_points[other_triangles] - corners).max()
            assert apart <= bound, f"{what}: corners are {apart} mm apart"
            if extension != "stl":
                assert len(other_points) == len(points), f"{what}: {len(other_points)} points of {len(points)}"
            has_normals = other_normals is not None
            if has_normals:
                apart = np.abs(other_normals - normals).max()
                assert apart <= 1e-5, f"{what}: normals differ by {apart}"
            print(f"{what}: {len(other_points)} points, {wanted} triangles, {'the same normals' if has_normals else 'no normals'}")
            must = {"with_vtk": ["vtp", "vtk", "ply", "obj"], "with_trimesh": ["glb"], "with_meshio": []}
            assert has_normals or extension not in must[read.__name__], f"{what}: its normals are missing"


if __name__ == "__main__":
    main()
