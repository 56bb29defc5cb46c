"""Lumen's measures beside those of Open3D, MeshLab, trimesh and VTK, on the same surfaces, as CSV (docs/measures.md).

    judge python benches/peers/measures.py PROGRAM FOLDER FILE...

`judge` is `../shared/judge/judge`; PROGRAM is a build of `lumen`. Each file is measured as it is (`lumen inspect`), smoothed
(pass band 0.1, 60 iterations) and reduced by 90 % (`lumen optimise`); what Lumen says of each is compared with what the
others say of the same file.
"""
import csv, json, subprocess, sys, tempfile
from pathlib import Path

import numpy as np
import open3d as o3d
import trimesh
from surfaces import area, distance, facts, read, self_intersections, shape, volume

SHAPE = ("| surface | triangles | area mm2 | volume mm3 | roughness RMS | p95 | smallest angle | < 10 degrees, % | "
         "self-intersecting | smallest lumen mm |")
DEVIATION = "| surface | mean | RMS | p95 | max | Open3D there |"
SETTINGS = ["--smoothing", "paper", "--pass-band", "0.1", "--iterations", "60"]


def write_rows(path, lines):
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([c.strip() for c in line[1:-1].split("|")] for line in lines)


def lumen(*arguments):
    run = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if run.returncode:
        raise SystemExit(f"{arguments}: {run.stderr}")
    return run.stdout


def roughness(P, F):
    """RMS and 95th percentile of trimesh's angles between neighbouring faces, in degrees, slivers of no area left out."""
    mesh = trimesh.Trimesh(P, F, process=False)
    angles = np.degrees(mesh.face_adjacency_angles)
    both = mesh.area_faces[mesh.face_adjacency].min(axis=1) > 0
    angles = angles[both & np.isfinite(angles)]
    return (float(np.sqrt((angles**2).mean())), float(np.percentile(angles, 95))) if len(angles) else (0.0, 0.0)


def clearance(P, F, at):
    """Open3D's distance of a point from a surface, in its units."""
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.core.Tensor(P.astype(np.float32)), o3d.core.Tensor(F.astype(np.uint32)))
    return float(scene.compute_distance(o3d.core.Tensor(np.array([at], np.float32))).numpy()[0])


def lumen_shape(program, path):
    found = json.loads(lumen(program, "inspect", "--json", "--unit", "mm", path))
    rough, angles, narrow = found["roughness"] or dict(rms_deg=0, p95_deg=0), found["angles"], found["smallest_lumen"]
    return found, rough, angles, narrow


def shape_row(program, path, name):
    found, rough, angles, narrow = lumen_shape(program, path)
    P, F = read(str(path))
    s, (rms, p95) = shape(P, F), roughness(P, F)
    inside = 2 * clearance(P, F, narrow["at_mm"]) if narrow else None
    v = found["volume_mm3"]
    pairs = [(len(F), found["triangles"] - found["degenerate_triangles"], "d"),
             (area(P, F).sum(), found["area_mm2"], ".6g"), (volume(P, F), v, ".6g"),
             (rms, rough["rms_deg"], ".3f"), (p95, rough["p95_deg"], ".3f"), (s["min_angle"], angles["min_deg"], ".3f"),
             (s["below_10_percent"], angles["below_10_percent"], ".3f"),
             # MeshLab's epsilon is 1e-6 in the square of the unit: in metres it hides what crosses.
             (self_intersections(P * 1e5, F), found["self_intersecting_faces"], "d"),
             (inside, narrow and narrow["diameter_mm"], ".3g")]
    cell = lambda a, b, f: " / ".join("–" if x is None else format(x, f) for x in (b, a))
    print(name, flush=True)
    return f"| {name} | " + " | ".join(cell(*pair) for pair in pairs) + " |"


def deviation_row(program, path, folder):
    smoothed, reduced, report = folder / "smoothed.ply", folder / "reduced.ply", folder / "report.json"
    lumen(program, "optimise", path, "-o", smoothed, "--reduction", 0, *SETTINGS)
    lumen(program, "optimise", path, "-o", reduced, "--reduction", 90, *SETTINGS, "--report", report)
    ours = json.loads(report.read_text())["deviation_mm"]
    A, B = read(str(smoothed)), read(str(reduced))
    theirs = distance(A, B)
    # Where Lumen says the largest deviation is, Open3D has the two points that far from the other surface.
    at = [clearance(*B, ours["max_at_mm"][0]), clearance(*A, ours["max_at_mm"][1])]
    cells = [f"{ours[k]:.4f} / {theirs[k]:.4f}" for k in ("mean", "rms", "p95", "max")]
    return f"| {path.name} | " + " | ".join(cells) + f" | {max(at):.4f} |", smoothed, reduced


def main(program, out, files):
    shapes, deviations = [], []
    for path in map(Path, files):
        shapes.append(shape_row(program, path, path.name))
        with tempfile.TemporaryDirectory() as folder:
            row, smoothed, reduced = deviation_row(program, path, Path(folder))
            deviations.append(row)
            shapes.append(shape_row(program, smoothed, f"{path.name}, smoothed"))
            shapes.append(shape_row(program, reduced, f"{path.name}, 90 %"))
    write_rows(Path(out) / "measures-shape.csv", [SHAPE, *shapes])
    write_rows(Path(out) / "measures-deviation.csv", [DEVIATION, *deviations])


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3:])
