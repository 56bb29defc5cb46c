"""Surfaces as arrays, and what VTK, Open3D and MeshLab measure on them: none of it is Lumen's own.

P is (n, 3) f64 points in mm, F is (m, 3) int64 triangles.
"""
import numpy as np
import open3d
import pymeshlab
import vtk
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

SAMPLES = 200_000
SLIVER_DEGREES = 10


def read_ply(path):
    """Points and triangles of a PLY file; its points are shared by triangles already."""
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return arrays(reader.GetOutput())


def arrays(data):
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).astype(np.int64).reshape(-1, 3)
    return points, corners


def polydata(P, F):
    points, cells, data = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(P, np.float32), deep=1))
    offsets = np.arange(0, 3 * len(F) + 1, 3, dtype=np.int64)
    corners = np.ascontiguousarray(F.ravel(), np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1), numpy_to_vtkIdTypeArray(corners, deep=1))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def edge_facts(F):
    """Pieces (triangles that share a vertex), edges of more than two triangles, Euler characteristic."""
    used, corners = np.unique(F, return_inverse=True)
    F, n = corners.reshape(-1, 3), len(used)
    edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    keys, count = np.unique(edges[:, 0] * n + edges[:, 1], return_counts=True)
    graph = coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(n, n))
    pieces, _ = connected_components(graph, directed=False)
    return dict(pieces=int(pieces), non_manifold=int((count > 2).sum()), euler=int(n - len(keys) + len(F)))


def areas(P, F):
    return np.linalg.norm(np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]]), axis=1) / 2


def sliver_percent(P, F):
    """The share of triangles with an angle below SLIVER_DEGREES, in percent."""
    corners = P[F]
    smallest = np.full(len(F), np.inf)
    for i in range(3):
        a, b = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        sine = np.linalg.norm(np.cross(a, b), axis=1)
        smallest = np.minimum(smallest, np.degrees(np.arctan2(sine, np.einsum("ij,ij->i", a, b))))
    return float((smallest < SLIVER_DEGREES).mean() * 100)


def volume(P, F):
    """Signed volume in mm3, each open end capped by a fan to the mean of its vertices."""
    P = P - P.mean(0)
    six = np.einsum("ij,ij->i", P[F[:, 0]], np.cross(P[F[:, 1]], P[F[:, 2]])).sum()
    n = int(F.max()) + 1
    half = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    rim = half[~np.isin(half[:, 0] * n + half[:, 1], half[:, 1] * n + half[:, 0])]
    if len(rim):
        graph = coo_matrix((np.ones(len(rim)), (rim[:, 0], rim[:, 1])), shape=(n, n))
        _, label = connected_components(graph, directed=False)
        for loop in np.unique(label[rim[:, 0]]):
            edges = rim[label[rim[:, 0]] == loop]
            middle = np.broadcast_to(P[edges[:, 0]].mean(0), (len(edges), 3))
            six += np.einsum("ij,ij->i", P[edges[:, 1]], np.cross(P[edges[:, 0]], middle)).sum()
    return float(six / 6)


def sample(P, F, seed):
    """SAMPLES points spread evenly over the surface."""
    random, weights = np.random.default_rng(seed), areas(P, F)
    corners = P[F[random.choice(len(F), SAMPLES, p=weights / weights.sum())]]
    u, v = random.random((2, SAMPLES, 1))
    root = np.sqrt(u)
    return corners[:, 0] * (1 - root) + corners[:, 1] * (root * (1 - v)) + corners[:, 2] * (root * v)


def distances(surface, points):
    scene = open3d.t.geometry.RaycastingScene()
    P, F = surface
    scene.add_triangles(open3d.core.Tensor(np.ascontiguousarray(P, np.float32)),
                        open3d.core.Tensor(np.ascontiguousarray(F, np.uint32)))
    return scene.compute_distance(open3d.core.Tensor(np.ascontiguousarray(points, np.float32))).numpy().astype(float)


def self_intersecting(P, F):
    """Faces that MeshLab finds to cross another."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(np.ascontiguousarray(P, float), np.ascontiguousarray(F, np.int32)))
    meshes.compute_selection_by_self_intersections_per_face()
    return int(meshes.current_mesh().selected_face_number())


def measured(reference, surface):
    """What reducing `reference` to `surface` cost: distances in mm both ways, change of volume, shape, topology."""
    both = np.concatenate([distances(surface, sample(*reference, 0)), distances(reference, sample(*surface, 1))])
    return dict(triangles=len(surface[1]), mean=float(both.mean()), rms=float(np.sqrt((both**2).mean())),
                max=float(both.max()), volume_percent=(volume(*surface) / volume(*reference) - 1) * 100,
                slivers_percent=sliver_percent(*surface), self_intersecting=self_intersecting(*surface),
                **edge_facts(surface[1]))
