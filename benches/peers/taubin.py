"""Roughness, volume and self-intersections after Lumen's smoothing and after vmtk's, into docs/benchmarks/calibre.md.

    python taubin.py [NAME...]

vmtksurfacesmoothing with its method "taubin" is vtkWindowedSincPolyDataFilter on normalised coordinates; its script has one
iteration and a pass band of 1.0 as defaults, its tutorial 30 and 0.1. With names, only files whose name holds one of them.
"""
import sys
import tempfile
from pathlib import Path

from quality import volume
from real import crossing, files, read, roughness
from sections import document, optimise, windowed_sinc, write_ply

#: Pass band and iterations of vmtk's script (vmtkScripts/vmtksurfacesmoothing.py) and of its tutorial.
SCRIPT, TUTORIAL = (1.0, 1), (0.1, 30)

HEAD = """| surface | triangles | roughness opened | Lumen | vmtk, defaults | vmtk, tutorial | volume %: Lumen | defaults | tutorial | crossing: opened | Lumen | defaults | tutorial | as rough at most as vmtk's defaults leave it | as its tutorial |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|---|"""


def row(file):
    with tempfile.TemporaryDirectory() as folder:
        whole = Path(folder) / "opened.ply"
        write_ply(whole, read(file))
        # What Lumen keeps of it, unchanged: the same surface for all.
        opened, _ = optimise(whole, folder, "--smoothing", "none", "--reduction", 0)
        ours, report = optimise(whole, folder, "--smoothing", "auto", "--reduction", 0)
    surfaces = [ours, *(windowed_sinc(opened, *setting, window=None, normalise=True) for setting in [SCRIPT, TUTORIAL])]
    before = volume(*opened)
    rough = [roughness(*surface) for surface in [opened, *surfaces]]
    gained = [100 * (volume(*surface) / before - 1) for surface in surfaces]
    crossed = [int(crossing(*surface).sum()) for surface in [opened, *surfaces]]
    says = ["met" if rough[1] <= rough[2 + i] else f"**missed**: {rough[1]:.2f} > {rough[2 + i]:.2f}" for i in range(2)]
    cells = [f"`{file.name}`", f"{len(opened[1]):,}", *(f"{r:.2f}" for r in rough), *(f"{v:+.2f}" for v in gained), *map(str, crossed), *says]
    print(cells, *report["warnings"], file=sys.stderr, flush=True)
    return "| " + " | ".join(cells) + " |"


def main(names):
    chosen = [file for file in files() if not names or any(name in file.name for name in names)]
    text = "\n".join([HEAD, *map(row, chosen)])
    print(text) if names else document("benchmarks/calibre.md", "taubin", text)


if __name__ == "__main__":
    main(sys.argv[1:])
