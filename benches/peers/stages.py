"""Lumen's stages beside VTK's, on the same files, in turn, one thread each, as a Markdown table.

    judge python benches/peers/stages.py PROGRAM FILE...

`judge` is `../shared/judge/judge`, which brings VTK and the distance measure that are used here (neither is Lumen's own);
PROGRAM is a release build of `lumen`. Pass band 0.01, 100 iterations, Hamming: the paper's setting. Times are medians of
RUNS runs in milliseconds; Lumen's are those of its own report, VTK's are taken around `Update()` of each filter.
"""
import json, statistics, subprocess, sys, tempfile, time
from pathlib import Path

import vtk
from surfaces import arrays, decimate_pro, distance, facts, polydata, read, self_intersections, shape, volume

RUNS = 7
RATES = [10, 50, 75, 90, 99]


def timed(filter):
    start = time.perf_counter()
    filter.Update()
    return (time.perf_counter() - start) * 1e3, filter.GetOutput()


def vtk_stages(surface):
    connectivity = vtk.vtkPolyDataConnectivityFilter(); connectivity.SetInputData(surface)
    connectivity.SetExtractionModeToLargestRegion()
    clean = vtk.vtkCleanPolyData(); clean.SetInputConnection(connectivity.GetOutputPort()); clean.PointMergingOff()
    ms_connectivity, kept = timed(clean)
    smooth = vtk.vtkWindowedSincPolyDataFilter(); smooth.SetInputData(kept); smooth.SetPassBand(0.01)
    smooth.SetNumberOfIterations(100); smooth.SetWindowFunctionToHamming()
    ms_smoothing, smoothed = timed(smooth)
    ms_decimation = 0
    for rate in RATES:
        decimate = vtk.vtkDecimatePro(); decimate.SetInputData(smoothed)
        decimate.SetTargetReduction(rate / 100); decimate.PreserveTopologyOn()
        ms_decimation += timed(decimate)[0]
    return dict(connectivity=ms_connectivity, smoothing=ms_smoothing, decimation=ms_decimation)


def lumen_stages(program, file, folder):
    report = folder / "report.json"
    subprocess.run([program, "optimise", file, "-o", folder / "out.ply", "--report", report],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads(report.read_text())["stages_ms"]


def lumen_surface(program, file, folder, rate):
    out = str(folder / "level.ply")
    subprocess.run([program, "optimise", file, "-o", out, "--reduction", str(rate)],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return read(out)


def quality(surface, reference):
    d, counts, form = distance(reference, surface), facts(*surface), shape(*surface)
    change = (volume(*surface) / volume(*reference) - 1) * 100
    return (f"{counts['triangles']} | {d['mean']:.4f} | {d['max']:.3f} | {change:+.3f} | {form['below_10_percent']:.1f} | "
            f"{self_intersections(*surface)} | {counts['components']} | {counts['nonmanifold']} | {counts['euler']}")


def main(program, files):
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()}, one thread, medians of {RUNS} runs in turn\n")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in files:
            surface, ours, theirs = polydata(*read(file)), [], []
            for _ in range(RUNS):
                ours.append(lumen_stages(program, file, folder))
                theirs.append(vtk_stages(surface))
            print(f"### {Path(file).name}\n\n| stage | Lumen ms | VTK ms | ratio |\n|---|---|---|---|")
            for stage, what in [("connectivity", "connectivity and compaction"), ("smoothing", "smoothing, 100 iterations"),
                                ("decimation", "decimation to 10, 50, 75, 90, 99 %: all levels / five runs")]:
                a, b = (statistics.median(run[stage] for run in runs) for runs in (ours, theirs))
                print(f"| {what} | {a:.1f} | {b:.1f} | {a / b:.2f} |")
            reference = lumen_surface(program, file, folder, 0)
            print("\n| rate, method | triangles | mean mm | max mm | volume % | angle < 10, % | self-intersecting | pieces | "
                  "non-manifold | Euler |\n|---|---|---|---|---|---|---|---|---|---|")
            for rate in RATES:
                print(f"| {rate} Lumen | {quality(lumen_surface(program, file, folder, rate), reference)} |")
                print(f"| {rate} DecimatePro | {quality(decimate_pro(*reference, rate / 100), reference)} |")
            print()


main(sys.argv[1], sys.argv[2:])
