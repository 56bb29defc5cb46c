"""Flow through a pipe that `lumen prepare` made ready, by scikit-fem, beside Poiseuille's formula.

    python poiseuille.py

Python is that of solvers.py with scikit-fem; LUMEN_PROGRAM names the program if it is not target/release/lumen. An open tube
of radius 2 mm that lies askew gets extensions and caps and is remeshed at three sizes. Gmsh fills what comes out, and
Stokes' equations are solved on it by quadratic velocities and linear pressures, the wall at rest, a given pressure at both
ends. A line for each size: its cells, and the flow over pi R^4 dp / (8 mu L). Nonzero exit status if the finest is not within
1 % or a finer one is farther off than a coarser one.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import skfem
from scipy.sparse import bmat
from skfem.helpers import ddot, div, dot, grad

from solvers import PROGRAM, gmsh_mesh

RADIUS, LENGTH = 2.0, 3.0  # mm
AROUND = (12, 24, 48)
VISCOSITY, DROP = 4e-3, 10.0  # Pa s, Pa


def tube(path, around=240):
    """Writes the open tube as an OBJ file, its axis along none of the file's."""
    axis = np.array([0.36, 0.48, 0.8])
    u = np.cross(axis, [1.0, 0.0, 0.0])
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    rings = round(LENGTH * around / (2 * np.pi * RADIUS)) + 1
    with open(path, "w") as file:
        for z in np.linspace(0, LENGTH, rings):
            for angle in 2 * np.pi * np.arange(around) / around:
                file.write("v {} {} {}\n".format(*(z * axis + RADIUS * (np.cos(angle) * u + np.sin(angle) * v))))
        for i in range(around * (rings - 1)):
            ring, next = i // around * around, (i + 1) % around
            file.write(f"f {i + 1} {ring + next + 1} {ring + around + next + 1} {i + around + 1}\n")


def flow(mesh, patches):
    """The flow through the first end in mm3/s, and the distance of the ends in mm."""
    ends = [patch for patch in patches if patch["kind"] != "wall"]
    centres, normals = (np.array([end[key] for end in ends]) for key in ("centre", "normal"))
    facets = mesh.boundary_facets()
    middles = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    on_end = [facets[abs(normal @ (middles - centre[:, None])) < 1e-3] for centre, normal in zip(centres, normals)]
    wall = np.setdiff1d(facets, np.concatenate(on_end))
    velocity = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTetP2()), intorder=4)
    pressure = velocity.with_element(skfem.ElementTetP1())
    viscous = skfem.BilinearForm(lambda u, v, w: VISCOSITY * ddot(grad(u), grad(v))).assemble(velocity)
    divergence = skfem.BilinearForm(lambda u, q, w: -div(u) * q).assemble(velocity, pressure)
    across = skfem.LinearForm(lambda v, w: dot(w.n, v))
    faces = [across.assemble(skfem.FacetBasis(mesh, velocity.elem, facets=on, intorder=4)) for on in on_end]
    matrix = bmat([[viscous, divergence.T], [divergence, None]], "csr")
    load = np.concatenate([-DROP * faces[0], np.zeros(pressure.N)])
    solution = skfem.solve(*skfem.condense(matrix, load, D=velocity.get_dofs(wall)))
    return -faces[0] @ solution[: velocity.N], np.linalg.norm(centres[1] - centres[0])


def main():
    print("around   triangles  tetrahedra  flow / formula")
    off = []
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        source = folder / "tube.obj"
        tube(source)
        for around in AROUND:
            made = folder / str(around)
            options = ["--extend", "0.25", "--cap", "planar", "--remesh", str(around), "--unit", "mm", "--format", "msh"]
            subprocess.run([PROGRAM, "prepare", source, *options, "-o", made], check=True, capture_output=True)
            told = json.loads(next(made.glob("*.json")).read_text())
            places, cells = gmsh_mesh(next(made.glob("*.msh")))
            mesh = skfem.MeshTet(places.T.copy(), cells.T.copy())
            found, length = flow(mesh, told["patches"])
            ratio = found / (np.pi * RADIUS**4 * DROP / (8 * VISCOSITY * length))
            print(f"{around:6} {len(mesh.boundary_facets()):11,} {mesh.nelements:11,} {ratio:15.4f}", flush=True)
            off.append(abs(ratio - 1))
    converges = all(finer < coarser for coarser, finer in zip(off, off[1:]))
    return 0 if converges and off[-1] <= 0.01 else 1


if __name__ == "__main__":
    sys.exit(main())
