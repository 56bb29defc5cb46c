"""Ways from a mask to a surface, on masks of vessels of known radius, into docs/benchmarks/masks.csv and docs/scans.md.

    python masks.py [NAME...]

Python is one with requirements.txt (`cargo xtask peers` makes it: target/peers/venv); LUMEN_PROGRAM names the program if it
is not target/release/lumen, LUMEN_DATA the folder of the test data. With names, only phantoms whose name holds one of them are
measured, and the tables are printed alone.

Radii are those of the circles of the areas of single cross-sections. Roughness is the root mean square of the angle between
a triangle and the true wall, weighted by area; it and the scatter (that of the distance from the true wall, without its mean)
are of straight vessels alone. Times and memory are of the whole program on one core: opened, made, written as PLY.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from nets import image, nets
from phantoms import worst
from quality import areas, arrays
from sections import DATA, PROGRAM, Cuts, document, lumen, optimise, read_ply, windowed_sinc, write_rows
from trees import AXIS, sample, tube

#: Of the grid in mm: alike along all axes, with thick slices, and with these across most of the vessel.
SPACINGS = [(0.5, 0.5, 0.5), (0.7, 0.7, 0.7), (0.5, 0.5, 1.0), (1.0, 0.5, 0.5)]
#: That of the samples (crates/lumen-vessel/src/phantom), as `lumen phantom` has them.
CT = {"aorta": (0.6, 0.6, 0.75), "coronary": (0.4, 0.4, 0.5)}
DIAMETERS = [1.25, 1.5, 2, 3, 5, 8, 12]
WAYS = ["marching cubes", "marching cubes, Lumen's smoothing", "marching cubes, VTK's windowed sinc", "surface nets",
        "surface nets, Lumen's smoothing", "VTK's surface nets"]
#: Least and most voxels across of the classes, a voxel being the cube root of its volume.
CLASSES = [(2, 3), (3, 6), (6, 12), (12, np.inf)]


def write_mask(path, origin, inside, spacing):
    """MetaImage, raw, in LPS."""
    words = lambda values: " ".join(map(str, values))  # noqa: E731
    head = (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nAnatomicalOrientation = RAI\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
            f"Offset = {words(origin)}\nElementSpacing = {words(spacing)}\nDimSize = {words(inside.shape[::-1])}\n"
            f"ElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
    Path(path).write_bytes(head.encode() + inside.tobytes())


def vtk_nets(origin, inside, spacing):
    found, _ = nets(image(inside, spacing, origin), [1])
    # Some of its vertices lie where others do.
    clean = vtk.vtkCleanPolyData()
    clean.SetInputData(found)
    clean.PointMergingOn()
    clean.SetTolerance(0)
    clean.Update()
    return clean.GetOutput()


def surfaces(mask, folder):
    """The surface by each way, all pieces of it."""
    file = Path(folder) / "mask.mha"
    write_mask(file, *mask)
    made = {}
    for name, by in [("cubes", WAYS[0]), ("nets", WAYS[3])]:
        plain = Path(folder) / f"{name}.ply"
        lumen("surface", file, "--surface-by", name, "-o", plain)
        made[by] = read_ply(plain)
        smooth, report = optimise(plain, folder, "--smoothing", "auto", "--reduction", 0, "--keep-all-components", "--unit", "mm")
        made[f"{by}, Lumen's smoothing"] = smooth
    of = report["settings"]["smoothing"]
    made[WAYS[2]] = windowed_sinc(made[WAYS[0]], of["pass_band"], of["iterations"], window=of["window"].title())
    made[WAYS[5]] = arrays(vtk_nets(*mask))
    return made


def wall(P, F, line):
    """Roughness in degrees and scatter in mm of a straight vessel, over the stations that count."""
    middle, weight = P[F].mean(1), areas(P, F)
    along, radius = middle @ AXIS, line.radii[0]
    out = middle - along[:, None] * AXIS
    distance = np.linalg.norm(out, axis=1)
    counted = line.along[line.counts]
    here = (along > counted[0]) & (along < counted[-1]) & (distance > radius / 4) & (weight > 0)
    normals = np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]])[here]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    cosine = np.einsum("ij,ij->i", normals, out[here]) / distance[here]
    angle, off, weight = np.degrees(np.arccos(np.clip(cosine, -1, 1))), distance[here] - radius, weight[here]
    if not len(weight):
        return np.nan, np.nan
    mean = np.average(off, weights=weight)
    return np.sqrt(np.average(angle**2, weights=weight)), np.sqrt(np.average((off - mean)**2, weights=weight))


def measured(phantom, spacing):
    """For each way and line of a phantom: radii found and true at the stations that count, vertices, roughness, scatter."""
    origin, inside = phantom.mask(np.array(spacing))
    with tempfile.TemporaryDirectory() as folder:
        made = surfaces((origin, inside, spacing), folder)
    rows = []
    for way in WAYS:
        P, F = made[way]
        cuts = Cuts(P, F)
        for line in phantom.lines:
            at = line.counts.astype(bool)
            if not at.any():
                continue
            found = np.sqrt(cuts.areas(line.points[at], line.directions[at], line.radii[at]) / np.pi)
            rough, scatter = wall(P, F, line) if phantom.profile else (np.nan, np.nan)
            rows.append(dict(phantom=phantom.name, spacing=spacing, way=way, line=line.name, true=line.radii[at],
                             found=np.nan_to_num(found), vertices=len(np.unique(F)), rough=rough, scatter=scatter))
    return rows


def voxel(row):
    return np.prod(row["spacing"]) ** (1 / 3)


def in_class(row, low, high):
    across = 2 * row["true"] / voxel(row)
    return (across >= low - 1e-9) & (across < high - 1e-9)


def summary(rows, way, low, high):
    """Mean and worst error of the radius, and the mean error of the cross-section's area, in percent."""
    own = [(row["true"][here], row["found"][here]) for row in rows
           if row["way"] == way and (here := in_class(row, low, high)).any()]
    if not own:
        return None
    true, found = (np.concatenate(part) for part in zip(*own))
    percent = 100 * (found / true - 1)
    return percent.mean(), worst(percent), 100 * ((found**2).sum() / (true**2).sum() - 1)


def table(rows):
    """A row for each way."""
    title = lambda low, high: f"{low} to {high} voxels" if high < np.inf else f"{low} and more"  # noqa: E731
    heads = [title(*of) for of in CLASSES]
    lines = [f"| way | {' | '.join(heads)} | volume | roughness | scatter | vertices |", "|---|" + "---:|" * (len(CLASSES) + 4)]
    base = sum(row["vertices"] for row in rows if row["way"] == WAYS[0])
    for way in WAYS:
        cells = [summary(rows, way, *of) for of in CLASSES]
        cells = ["–" if cell is None else f"{cell[0]:+.1f}, {cell[1]:+.1f} %" for cell in cells]
        own = [row for row in rows if row["way"] == way]
        volume = summary(rows, way, 0, np.inf)[2]
        straight = [row for row in own if np.isfinite(row["rough"])]
        rough = np.sqrt(np.mean([row["rough"]**2 for row in straight])) if straight else np.nan
        scatter = np.sqrt(np.mean([(row["scatter"] / voxel(row))**2 for row in straight])) if straight else np.nan
        vertices = 100 * sum(row["vertices"] for row in own) / base
        lines.append(f"| {way} | {' | '.join(cells)} | {volume:+.1f} % | {rough:.1f}° | {scatter:.3f} | {vertices:.0f} % |")
    return "\n".join(lines)


def details(rows):
    """A row for each vessel, grid and way."""
    lines = ["| vessel | grid mm | voxels across | way | radius %, mean | radius %, worst | area % | roughness deg | scatter mm | vertices |"]
    for row in rows:
        percent = 100 * (row["found"] / row["true"] - 1)
        area = 100 * ((row["found"]**2).sum() / (row["true"]**2).sum() - 1)
        across = 2 * row["true"] / voxel(row)
        number = lambda value, digits: f"{value:.{digits}f}" if np.isfinite(value) else ""  # noqa: E731
        name = row["phantom"] if row["line"] == row["phantom"] else f"{row['phantom']}: {row['line']}"
        cells = [name.replace(",", ""), " x ".join(map(str, row["spacing"])), f"{across.min():.1f} to {across.max():.1f}",
                 row["way"].replace(",", " and"), f"{percent.mean():+.2f}", f"{worst(percent):+.2f}", f"{area:+.2f}",
                 number(row["rough"], 2), number(row["scatter"], 4), str(row["vertices"])]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


#: Begins a program from a small one: its peak is at least that of the one that began it.
MEASURE = """import resource, subprocess, sys, time
began = time.perf_counter()
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
print(time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)"""


def used(command):
    """Seconds and peak MB of a program, on one core."""
    ran = subprocess.run([sys.executable, "-c", MEASURE, *command], capture_output=True, text=True, check=True,
                         env=os.environ | {"RAYON_NUM_THREADS": "1"})
    seconds, memory = ran.stdout.split()
    return float(seconds), int(memory)


def masks(folder):
    """Name, file and voxels along the axes of real masks: one that is one, and a scan's values from 600 on."""
    yield "`seqseg_PA000016_mask.nii.gz`", DATA / "volumes" / "seqseg_PA000016_mask.nii.gz"
    reader = vtk.vtkMetaImageReader()
    reader.SetFileName(str(DATA / "volumes" / "vmtk_aorta_mra.mha"))
    reader.Update()
    scan = reader.GetOutput()
    inside = vtk_to_numpy(scan.GetPointData().GetScalars()).reshape(scan.GetDimensions()[::-1]) >= 600
    file = Path(folder) / "aorta.mha"
    write_mask(file, scan.GetOrigin(), inside.astype(np.uint8), scan.GetSpacing())
    yield "`vmtk_aorta_mra.mha` from 600 on", file


def cost():
    """Time and memory on real masks."""
    lines = ["| mask | way | vertices | time | memory |", "|---|---|---:|---:|---:|"]
    with tempfile.TemporaryDirectory() as folder:
        for name, file in masks(folder):
            for way, *command in [(WAYS[0], PROGRAM, "surface", file, "--label", "1", "--surface-by", "cubes", "-o"),
                                  (WAYS[3], PROGRAM, "surface", file, "--label", "1", "--surface-by", "nets", "-o"),
                                  (WAYS[5], sys.executable, Path(__file__).with_name("nets.py"), "--write", file)]:
                out = Path(folder) / "out.ply"
                seconds, memory = min(used([*map(str, command), str(out)]) for _ in range(3))
                vertices = len(np.unique(read_ply(out)[0], axis=0))
                lines.append(f"| {name} | {way} | {vertices:,} | {seconds:.1f} s | {memory} MB |")
    return "\n".join(lines)


def main(names):
    chosen = [(tube(d), spacing) for spacing in SPACINGS for d in DIAMETERS if d / np.prod(spacing) ** (1 / 3) >= 2]
    chosen += [(sample(name), spacing) for name, spacing in CT.items()]
    rows = []
    for phantom, spacing in chosen:
        if not names or any(name in phantom.name for name in names):
            rows += measured(phantom, spacing)
            print(phantom.name, spacing, len(rows), file=sys.stderr, flush=True)
    if not rows:
        sys.exit(f"no phantom has a name with {' or '.join(names)} in it")
    if names:
        print(table(rows))
        return
    write_rows("benchmarks/masks.csv", details(rows))
    document("scans.md", "masks", f"{table(rows)}\n\n{cost()}")


if __name__ == "__main__":
    main(sys.argv[1:])
