"""The pictures of docs/smoothing.md: what pass bands let through, radius along phantoms, calibre error against width.

    python pictures.py

The first is drawn from the formulas of the page; the others from target/peers/phantoms.json, which `phantoms.py` leaves.
"""
import json

import numpy as np
from scipy.special import j0

from sections import PAPER, ROOT

FOLDER = ROOT / "docs/images/smoothing"
#: Colours that all can tell apart (Okabe and Ito 2008), and dashes besides.
TRUTH, OPENED, LUMEN, VTK = ("#000000", "6 4"), ("#a3a9b3", ""), ("#0072b2", ""), ("#d55e00", "9 3")
BANDS = ["#0072b2", "#009e73", "#e69f00", "#cc79a7"]


class Picture:
    """An SVG of 700 pixels' width, made of panels with axes."""

    def __init__(self, name, height, label):
        self.name, self.parts = name, [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 700 {height}" role="img" aria-label="{label}" '
            'font-family="system-ui, sans-serif" font-size="13" fill="#4b5563">',
            f'<rect width="700" height="{height}" rx="8" fill="#fbfbfc"/>']

    def text(self, x, y, text, more=""):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" {more}>{text}</text>')

    def line(self, points, colour, dash="", width=2.0):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{dashed}/>')

    def write(self):
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / f"{self.name}.svg").write_text("\n".join(self.parts) + "\n</svg>\n")


class Panel:
    """Axes in a rectangle of a picture; `x` and `y` are (low, high, ticks, whether logarithmic)."""

    def __init__(self, picture, box, x, y, x_label, y_label, title=""):
        self.picture, self.box, self.x, self.y = picture, box, x, y
        left, top, right, bottom = box
        for tick in x[2]:
            at = self.at(tick, y[0])[0]
            picture.line([(at, top), (at, bottom)], "#e2e4e8", width=1)
            picture.text(at, bottom + 17, f"{tick:g}", 'text-anchor="middle"')
        for tick in y[2]:
            at = self.at(x[0], tick)[1]
            picture.line([(left, at), (right, at)], "#e2e4e8", width=1)
            picture.text(left - 8, at + 4, f"{tick:g}", 'text-anchor="end"')
        picture.text((left + right) / 2, bottom + 35, x_label, 'text-anchor="middle"')
        middle = (top + bottom) / 2
        picture.text(0, 0, y_label, f'text-anchor="middle" transform="translate({left - 40} {middle:.0f}) rotate(-90)"')
        picture.text(left, top - 8, title, 'font-weight="600"')

    def at(self, x, y):
        left, top, right, bottom = self.box

        def part(value, axis):
            low, high, _, is_log = axis
            if is_log:
                low, high, value = np.log(low), np.log(high), np.log(max(value, low / 10))
            return min(max((value - low) / (high - low), 0), 1)
        return left + part(x, self.x) * (right - left), bottom - part(y, self.y) * (bottom - top)

    def curve(self, x, y, colour, dash="", width=2.0):
        run = []
        for a, b in [*zip(x, y), (np.nan, np.nan)]:
            if np.isnan(b):
                if len(run) > 1:
                    self.picture.line(run, colour, dash, width)
                run = []
            else:
                run.append(self.at(a, b))

    def mark(self, x, y, colour, shape):
        (a, b), parts = self.at(x, y), self.picture.parts
        if shape == "circle":
            parts.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="4.5" fill="{colour}"/>')
        elif shape == "square":
            parts.append(f'<rect x="{a - 4:.1f}" y="{b - 4:.1f}" width="8" height="8" fill="{colour}"/>')
        else:
            parts.append(f'<path d="M{a - 5:.1f} {b - 4:.1f}h10l-5 9z" fill="none" stroke="{colour}" stroke-width="1.5"/>')


def coefficients(pass_band, degree=PAPER[1]):
    """Of the windowed sinc filter (Taubin, Zhang and Golub 1996) with a Hamming window, widened until the response at the
    pass band is 1 to 1e-3, divided by their sum: src/pipeline/filter.rs."""
    n = np.arange(1, degree + 1)
    window = 0.54 + 0.46 * np.cos(n * np.pi / (degree + 1))
    theta = np.arccos(1 - pass_band / 2)

    def made(sigma):
        c = np.concatenate([[(theta + sigma) / np.pi], 2 * window * np.sin(n * (theta + sigma)) / (n * np.pi)])
        return c / c.sum()
    sigmas = np.arange(0, np.pi - theta, np.pi / (degree + 1) / 400)
    for sigma in sigmas:
        if abs(gain(made(sigma), pass_band) - 1) <= 1e-3:
            break
    return made(sigma)


def gain(c, k):
    return np.polynomial.chebyshev.chebval(1 - np.asarray(k) / 2, c)


def pass_band(radius, edge):
    """That a vessel of `radius` has (docs/smoothing.md)."""
    return max(PAPER[0], 4 * (1 + (edge / radius)**2) * (1 - j0(edge / radius)))


def gains(edge=0.6):
    picture = Picture("gain", 360, "Gain of the filter against wavelength, for the pass bands of vessels of 1 to 10 mm radius")
    panel = Panel(picture, (70, 40, 520, 300), (1.5, 150, [2, 5, 10, 20, 50, 100], True), (-0.1, 1.2, [0, 0.5, 1], False),
                  "wavelength along the surface, mm", "gain", f"edges of {edge} mm, 100 iterations")
    waves = np.geomspace(1.5, 150, 240)
    k = 1 - j0(2 * np.pi * edge / waves)
    paper = coefficients(PAPER[0])
    panel.curve(waves, gain(paper, k), "#000000", "6 4")
    entries = [("all: 0.010", "#000000", "6 4")]
    for radius, colour in zip([1, 2, 5, 10], BANDS):
        band = pass_band(radius, edge)
        around = 2 * np.pi * radius
        panel.curve(waves, gain(coefficients(band), k) + (0.012 if band == PAPER[0] else 0), colour)
        panel.curve([around, around], [-0.1, 1.2], colour, "2 3", 1.5)
        panel.mark(around, float(gain(paper, 1 - j0(edge / radius))), colour, "circle")
        entries.append((f"{radius} mm: {band:.3f}", colour, ""))
    for i, (text, colour, dash) in enumerate(entries):
        picture.line([(536, 76 + 24 * i), (562, 76 + 24 * i)], colour, dash)
        picture.text(568, 80 + 24 * i, text)
    picture.text(536, 52, "pass band of radius", 'font-weight="600"')
    picture.line([(549, 210), (549, 226)], "#4b5563", "2 3", 1.5)
    picture.text(568, 222, "circumference")
    picture.parts.append('<circle cx="549" cy="242" r="4.5" fill="#4b5563"/>')
    picture.text(568, 246, "what 0.010 leaves")
    picture.text(568, 262, "of the vessel")
    picture.write()


def read():
    found = json.loads((ROOT / "target/peers/phantoms.json").read_text())
    return {(one["name"], one["voxel"]): one for one in found}


def line_of(found, name=None):
    one = next(line for line in found["lines"] if name in (None, line["name"]))
    return {key: np.array([np.nan if v is None else v for v in value], float) for key, value in one.items() if key != "name"}


def radii(found):
    shown = [("stepped tube, 6 to 1 mm, voxels of 0.5 mm", found["stepped, 12, 8, 5, 3, 2 mm", 0.5], None, 7),
             ("cone, 3 to 1 mm, voxels of 0.5 mm", found["cone, 6 to 2 mm", 0.5], None, 3.5),
             ("a fork's branch: the renal artery of sample:aorta, voxels of 0.7 mm", found["sample:aorta", 0.7],
              "left renal artery", 7)]
    picture = Picture("radius", 740, "Radius along a stepped tube, a cone and a branch of a fork: true, opened, Lumen, VTK")
    for i, (title, one, name, high) in enumerate(shown):
        line, top = line_of(one, name), 62 + 228 * i
        length = line["along"][-1]
        ticks = np.arange(0, length, 20 if length > 60 else 10)
        panel = Panel(picture, (70, top, 675, top + 150), (0, length, ticks, False),
                      (0, high, np.arange(0, high, 2 if high > 4 else 1), False), "along the centreline, mm", "radius, mm", title)
        step = max(1, len(line["along"]) // 220)
        for key, (colour, dash), width in [("opened_single", OPENED, 5), ("vtk_single", VTK, 2), ("lumen_single", LUMEN, 2),
                                           ("truth", TRUTH, 1.5)]:
            panel.curve(line["along"][::step], line[key][::step], colour, dash, width)
    legend(picture, 24, [("true", TRUTH), ("opened", OPENED), ("Lumen, auto", LUMEN), ("VTK at 0.01, 100 iterations", VTK)])
    picture.write()


def legend(picture, y, entries):
    x = 70
    for name, (colour, dash) in entries:
        picture.line([(x, y), (x + 28, y)], colour, dash, 5 if colour == OPENED[0] else 2)
        picture.text(x + 34, y + 4, name)
        x += 60 + 7.2 * len(name)


def errors(found):
    picture = Picture("error", 380, "Worst change of calibre against the width of tubes in voxels, for Lumen and VTK")
    panel = Panel(picture, (70, 50, 675, 320), (1.9, 110, [2, 3, 5, 10, 20, 50, 100], True),
                  (0.01, 100, [0.01, 0.1, 1, 10, 100], True), "width of the tube, voxels", "largest error of the radius, %")
    panel.curve([1.9, 110], [1, 1], "#4b5563", "2 3", 1.5)
    picture.text(672, panel.at(110, 1)[1] - 5, "1 %", 'text-anchor="end" font-size="12"')
    for (name, voxel), one in found.items():
        if not name.startswith("tube") or one["pieces"] > 1:
            continue
        line = line_of(one)
        here, across = line["counts"].astype(bool), 2 * line["truth"][0] / voxel
        for key, under, (colour, _), shape in [("opened", "truth", OPENED, "open"), ("vtk", "opened", VTK, "square"),
                                               ("lumen", "opened", LUMEN, "circle")]:
            change = np.nan_to_num(line[key][here], nan=0.0) / line[under][here] - 1
            panel.mark(across, min(100 * np.abs(change).max(), 100), colour, shape)
    x = 70
    for label, (colour, _), shape in [("Lumen, auto, against opened", LUMEN, "circle"),
                                      ("VTK at 0.01, against opened", VTK, "square"), ("opened, against the truth", OPENED, "open")]:
        a, b = panel.at(1.9, 100)
        picture.parts.append(f'<g transform="translate({x + 6 - a:.1f} {22 - b:.1f})">')
        panel.mark(1.9, 100, colour, shape)
        picture.parts.append("</g>")
        picture.text(x + 17, 26, label)
        x += 215
    picture.write()


def main():
    gains()
    found = read()
    radii(found)
    errors(found)


if __name__ == "__main__":
    main()
