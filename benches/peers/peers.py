"""The peers, each as a class whose `run` does its stages once and gives the milliseconds of each.

VTK and fast-simplification run in this process, meshoptimizer (native, and WebAssembly in Node) and vtk.js (in Node) in
processes of their own, which stay warm from run to run. One thread each.
"""
import json
import subprocess
import time

import fast_simplification
import numpy as np
import vtk

from quality import arrays, polydata

RATES = [10, 50, 75, 90, 99]
ITERATIONS = [30, 60, 100]

vtk.vtkSMPTools.SetBackend("Sequential")
vtk.vtkSMPTools.Initialize(1)


def timed(step):
    """Milliseconds of a filter's update, and what it made."""
    begun = time.perf_counter()
    step.Update()
    return (time.perf_counter() - begun) * 1e3, step.GetOutput()


def smoothing(surface, iterations, pass_band=0.1):
    step = vtk.vtkWindowedSincPolyDataFilter()
    step.SetInputData(surface)
    step.SetPassBand(pass_band)
    step.SetNumberOfIterations(iterations)
    step.SetWindowFunctionToHamming()
    return step


def decimate_pro(surface, rate):
    step = vtk.vtkDecimatePro()
    step.SetInputData(surface)
    step.SetTargetReduction(rate / 100)
    step.PreserveTopologyOn()
    return step


def quadric(surface, rate):
    step = vtk.vtkQuadricDecimation()
    step.SetInputData(surface)
    step.SetTargetReduction(rate / 100)
    return step


class Vtk:
    """VTK's filters, in the order of the paper."""

    def __init__(self, raw):
        self.raw = raw

    def run(self, _):
        ms = {}
        largest = vtk.vtkPolyDataConnectivityFilter()
        largest.SetInputData(self.raw)
        largest.SetExtractionModeToLargestRegion()
        clean = vtk.vtkCleanPolyData()
        clean.SetInputConnection(largest.GetOutputPort())
        clean.PointMergingOff()
        ms["vtk.connectivity"], kept = timed(clean)
        for iterations in ITERATIONS:
            ms[f"vtk.smoothing{iterations}"], smooth = timed(smoothing(kept, iterations))
            if iterations == 60:
                smoothed = smooth
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputData(smoothed)
        normals.SplittingOff()
        ms["vtk.normals"], _ = timed(normals)
        for rate in RATES:
            ms[f"vtk.pro{rate}"], _ = timed(decimate_pro(smoothed, rate))
            ms[f"vtk.quadric{rate}"], _ = timed(quadric(smoothed, rate))
        # The paper's setting, which is Lumen's default.
        ms["vtk.paper.smoothing100"], smoothed = timed(smoothing(kept, 100, 0.01))
        ms["vtk.paper.pro90"], _ = timed(decimate_pro(smoothed, 90))
        return ms


class FastSimplification:
    """fast-simplification, which is Forstmann's method."""

    def run(self, surface):
        ms, (P, F) = {}, surface
        P, F = np.ascontiguousarray(P, np.float32), np.ascontiguousarray(F, np.int32)
        for rate in RATES:
            begun = time.perf_counter()
            fast_simplification.simplify(P, F, target_reduction=rate / 100)
            ms[f"fast{rate}"] = (time.perf_counter() - begun) * 1e3
        return ms


class Line:
    """A process that answers a line of JSON with a line of JSON."""

    def __init__(self, command, **options):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, **options)

    def ask(self, **question):
        self.process.stdin.write(json.dumps(question) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise SystemExit(f"{self.process.args[0]} ended without an answer")
        return json.loads(answer)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Meshoptimizer:
    """meshoptimizer, from the surface in `folder`."""

    def __init__(self, name, command, folder):
        self.name, self.line, self.folder = name, Line(command), folder

    def store(self, surface):
        """Where the surface lies from now on."""
        P, F = surface
        np.ascontiguousarray(P, "<f4").tofile(self.folder / "positions")
        np.ascontiguousarray(F, "<u4").tofile(self.folder / "indices")

    def ask(self, **question):
        return self.line.ask(positions=str(self.folder / "positions"), indices=str(self.folder / "indices"), **question)

    def run(self, _):
        answer = self.ask(rates=RATES)
        return {f"{self.name}{rate}": ms for rate, ms in zip(RATES, answer["ms"])}

    def surface(self, rate, update):
        """The surface at one rate; with `update` its vertices have moved to where the error is least."""
        output = self.folder / "reduced"
        self.ask(rates=[rate], update=update, output=str(output))
        P = np.fromfile(f"{output}.positions", "<f4").reshape(-1, 3).astype(float)
        return P, np.fromfile(f"{output}.indices", "<u4").reshape(-1, 3).astype(np.int64)


class VtkJs:
    """vtk.js, from the surface that another peer has stored in `folder`."""

    def __init__(self, command, folder):
        self.line, self.folder = Line(command), folder

    def run(self, _):
        answer = self.line.ask(positions=str(self.folder / "positions"), indices=str(self.folder / "indices"),
                               iterations=ITERATIONS)
        ms = {f"vtkjs.smoothing{n}": ms for n, ms in zip(ITERATIONS, answer["smoothing"])}
        return ms | {"vtkjs.normals": answer["normals"]}


def reductions(reference, native):
    """The peers' surfaces at each rate, by name, all made from `reference`, as functions of the rate."""
    data, (P, F) = polydata(*reference), reference

    def fast(rate):
        points, corners = fast_simplification.simplify(np.ascontiguousarray(P, np.float32),
                                                       np.ascontiguousarray(F, np.int32), target_reduction=rate / 100)
        return points.astype(float), corners.astype(np.int64)

    return {
        "DecimatePro, topology kept": lambda rate: arrays(timed(decimate_pro(data, rate))[1]),
        "vtkQuadricDecimation": lambda rate: arrays(timed(quadric(data, rate))[1]),
        "fast-simplification": fast,
        "meshoptimizer": lambda rate: native.surface(rate, False),
        "meshoptimizer, vertices updated": lambda rate: native.surface(rate, True),
    }
