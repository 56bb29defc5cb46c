"""What TetGen, Gmsh and fTetWild make of surfaces that `lumen prepare` wrote, and of the same prepared by pymeshfix + pymeshlab.

    python solvers.py [FILE...] [--fast] [--wrap=MM]
    python solvers.py --family [PART OF A NAME...] [--fast] [--wrap=MM]

Python is one with gmsh, meshio, numpy, pymeshfix, pymeshlab, pytetwild, pyvista and tetgen; LUMEN_PROGRAM names the program
if it is not target/release/lumen, LUMEN_LIMIT the seconds that each may take if not 60. Without files: those of LUMEN_DATA/real, and the phantoms; with --family those that
`families.py` makes, without the peers. --fast leaves out fTetWild and the peers; --wrap takes a wrap of each. A line for each file: the ends,
triangles, mean quality, share of triangles with an angle under 30 degrees, and the cells that each mesher fills the surface
with, without repair; "no" where it does not, or where the volume differs by more than 1 %. Nonzero exit status if Lumen, TetGen
or Gmsh refuses a surface.
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

from families import family

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("LUMEN_PROGRAM", ROOT / "target" / "release" / "lumen")
DATA = Path(os.environ.get("LUMEN_DATA", ROOT.parent / "shared" / "data"))
ENDINGS = {".stl", ".vtp", ".obj", ".ply", ".vtk"}
OPTIONS = ["--clip", "1", "--extend", "3", "--cap", "planar", "--remesh", "12", "--uncross", "--unit", "auto"]
#: Seconds for Lumen, and for each mesher; longer on a busy machine.
LIMIT = float(os.environ.get("LUMEN_LIMIT", "60"))


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


def line_of(name, source, folder, fillers, has_peers):
    """What is printed of a file, and whether a mesher refused what Lumen said is ready, or Lumen the file."""
    begun = time.time()
    command = [PROGRAM, "prepare", source, *OPTIONS, "-o", folder, "--format", "stl,msh"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"{name:44} takes more than {LIMIT:g} s", True
    seconds = time.time() - begun
    if done.returncode:
        return f"{name:44} {(done.stderr.strip().splitlines() or ['?'])[-1]}", True
    patches = json.loads(next(folder.glob("*.json")).read_text())
    stl, msh = next(folder.glob("*.stl")), next(folder.glob("*.msh"))
    mesh = pv.read(stl).clean(tolerance=0.0, absolute=True)
    mean, small = quality(mesh)
    cells = [attempt(fill, msh if fill is gmsh else stl, mesh.volume) for fill in fillers]
    line = f"{name:44} {len(patches['patches']) - 1:4} {mesh.n_cells:9,} {mean:7.3f} {100 * small:5.2f}% {seconds:4.1f} |"
    line += "".join(f" {cell:8,}" if cell else "       no" for cell in cells)
    line += "" if patches["is_ready"] else " (said: " + " ".join(finding["text"] for finding in patches["findings"]) + ")"
    # A file in cm or m is not as large as what Lumen made of it.
    if has_peers and pv.read(source).length > mesh.length / 5:
        edge = np.sqrt(4 / np.sqrt(3) * mesh.area / mesh.n_cells)
        other = peers(source, folder, edge)
        line += " |"
        if other is None:
            line += " not prepared"
        else:
            volume = pv.read(other).volume
            line += "".join(f" {cell:8,}" if cell else "       no" for cell in (attempt(f, other, volume) for f in (tetgen, gmsh)))
    return line, None in cells[:2]


def made(make, number, folder):
    """A surface of the family as a file, of one format after another."""
    path = folder / f"made{['.vtp', '.stl', '.ply'][number % 3]}"
    make().save(path)
    return path


def main():
    names = [name for name in sys.argv[1:] if not name.startswith("--")]
    OPTIONS.extend(option for option in sys.argv[1:] if option.startswith("--wrap="))
    is_family, is_fast = "--family" in sys.argv, "--fast" in sys.argv
    fillers, has_peers = [tetgen, gmsh, *([] if is_fast else [ftetwild])], not (is_family or is_fast)
    print(f"{'file':44} ends triangles quality <30deg   s | tetgen    gmsh ftetwild | tetgen    gmsh (pymeshfix + pymeshlab)")
    failed = count = 0
    if is_family:
        all_made = enumerate(family())
        sources = [(name, (make, number)) for number, (name, make) in all_made if all(part in name for part in names)]
    else:
        files = [Path(name) for name in names] or sorted(path for path in (DATA / "real").iterdir() if path.suffix in ENDINGS)
        sources = [(path.name, path) for path in files] + [(name, name) for name in ([] if names else ["sample:aorta", "sample:coronary"])]
    for name, source in sources:
        with tempfile.TemporaryDirectory() as into, tempfile.TemporaryDirectory() as beside:
            source = made(*source, Path(beside)) if is_family else source
            line, is_refused = line_of(name, source, Path(into), fillers, has_peers and isinstance(source, Path))
        failed, count = failed + is_refused, count + 1
        print(line, flush=True)
    print(f"{count - failed} of {count} are prepared and filled by TetGen and Gmsh")
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
