"""The phantoms: straight vessels of known radius, and the two samples from the coordinates in src/phantom.

Each is a `Phantom`: centrelines with radii, and whether a point lies in the lumen. `masked` makes of it what a
segmentation gives: a binary mask at a spacing, cut by VTK's marching cubes (flying edges) halfway between in and out.
"""
import re
from dataclasses import dataclass, field

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from quality import arrays
from sections import ROOT

#: The axis of straight vessels leans against the grid in all directions; the grid begins somewhere in a voxel.
AXIS = np.array([0.36, 0.21, 0.91]) / np.linalg.norm([0.36, 0.21, 0.91])
SHIFT = np.array([0.17, 0.59, 0.41])
#: Share of a branch's radius that the fillet at its origin has (src/phantom/field.rs).
FILLET = 0.45


@dataclass
class Line:
    """A centreline: points, directions, radii and arc lengths, and the stations at which its calibre is judged."""
    name: str
    points: np.ndarray
    directions: np.ndarray
    radii: np.ndarray
    along: np.ndarray
    counts: np.ndarray


@dataclass
class Phantom:
    name: str
    lines: list
    #: Parts as (fillet, cones), joined one after another; a cone is (start, end, radius, end radius).
    parts: list = field(default_factory=list)
    #: Or radius by arc length along AXIS, and the length.
    profile: tuple = ()
    #: Where vessels leave the volume: point, direction outward, radius.
    open_ends: list = field(default_factory=list)

    def grid(self, spacing):
        """Origin and size of the grid; the spacing is in mm, one number or one for each axis, here and below."""
        points = np.concatenate([line.points for line in self.lines])
        radii = np.concatenate([line.radii for line in self.lines])
        low = (points - radii[:, None]).min(0) - (4 + SHIFT) * spacing - 6 * bool(self.parts)
        high = (points + radii[:, None]).max(0) + 4 * spacing + 6 * bool(self.parts)
        return low, np.ceil((high - low) / spacing).astype(int) + 1

    def mask(self, spacing):
        origin, size = self.grid(spacing)
        if self.profile:
            return origin, self.straight(origin, size, spacing)
        return origin, self.joined(origin, size, spacing)

    def straight(self, origin, size, spacing):
        radius, length = self.profile
        spacing = np.broadcast_to(spacing, 3)
        inside = np.zeros(size[::-1], np.uint8)
        y, x = np.meshgrid(*(origin[i] + spacing[i] * np.arange(size[i]) for i in [1, 0]), indexing="ij")
        for k in range(size[2]):
            z = origin[2] + spacing[2] * k
            s = x * AXIS[0] + y * AXIS[1] + z * AXIS[2]
            across = np.sqrt(np.maximum(x * x + y * y + z * z - s * s, 0))
            inside[k] = (s > 0) & (s < length) & (across < radius(np.clip(s, 0, length)))
        return inside

    def joined(self, origin, size, spacing):
        """Round cones, joined by the polynomial smooth minimum, as src/phantom/field.rs has it."""
        whole, far, spacing = None, np.float32(1e3), np.broadcast_to(spacing, 3)
        for fillet, cones in self.parts:
            part = np.full(size[::-1], far, np.float32)
            for start, end, r0, r1 in cones:
                reach = max(r0, r1) + fillet + 2 * spacing
                low = np.maximum(np.floor((np.minimum(start, end) - reach - origin) / spacing).astype(int), 0)
                high = np.minimum(np.ceil((np.maximum(start, end) + reach - origin) / spacing).astype(int) + 1, size)
                x, y, z = (np.float32(origin[i] - start[i] + spacing[i] * np.arange(low[i], high[i])) for i in range(3))
                x, y, z = x[None, None], y[None, :, None], z[:, None, None]
                d = (end - start).astype(np.float32)
                t = np.clip((x * d[0] + y * d[1] + z * d[2]) / max(float(d @ d), 1e-12), 0, 1)
                distance = np.sqrt((x - t * d[0])**2 + (y - t * d[1])**2 + (z - t * d[2])**2)
                distance -= np.float32(r0) + np.float32(r1 - r0) * t
                box = part[low[2]:high[2], low[1]:high[1], low[0]:high[0]]
                np.minimum(box, distance, out=box)
            if whole is None:
                whole = part
                continue
            near = np.argwhere((part < far).any((1, 2))).ravel()
            a, b = whole[near[0]:near[-1] + 1], part[near[0]:near[-1] + 1]
            h = np.maximum(np.float32(fillet) - np.abs(a - b), 0)
            a[...] = np.minimum(a, b) - (h * h / np.float32(4 * fillet) if fillet else 0)
        return (whole < 0).astype(np.uint8)

    def masked(self, spacing):
        """The stair-stepped surface of the mask, without the triangles behind open ends."""
        origin, inside = self.mask(spacing)
        image = vtk.vtkImageData()
        image.SetDimensions(*inside.shape[::-1])
        image.SetSpacing(spacing, spacing, spacing)
        image.SetOrigin(*origin)
        image.GetPointData().SetScalars(numpy_to_vtk(inside.ravel(), deep=1, array_type=vtk.VTK_UNSIGNED_CHAR))
        cubes = vtk.vtkFlyingEdges3D()
        cubes.SetInputData(image)
        cubes.SetValue(0, 0.5)
        cubes.ComputeNormalsOff()
        cubes.ComputeGradientsOff()
        cubes.ComputeScalarsOff()
        cubes.Update()
        P, F = arrays(cubes.GetOutput())
        middle, kept = P[F].mean(1), np.ones(len(F), bool)
        for point, outward, radius in self.open_ends:
            from_end = middle - point
            kept &= (from_end @ outward < -1.5 * spacing) | (np.linalg.norm(from_end, axis=1) > radius + 4 * spacing)
        return P, F[kept]


def straight(name, length, radius, counts):
    """A vessel along AXIS; `counts` says of each arc length whether its calibre is judged."""
    along = np.arange(0, length, 0.23 if radius(np.array([0.0]))[0] < 5 else 0.47)
    points = along[:, None] * AXIS
    line = Line(name, points, np.broadcast_to(AXIS, points.shape), radius(along), along, counts(along))
    ends = [(s * AXIS, sign * AXIS, float(radius(np.array([s]))[0])) for s, sign in [(0.0, -1), (length - 1e-6, 1)]]
    return Phantom(name, [line], profile=(radius, length), open_ends=ends)


def tube(diameter):
    margin = max(diameter, 6)
    length = 2 * margin + max(diameter, 12)
    return straight(f"tube, {diameter} mm", length, lambda s: np.full(np.shape(s), diameter / 2),
                    lambda s: (s > margin) & (s < length - margin))


def stepped(diameters=(12, 8, 5, 3, 2), step=20):
    """Each as long as `step` mm; judged in the middle of each, half a step's length."""
    radii = np.array(diameters) / 2

    def radius(s):
        return radii[np.minimum(s // step, len(radii) - 1).astype(int)]

    return straight("stepped, " + ", ".join(map(str, diameters)) + " mm", step * len(radii), radius,
                    lambda s: np.abs(s % step - step / 2) < step / 4)


def cone(diameter, end, length):
    return straight(f"cone, {diameter} to {end} mm", length, lambda s: (diameter + (end - diameter) * s / length) / 2,
                    lambda s: (s > diameter) & (s < length - 6))


#: Lengths of a stenosis in mm: what is healthy on each side, the way in and out, and where it is narrowest.
HEALTHY, RAMP, NARROW = 24, 8, 4


def stenosis(diameter, degree=0.7):
    """A narrow place with ways in and out in the form of a cosine."""
    length = 2 * (HEALTHY + RAMP) + NARROW

    def radius(s):
        from_middle = np.abs(s - length / 2) - NARROW / 2
        return diameter / 2 * (1 - degree * (1 + np.cos(np.pi * np.clip(from_middle / RAMP, 0, 1))) / 2)

    return straight(f"stenosis of {100 * degree:.0f} %, {diameter} mm", length, radius,
                    lambda s: (s > diameter + 3) & (s < length - diameter - 3))


# The samples.

def spline(p, along):
    """The centripetal Catmull-Rom span from p[1] (at 0) to p[2] (at 1), by Barry and Goldman's pyramid."""
    knots = np.concatenate([[0], np.cumsum(np.sqrt(np.linalg.norm(np.diff(p[:, :3], axis=0), axis=1)))])
    t = knots[1] + along * (knots[2] - knots[1])
    mix = lambda a, b, i, j: (a * (knots[j] - t) + b * (t - knots[i])) / (knots[j] - knots[i])  # noqa: E731
    a = [mix(p[i], p[i + 1], i, i + 1) for i in range(3)]
    b = [mix(a[i], a[i + 1], i, i + 2) for i in range(2)]
    return mix(b[0], b[1], 1, 2)


def course(control):
    """Stations (x, y, z, diameter) along the spline through the control points, as src/phantom/vessel.rs takes them."""
    control = np.array(control, float)
    points = np.concatenate([[2 * control[0] - control[1]], control, [2 * control[-1] - control[-2]]])
    stations = []
    for span in range(1, len(control)):
        p = points[span - 1:span + 3]
        step = np.clip(min(p[1, 3], p[2, 3]) / 4, 0.4, 2.5)
        steps = max(int(np.ceil(np.linalg.norm(p[2, :3] - p[1, :3]) / step)), 1)
        stations += [spline(p, s / steps) for s in range(steps)]
    return np.array(stations + [control[-1]])


class Heart:
    """The invisible heart of src/phantom/coronary.rs, and places on it."""

    def __init__(self):
        unit = lambda v: v / np.linalg.norm(v)  # noqa: E731
        self.base = np.array([0, 6, -20.0])
        self.apex = unit(np.array([0.60, -0.44, -0.67]))
        groove = np.array([0.28, -0.66, 0.70])
        self.groove = unit(groove - self.apex * (groove @ self.apex))
        self.margin = np.cross(self.apex, self.groove)

    def at(self, way, degrees, height):
        width, angle = np.sqrt(max(1 - way * way, 0)), np.radians(degrees)
        return (self.base + self.apex * 92 * way + self.groove * np.cos(angle) * (38 * width + height)
                + self.margin * np.sin(angle) * (44 * width + height))

    def course(self, points):
        return [[*self.at(*point[:3]), point[3]] for point in points]


def read_vessels(name):
    """(name, parent, whether the far end is open, control points) of each vessel, out of the Rust source, which alone has the coordinates."""
    source = re.sub(r"//.*", "", (ROOT / f"crates/lumen-vessel/src/phantom/{name}.rs").read_text())
    heart, names = Heart(), dict(re.findall(r'const (\w+): &str = "(.*?)";', source))
    places = {key: heart.at(*map(float, at.split(",")))
              for key, at in re.findall(r"let (division) = heart\.at\((.*?)\)", source)}
    for keys, one, other in re.findall(r"let \[(.*?)\] = \[heart\.at\((.*?)\), heart\.at\((.*?)\)\]", source):
        for key, at in zip(keys.split(","), [one, other]):
            places[key.strip()] = heart.at(*map(float, at.split(",")))

    def rows(text):
        number = lambda cell: places[cell[:-2]]["xyz".index(cell[-1])] if cell[-2:-1] == "." and cell[-1] in "xyz" \
            else float(cell)  # noqa: E731
        return [[number(cell.strip()) for cell in row.split(",")] for row in re.findall(r"\[([^\[\]]+?)\]", text)]

    call = re.compile(r"(tree\.trunk|tree\.branch|heart\.branch)\(\s*(?:tree,\s*)?(\"[^\"]+\"|[A-Z]+),"
                      r"\s*(?:(\"[^\"]+\"|[A-Z]+),\s*)?(Open|Divides),\s*&(\w+|\[.*?\]),?\s*\);", re.S)
    extended = re.search(r"let mut control = vec!\[(.*?)\];\s*control\.extend\(heart\.course\(&\[(.*?)\]\)\);", source, re.S)
    named = lambda text: text and (names[text] if text in names else text.strip('"'))  # noqa: E731
    for kind, vessel, parent, distal, control in call.findall(source):
        if control == "control":
            points = rows(extended[1]) + heart.course(rows(extended[2]))
        else:
            points = heart.course(rows(control)) if kind == "heart.branch" else rows(control)
        yield named(vessel), named(parent), distal == "Open", np.array(points)


def sample(name):
    """A sample's vessels with the fillets and bulges that src/phantom gives them."""
    vessels, parts, ends = {}, [], []
    for vessel, parent, is_open, control in read_vessels(name):
        ostium, fillet = 0, 0.0
        if parent:
            trunk = vessels[parent]
            nearest = np.linalg.norm(trunk[:, :3] - control[0, :3], axis=1).argmin()
            control[0, :3] = trunk[nearest, :3]
        stations = course(control)
        if parent:
            far = np.linalg.norm(stations[:, None, :3] - trunk[None, :, :3], axis=2)
            out = far.min(1) >= trunk[far.argmin(1), 3] / 2
            ostium = int(out.argmax()) if out.any() else len(stations) - 1
            fillet = FILLET * stations[ostium, 3] / 2
        vessels[vessel] = stations
        outward = lambda a, b: (a[:3], (a - b)[:3] / np.linalg.norm((a - b)[:3]), a[3] / 2)  # noqa: E731
        ends += [outward(stations[-1], stations[-2])] if is_open else []
        ends += [] if parent else [outward(stations[0], stations[1])]
        parts.append((fillet, [(a[:3], b[:3], a[3] / 2, b[3] / 2) for a, b in zip(stations, stations[1:])]))
    bulges = sinuses() if name == "coronary" else []
    parts += [(3.0, [(centre, centre + 1e-6, 10.2, 10.2)]) for centre in bulges]
    return Phantom(f"sample:{name}", [judged(name, vessels, bulges) for name in vessels], parts, open_ends=ends)


def sinuses():
    """The three sinuses of the aortic root, as src/phantom/coronary.rs has them."""
    axis = np.array([-0.28, -0.2, 0.94])
    axis /= np.linalg.norm(axis)
    right = np.array([-0.25, -0.97, 0.0])
    right -= axis * (right @ axis)
    right /= np.linalg.norm(right)
    side = np.cross(axis, right)
    turns = [(np.cos(a), np.sin(a)) for a in np.radians([0, 120, -120])]
    return [np.array([-2.6, -1.8, 8.6]) + 7.2 * (right * c + side * s) for c, s in turns]


def judged(name, vessels, bulges):
    """A vessel's centreline at steps of 0.4 mm; what is near its ends, another vessel or a bulge does not count."""
    stations = vessels[name]
    lengths = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(stations[:, :3], axis=0), axis=1))])
    along = np.arange(0, lengths[-1], 0.4)
    tangents = np.gradient(stations[:, :3], axis=0)
    at = lambda values: np.stack([np.interp(along, lengths, v) for v in values.T], 1)  # noqa: E731
    points, directions, radii = at(stations[:, :3]), at(tangents), np.interp(along, lengths, stations[:, 3] / 2)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    end = 2 * radii + 2
    counts = (along > end) & (along < lengths[-1] - end)
    for other, theirs in vessels.items():
        if other != name:
            gap = np.linalg.norm(points[:, None] - theirs[None, :, :3], axis=2) - theirs[:, 3] / 2
            counts &= gap.min(1) > 1.5 * radii + 1
    for centre in bulges:
        counts &= np.linalg.norm(points - centre, axis=1) > 12 + 1.5 * radii
    return Line(name, points, directions, radii, along, counts)
