"""The real vessels of LUMEN_DATA as one surface each: largest piece, in mm, PLY; what VTK and MeshLab measure on them."""
import numpy as np
import pymeshlab
import vtk

from quality import arrays
from sections import DATA, largest_piece

#: Millimetres in a file's unit, where that is not one.
UNITS = {"cathsim_low_tort_arch.stl": 1000, "matteopescio_abdominal_aorta_phantom.stl": 1000,
         "seqseg_shawn_260_aorta.vtp": 10, "vmr_kawasaki_aorta_coronaries.vtp": 10}
READERS = {".stl": vtk.vtkSTLReader, ".ply": vtk.vtkPLYReader, ".obj": vtk.vtkOBJReader, ".vtp": vtk.vtkXMLPolyDataReader}
#: MeshLab's epsilon is 1e-6 in the square of the unit: small triangles would hide what crosses.
MAGNIFIED = 1e5


def files():
    return sorted(file for file in (DATA / "real").iterdir() if file.suffix in READERS)


def read(file):
    """Largest piece in mm, coincident points welded, polygons cut into triangles."""
    reader = READERS[file.suffix]()
    reader.SetFileName(str(file))
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(reader.GetOutputPort())
    clean.ToleranceIsAbsoluteOn()
    clean.SetAbsoluteTolerance(0)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(clean.GetOutputPort())
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    P, F = arrays(triangles.GetOutput())
    (P, F), _ = largest_piece(P, F)
    return P * UNITS.get(file.name, 1), F


def roughness(P, F):
    """Root mean square of the angle between neighbouring triangles in degrees, those of no area left out."""
    normals = np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]])
    length = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(length, 1e-300)[:, None]
    edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    _, of, count = np.unique(edges[:, 0] * len(P) + edges[:, 1], return_inverse=True, return_counts=True)
    order = np.argsort(of, kind="stable")
    first = np.concatenate([[0], np.cumsum(count)])[:-1][count == 2]
    a, b = order[first] % len(F), order[first + 1] % len(F)
    has_area = (length[a] > 0) & (length[b] > 0)
    cosine = np.einsum("ij,ij->i", normals[a], normals[b])[has_area]
    return float(np.sqrt((np.degrees(np.arccos(np.clip(cosine, -1, 1)))**2).mean()))


def crossing(P, F):
    """Whether each triangle runs into another, by MeshLab."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(np.ascontiguousarray(P, float) * MAGNIFIED, np.ascontiguousarray(F, np.int32)))
    meshes.compute_selection_by_self_intersections_per_face()
    return meshes.current_mesh().face_selection_array()
