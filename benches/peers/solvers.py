"""What TetGen, Gmsh and fTetWild make of surfaces that `lumen prepare` wrote, and of the same prepared by pymeshfix + pymeshlab.

    python solvers.py [FILE...]

Python is one with gmsh, meshio, numpy, pymeshfix, pymeshlab, pytetwild, pyvista and tetgen; LUMEN_PROGRAM names the program
if it is not target/release/lumen. Without files: those of LUMEN_DATA/real, and the phantoms. A line for each file: the ends,
triangles, mean quality, share of triangles with an angle under 30 degrees, and the cells that each mesher fills the surface
with, without repair; "no" where it does not, or where the volume differs by more than 1 %. Nonzero exit status if TetGen or
Gmsh refuses a surface that Lumen said is ready.
"""
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyvista as pv

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LUMEN_PROGRAM", ROOT / "target" / "release" / "lumen")
DATA = Path(os.environ.get("LUMEN_DATA", ROOT.parent / "shared" / "data"))
ENDINGS = {".stl", ".vtp", ".obj", ".ply", ".vtk"}
OPTIONS = ["--clip", "1", "--extend", "3", "--cap", "planar", "--remesh", "12", "--uncross", "--unit", "auto"]
LIMIT = 60


def quality(mesh):
    points, faces = mesh.points, mesh.faces.reshape(-1, 4)[:, 1:]
    a, b, c = (points[faces[:, i]].astype(float) for i in range(3))
    sides = [np.linalg.norm(p - q, axis=1) for p, q in ((b, c), (c, a), (a, b))]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    mean = (4 * np.sqrt(3) * area / np.maximum(sum(s**2 for s in sides), 1e-300)).mean()
    least = np.full(len(faces), np.pi)
    for i in range(3):
        x, y, z = sides[i], sides[(i + 1) % 3], sides[(i + 2) % 3]
        cosine = (y**2 + z**2 - x**2) / np.maximum(2 * y * z, 1e-300)
        least = np.minimum(least, np.arccos(np.clip(cosine, -1, 1)))
    return mean, (least < np.radians(30)).mean()


def tetgen(path):
    import tetgen as tg

    filler = tg.TetGen(pv.read(path).clean(tolerance=0.0, absolute=True))
    filler.tetrahedralize(order=1, plc=True, nobisect=True, quality=False)
    return filler.grid.n_cells, abs(filler.grid.compute_cell_sizes()["Volume"]).sum()


def gmsh_mesh(path):
    """The places and the tetrahedra, four places each, that Gmsh fills a file's surfaces with."""
    import gmsh as gm

    gm.initialize(interruptible=False)
    gm.option.setNumber("General.Terminal", 0)
    gm.merge(str(path))
    if path.suffix == ".stl":
        gm.model.mesh.createTopology()
    surfaces = [tag for _, tag in gm.model.getEntities(2)]
    gm.model.geo.addVolume([gm.model.geo.addSurfaceLoop(surfaces)])
    gm.model.geo.synchronize()
    gm.model.mesh.generate(3)
    _, _, nodes = gm.model.mesh.getElements(3)
    ids, places, _ = gm.model.mesh.getNodes()
    gm.finalize()
    index = np.zeros(int(ids.max()) + 1, int)
    index[ids.astype(int)] = np.arange(len(ids))
    used, cells = np.unique(index[nodes[0].astype(int)], return_inverse=True)
    return places.reshape(-1, 3)[used], cells.reshape(-1, 4)


def gmsh(path):
    places, cells = gmsh_mesh(path)
    p = places[cells]
    volume = abs(np.einsum("ij,ij->i", p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]))).sum() / 6
    return len(cells), volume


def ftetwild(path):
    import pytetwild

    grid = pytetwild.tetrahedralize_pv(pv.read(path), edge_length_fac=0.05, optimize=False)
    return grid.n_cells, abs(grid.compute_cell_sizes()["Volume"]).sum()


def child(fill, path, pipe):
    # fTetWild leaves a file where it runs.
    os.chdir(path.parent)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    try:
        pipe.send(fill(path))
    except BaseException as error:
        pipe.send(str(error))


def attempt(fill, path, volume):
    """The cells, or None: a mesher that dies takes nothing with it."""
    here, there = multiprocessing.Pipe()
    process = multiprocessing.Process(target=child, args=(fill, path, there))
    process.start()
    there.close()
    try:
        found = here.recv() if here.poll(LIMIT) else "time"
    except EOFError:
        found = "died"
    process.kill()
    process.join()
    if isinstance(found, str) or abs(found[1] / volume - 1) > 0.01:
        return None
    return found[0]


def peers(source, folder, edge):
    """The surface by pymeshfix and pymeshlab, or None."""
    import pymeshfix
    import pymeshlab

    try:
        mesh = pv.read(source).extract_surface(algorithm=None).triangulate().clean()
        fixer = pymeshfix.MeshFix(mesh)
        fixer.repair()
        raw, fixed = folder / "raw.stl", folder / "fixed.stl"
        fixer.mesh.save(raw)
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(raw))
        meshes.meshing_merge_close_vertices()
        meshes.meshing_isotropic_explicit_remeshing(targetlen=pymeshlab.PureValue(edge), iterations=10)
        meshes.save_current_mesh(str(fixed), binary=True)
        return fixed
    except Exception:
        return None


def main():
    files = [Path(name) for name in sys.argv[1:]]
    files = files or sorted(path for path in (DATA / "real").iterdir() if path.suffix in ENDINGS)
    files = files if sys.argv[1:] else [*files, "sample:aorta", "sample:coronary"]
    print(f"{'file':44} ends triangles quality <30deg   s | tetgen    gmsh ftetwild | tetgen    gmsh (pymeshfix + pymeshlab)")
    failed = 0
    for source in files:
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            begun = time.time()
            command = [PROGRAM, "prepare", source, *OPTIONS, "-o", folder, "--format", "stl,msh"]
            done = subprocess.run(command, capture_output=True, text=True)
            seconds = time.time() - begun
            name = source if isinstance(source, str) else source.name
            if done.returncode:
                print(f"{name:44} {(done.stderr.strip().splitlines() or ['?'])[-1]}")
                failed += 1
                continue
            patches = json.loads(next(folder.glob("*.json")).read_text())
            stl, msh = next(folder.glob("*.stl")), next(folder.glob("*.msh"))
            mesh = pv.read(stl).clean(tolerance=0.0, absolute=True)
            mean, small = quality(mesh)
            cells = [attempt(fill, path, mesh.volume) for fill, path in ((tetgen, stl), (gmsh, msh), (ftetwild, stl))]
            failed += patches["is_ready"] and None in cells[:2]
            line = f"{name:44} {len(patches['patches']) - 1:4} {mesh.n_cells:9,} {mean:7.3f} {100 * small:5.2f}% {seconds:4.1f} |"
            line += "".join(f" {cell:8,}" if cell else "       no" for cell in cells)
            # A file in cm or m is not as large as what Lumen made of it.
            is_mm = not isinstance(source, str) and pv.read(source).length > mesh.length / 5
            if is_mm:
                edge = np.sqrt(4 / np.sqrt(3) * mesh.area / mesh.n_cells)
                other = peers(source, folder, edge)
                line += " |"
                if other is None:
                    line += " not prepared"
                else:
                    volume = pv.read(other).volume
                    line += "".join(f" {cell:8,}" if cell else "       no" for cell in (attempt(f, other, volume) for f in (tetgen, gmsh)))
            print(line, flush=True)
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
