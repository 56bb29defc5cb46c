"""Isotropic remeshing at equal count: Lumen, trueform, pymeshlab, pyacvd and Gmsh on the same surfaces in the same run, into
docs/benchmarks/remeshing.md.

    python remeshing.py [FILE...]

Python is one with gmsh, numpy, pyacvd, pymeshlab, pyvista and trueform; LUMEN_PROGRAM names the program if it is not
target/release/lumen, LUMEN_REMESH what `cargo build --release -p lumen-prepare --example remesh_file` makes. Without files: the two samples, smoothed, and two scans of LUMEN_DATA/real; of each the largest piece.

Lumen makes edges of one length, half as long again as the mean of those that enter, so that there is something to compare:
it has a length for each place otherwise. Of the peers the wanted length, or count, is corrected until they make as many
triangles within 2 %; that run is the one that is timed. The call is that of the library alone, of less than 2 s the least of
three; Lumen's finds crossings, and mends them, too. With measures it also says how far it went, how good the triangles are, and
where each vertex and triangle comes from. The program is `lumen prepare` with reading, the radii and writing. trueform runs with
its own 5 rounds, and with 20. One thread each. Quality is 4 sqrt(3) A over the sum
of the squared edges. Deviation is the larger of both ways, by MeshLab's Hausdorff filter from 200,000 places of each surface.
"""
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

os.environ["RAYON_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402
import pyvista as pv  # noqa: E402

from families import faces_of, surface  # noqa: E402
from solvers import DATA, PROGRAM, ROOT, quality  # noqa: E402

REAL = ["aorta-surface-open-ends.stl", "steve_mechanical_thrombectomy.obj"]
SAMPLES = {"aorta": 20_000, "coronary": 40_000}
CALL = os.environ.get("LUMEN_REMESH", ROOT / "target" / "release" / "examples" / "remesh_file")
LONGER = 1.5
#: Seconds for a peer to come to the count.
LIMIT = 120


def edges(mesh):
    """The mean length of the edges."""
    p, faces = mesh.points, faces_of(mesh)
    return np.concatenate([np.linalg.norm(p[faces[:, i]] - p[faces[:, i - 1]], axis=1) for i in range(3)]).mean()


def lumen(mesh, path, length, folder):
    command = [PROGRAM, "prepare", path, "--remesh", "12", "--least", str(length), "--largest", str(length), "-o", folder]
    begun = time.time()
    subprocess.run([*command, "--format", "vtp", "--unit", "mm"], check=True, capture_output=True)
    program = time.time() - begun
    calls = subprocess.run([CALL, path, str(length), folder / "call.ply", "3"], check=True, capture_output=True, text=True).stdout
    call, with_measures = map(float, calls.split())
    return pv.read(next(folder.glob("*.vtp"))), call, with_measures, program


def trueform(mesh, length, rounds=5):
    import trueform as tf

    whole = tf.Mesh(faces_of(mesh).astype(np.int32), mesh.points.astype(np.float32))
    begun = time.time()
    faces, points = tf.isotropic_remeshed(whole, float(length), iterations=rounds, feature_angle=40, parallel=False)
    seconds = time.time() - begun
    return surface(points, faces), seconds


def trueform_20(mesh, length):
    return trueform(mesh, length, rounds=20)


def meshlab(mesh, length):
    import pymeshlab as ml

    meshes = ml.MeshSet()
    meshes.add_mesh(ml.Mesh(mesh.points.astype(float), faces_of(mesh)))
    begun = time.time()
    meshes.meshing_isotropic_explicit_remeshing(targetlen=ml.PureValue(length), iterations=10)
    seconds = time.time() - begun
    found = meshes.current_mesh()
    faces = found.face_matrix()
    return surface(found.vertex_matrix(), faces), seconds


def acvd(mesh, length):
    import pyacvd

    # As many clusters as vertices of equilateral triangles of this length.
    wanted = int(mesh.area / (np.sqrt(3) / 2 * length**2))
    begun = time.time()
    clusters = pyacvd.Clustering(mesh)
    if mesh.n_points < 20 * wanted:
        clusters.subdivide(int(np.ceil(np.log(20 * wanted / mesh.n_points) / np.log(4))))
    clusters.cluster(wanted)
    made = clusters.create_mesh()
    return made, time.time() - begun


def gmsh(mesh, length):
    import gmsh as gm

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "in.stl"
        mesh.save(path)
        gm.initialize(interruptible=False)
        try:
            gm.option.setNumber("General.Terminal", 0)
            gm.merge(str(path))
            begun = time.time()
            gm.model.mesh.classifySurfaces(np.radians(40), True, True, np.pi)
            gm.model.mesh.createGeometry()
            for name, value in (("MeshSizeMin", length), ("MeshSizeMax", length), ("MeshSizeExtendFromBoundary", 0)):
                gm.option.setNumber(f"Mesh.{name}", value)
            gm.model.mesh.generate(2)
            seconds = time.time() - begun
            ids, places, _ = gm.model.mesh.getNodes()
            _, _, nodes = gm.model.mesh.getElements(2)
        finally:
            gm.finalize()
    index = np.zeros(int(ids.max()) + 1, int)
    index[ids.astype(int)] = np.arange(len(ids))
    faces = index[np.concatenate(nodes).astype(int)].reshape(-1, 3)
    return surface(places.reshape(-1, 3), faces).clean(tolerance=0.0), seconds


def deviation(one, other):
    import pymeshlab as ml

    meshes = ml.MeshSet()
    for mesh in (one, other):
        meshes.add_mesh(ml.Mesh(mesh.points.astype(float), faces_of(mesh)))
    ways = [meshes.get_hausdorff_distance(sampledmesh=a, targetmesh=1 - a, samplenum=200_000)["max"] for a in (0, 1)]
    return max(ways)


def at_count(remesh, mesh, length, count, pipe):
    """What a peer makes at this count within 2 %, or nearest to it in five runs, goes into a pipe."""
    best = None
    try:
        for _ in range(5):
            made, seconds = remesh(mesh, length)
            off = abs(made.n_cells / count - 1)
            if best is None or off < best[0]:
                best = off, np.asarray(made.points), faces_of(made), seconds, length
            if off < 0.02:
                break
            length *= np.sqrt(max(made.n_cells, 1) / count)
        *made, seconds, length = best[1:]
        if seconds < 2:
            seconds = min([seconds] + [remesh(mesh, length)[1] for _ in range(2)])
        pipe.send((*made, seconds))
    except BaseException as error:
        pipe.send((str(error).splitlines() or ["?"])[0])


def tried(remesh, mesh, length, count):
    """The surface and the time, or why there is none: a peer that dies takes nothing with it."""
    here, there = multiprocessing.Pipe()
    process = multiprocessing.Process(target=at_count, args=(remesh, mesh, length, count, there))
    process.start()
    there.close()
    try:
        found = here.recv() if here.poll(LIMIT) else f"more than {LIMIT} s"
    except EOFError:
        found = "died"
    process.kill()
    process.join()
    if isinstance(found, str):
        return None, found
    points, faces, seconds = found
    return surface(points, faces), seconds


#: What stands above the table.
TEXT = """`python benches/peers/remeshing.py` made this table; the peers are of PyPI, in the same run, one thread each. Edges are of one length, \
half as long again as the mean of those that enter; of each peer the run that comes within 2 % of Lumen's count is timed. *Call* is the time of the \
library's call alone, below 2 s the least of three; Lumen's finds crossings and mends them, which the peers' do not. *With measures* it also has the \
deviation, the quality, and the sources of vertices and triangles. trueform runs with its own 5 rounds, and with 20. *Program* is `lumen prepare` with reading, radii and writing. Quality is 4 √3 A over the sum of the squared edges, the deviation the larger of both \
ways (MeshLab, 200,000 places)."""
PEERS = {"Lumen": None, "trueform": trueform, "trueform, 20 rounds": trueform_20, "pymeshlab": meshlab, "pyacvd": acvd, "Gmsh": gmsh}


def surfaces(folder):
    for name in sys.argv[1:]:
        yield Path(name).name, pv.read(name)
    if not sys.argv[1:]:
        for sample, triangles in SAMPLES.items():
            path = folder / f"{sample}.ply"
            subprocess.run([PROGRAM, "phantom", sample, "--triangles", str(triangles), "-o", path], check=True, capture_output=True)
            smooth = folder / f"{sample}-smooth.ply"
            subprocess.run([PROGRAM, "optimise", path, "--reduction", "0", "-o", smooth], check=True, capture_output=True)
            yield f"sample:{sample}, smoothed", pv.read(smooth)
        for name in REAL:
            yield name, pv.read(DATA / "real" / name)


def main():
    lines = ["| surface | method | triangles | call s | with measures s | program s | mean quality | under 30° | deviation mm |", "|---|---|--:|--:|--:|--:|--:|--:|--:|"]
    print("\n".join(lines), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name, mesh in surfaces(folder):
            mesh = mesh.extract_surface(algorithm=None).triangulate().clean(tolerance=0.0, absolute=True).connectivity("largest")
            mesh = mesh.extract_surface(algorithm=None)
            mesh.clear_data()
            path, length = folder / "in.ply", LONGER * edges(mesh)
            mesh.save(path)
            (folder / "out").mkdir(exist_ok=True)
            ours, call, with_measures, program = lumen(mesh, path, length, folder / "out")
            for method, remesh in PEERS.items():
                made, seconds = (ours, call) if remesh is None else tried(remesh, mesh, length, ours.n_cells)
                if made is None:
                    line = f"| `{name}` | {method} | {seconds} | | | | | | |"
                else:
                    mean, small = quality(made)
                    of_all = f"{with_measures:.3f} | {program:.2f}" if remesh is None else " | "
                    line = f"| `{name}` | {method} | {made.n_cells:,} | {seconds:.3f} | {of_all} | {mean:.3f} | {100 * small:.2f} % | {deviation(made, mesh):.3f} |"
                lines.append(line)
                print(line, flush=True)
    return lines


if __name__ == "__main__":
    table = main()
    if not sys.argv[1:]:
        (ROOT / "docs" / "benchmarks" / "remeshing.md").write_text(f"# Remeshing at equal count\n\n{TEXT}\n\n" + "\n".join(table) + "\n")
