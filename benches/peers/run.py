"""Lumen and its peers, side by side and in turn: times, quality, memory, as one JSON file for `cargo xtask peers`.

    python run.py SETUP.json REPORT.json

SETUP names the programs, the surfaces and the number of runs (xtask/src/peers/mod.rs writes it). Each run goes through
all contenders once, so that whatever else the machine does falls on all of them. Everything but Chromium, which needs
several processes, is pinned to one core, and everything uses one thread.
"""
import json
import os
import platform
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

os.environ.update(RAYON_NUM_THREADS="1", OMP_NUM_THREADS="1")
from peers import (RATES, FastSimplification, Line, Meshoptimizer, Vtk, VtkJs, arrays, reductions, smoothing,  # noqa: E402
                   timed)
from quality import measured, polydata, read_ply  # noqa: E402

CORES = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
#: (pass band, iterations): what times are taken with, and both settings of which the quality is told.
TIMED = [(0.1, 30), (0.1, 60), (0.01, 100)]
QUALITY = [(0.1, 60), (0.01, 100)]
METHODS = ["schroeder", "quadric"]
#: Runs a command and prints the largest memory it had, in the system's unit.
PEAK = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode; "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(code)")


def pin(one):
    if CORES:
        os.sched_setaffinity(0, CORES[-1:] if one else CORES)


def say(what):
    print(f"    {what}", file=sys.stderr, flush=True)


class Lumen:
    """The release build of `lumen`; each call is a process of its own, and its times are those of its own report."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        manual = subprocess.run([program, "optimise", "--help"], check=True, capture_output=True, text=True).stdout
        self.methods = METHODS if "--method" in manual else METHODS[:1]

    def optimise(self, file, pass_band, iterations, rate, method="schroeder", name="level.ply"):
        """The report, the surface's file and the peak memory in bytes."""
        # A process of its own in between: what one forks from counts as its own memory, and this one is large.
        between = [sys.executable, "-c", PEAK]
        output, report = self.folder / name, self.folder / "report.json"
        command = [self.program, "optimise", file, "-o", output, "--report", report, "--smoothing", "paper",
                   "--pass-band", str(pass_band), "--iterations", str(iterations), "--reduction", str(rate), "--window", "hamming"]
        command += ["--method", method] if len(self.methods) > 1 else []
        done = subprocess.run(between + command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"lumen failed: {done.stderr}")
        peak = int(done.stdout.split()[-1]) * (1 if sys.platform == "darwin" else 1024)
        return json.loads(report.read_text()), output, peak

    def run(self, file):
        """Milliseconds of each stage, and what they were taken with and came to."""
        ms, made = {}, {}
        for method in self.methods:
            prefix = "lumen" if method == METHODS[0] else f"lumen.{method}"
            report, _, _ = self.optimise(file, 0.1, 60, 90, method)
            keep(ms, prefix, report, 60)
            made[method] = dict(settings=report["settings"], fingerprint=report["output_fingerprint"])
        for pass_band, iterations in TIMED:
            if iterations != 60:
                report, _, _ = self.optimise(file, pass_band, iterations, 90)
                ms[f"lumen.smoothing{iterations}"] = report["stages_ms"]["smoothing"]
            if pass_band == 0.01:
                keep(ms, "lumen.paper", report, iterations)
                ms["lumen.paper.deviation"] = report["stages_ms"]["deviation"]
                ms["lumen.paper.measures"] = report["stages_ms"]["measures"]
        report, _, _ = self.optimise(file, 0.1, 60, 0)
        ms["lumen.normals"], ms["lumen.level0"] = report["stages_ms"]["normals"], report["stages_ms"]["level"]
        return ms, made


def keep(ms, prefix, report, iterations):
    """The times of a whole run to 90 %."""
    stages = report["stages_ms"]
    for stage in ["connectivity", "adjacency", "areas", "decimation"]:
        ms[f"{prefix}.{stage}"] = stages[stage]
    ms[f"{prefix}.smoothing{iterations}"] = stages["smoothing"]
    ms[f"{prefix}.level90"], ms[f"{prefix}.normals90"] = stages["level"], stages["normals"]


class LumenInBrowser:
    """The same in dist/'s Worker."""

    def __init__(self, setup):
        pin(False)
        self.line = Line(["node", setup["browser"]], env=os.environ | setup["environment"])
        pin(True)

    def run(self, file, made):
        ms, fingerprints = {}, {}
        for method, native in made.items():
            prefix = "wasm" if method == METHODS[0] else f"wasm.{method}"
            settings = native["settings"]
            steps = [settings]
            if method == METHODS[0]:
                # Another rate, another pass band alone, other filters.
                steps.append(settings | dict(target={"Reduction": 0}))
                others = [(0.05, 60)] + [pair for pair in TIMED if pair[1] != 60]
                for pass_band, iterations in others:
                    filter = settings["smoothing"] | dict(pass_band=pass_band, iterations=iterations)
                    steps.append(settings | dict(smoothing=filter))
            answer = self.line.ask(do="stages", file=str(file), steps=steps)
            reports = answer["reports"]
            keep(ms, prefix, reports[0], 60)
            fingerprints[method] = reports[0]["output_fingerprint"]
            if method == METHODS[0]:
                ms["wasm.normals"], ms["wasm.level0"] = (reports[1]["stages_ms"][s] for s in ["normals", "level"])
                ms["wasm.otherPassBand60"] = reports[2]["stages_ms"]["smoothing"]
                for report in reports[3:]:
                    ms[f"wasm.smoothing{report['settings']['smoothing']['iterations']}"] = report["stages_ms"]["smoothing"]
        return ms, fingerprints, answer["chromium"]


def times(file, contenders, runs, report):
    """Fills `report` with the times of `runs` runs in turn."""
    lumen, browser, native, *others = contenders
    surface = read_ply(file)
    pin(True)
    their = Vtk(polydata(*surface))
    P, F = surface = smoothed_by_vtk(their)
    report["triangles"], report["vertices"] = len(F), len(P)
    native.store(surface)
    fast, found = FastSimplification(), {}
    for run in range(runs):
        ms, report["lumen"] = lumen.run(file)
        if browser:
            more, fingerprints, report["chromium"] = browser.run(file, report["lumen"])
            ms |= more
            report["wasm_fingerprints"] = fingerprints
        for peer in [their, fast, native, *others]:
            ms |= peer.run(surface)
        for key, value in ms.items():
            found.setdefault(key, []).append(value)
        say(f"run {run + 1} of {runs}")
    report["ms"] = found


def smoothed_by_vtk(their):
    """The surface that enters decimation in VTK's pipeline: what all the peers of that stage are timed on."""
    import vtk
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputData(their.raw)
    largest.SetExtractionModeToLargestRegion()
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(largest.GetOutputPort())
    clean.PointMergingOff()
    return arrays(timed(smoothing(timed(clean)[1], 60))[1])


def qualities(file, lumen, native, settings, report):
    """What each method makes of Lumen's smoothed surface at each rate."""
    report["quality"] = []
    for pass_band, iterations in settings:
        _, path, _ = lumen.optimise(file, pass_band, iterations, 0, name="smoothed.ply")
        reference = read_ply(path)
        native.store(reference)
        makers = {}
        for method in lumen.methods:
            makers[f"Lumen {method}"] = lambda rate, method=method: read_ply(
                lumen.optimise(file, pass_band, iterations, rate, method)[1])
        makers |= reductions(reference, native)
        rows = [dict(rate=0, method="what enters", **measured(reference, reference))]
        for rate in RATES:
            for method, make in makers.items():
                rows.append(dict(rate=rate, method=method, **measured(reference, make(rate))))
            say(f"quality at {rate} %, pass band {pass_band}")
        report["quality"].append(dict(pass_band=pass_band, iterations=iterations, rows=rows))


def memory(file, lumen, browser):
    """Peak memory of `lumen optimise` as a user runs it, on all cores, and the memory that the app has at the end."""
    pin(False)
    os.environ.pop("RAYON_NUM_THREADS", None)
    told, _, peak = lumen.optimise(file, 0.01, 100, 90)
    row = dict(file=Path(file).name, triangles=told["opened"]["triangles"], native=peak)
    if browser:
        answer = browser.line.ask(do="app", file=str(file))
        row |= dict(page=answer["page"], worker=answer["worker"], seconds=answer["seconds"])
    say(f"memory of {row['file']}: {row}")
    return row


def machine():
    cpu = platform.processor()
    if Path("/proc/cpuinfo").exists():
        names = [line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line]
        cpu = names[0] if names else cpu
    return dict(cpu=cpu, cores=len(CORES) or os.cpu_count(), system=platform.platform(terse=True))


def store(report, setup, file):
    """Writes what there is so far: a run takes long, and may be stopped."""
    chromium = {"Chromium": entry["chromium"] for entry in report["surfaces"] if "chromium" in entry}
    report["versions"] = {"VTK": version("vtk"), "fast-simplification": version("fast-simplification"),
                          "Open3D": version("open3d"), "MeshLab (pymeshlab)": version("pymeshlab"),
                          "Python": platform.python_version(), **chromium, **setup["versions"]}
    Path(file).write_text(json.dumps(report, indent=1))


def main(setup_file, report_file):
    setup = json.loads(Path(setup_file).read_text())
    report = dict(machine=machine(), surfaces=[], memory=[])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        lumen = Lumen(setup["lumen"], folder)
        browser = LumenInBrowser(setup) if setup["browser"] else None
        pin(True)
        native = Meshoptimizer("meshopt", [setup["meshoptimizer"]], folder)
        wasm = Meshoptimizer("meshoptWasm", ["node", setup["meshoptimizer_wasm"], setup["peers_npm"]], folder)
        # It runs on what the one before has stored.
        vtkjs = VtkJs(["node", setup["vtkjs"], setup["peers_npm"]], folder)
        for surface in setup["surfaces"]:
            say(surface["name"])
            entry = dict(name=surface["name"], runs=surface["runs"], quality=[])
            times(surface["file"], (lumen, browser, native, wasm, vtkjs), surface["runs"], entry)
            report["surfaces"].append(entry)
            store(report, setup, report_file)
            pin(False)
            qualities(surface["file"], lumen, native, QUALITY[:surface["qualities"]], entry)
            store(report, setup, report_file)
        for line in [native.line, wasm.line, vtkjs.line]:
            line.close()
        for file in setup["memory"]:
            report["memory"].append(memory(file, lumen, browser))
            store(report, setup, report_file)
        if browser:
            browser.line.close()


main(*sys.argv[1:])
