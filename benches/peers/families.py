"""Vessel surfaces made for `solvers.py --family`: shapes of known radius, each dressed as files of scans and of modellers are.

A shape is a set of round cones, cut by VTK's contouring out of their distance; one that crosses itself is swept instead.
Dressings are ends (open, ragged, capped, round), noise, stair steps, sparse triangles, triangles without common vertices,
triangles there twice, holes, other pieces, triangles turned around, and units. All are the same from run to run.
"""
import numpy as np
import pyvista as pv

#: The angle at which the shapes lie against the grid.
TURN = np.linalg.qr(np.array([[0.9, 0.3, 0.2], [-0.2, 0.8, 0.4], [0.1, -0.3, 0.9]]))[0]


class Shape:
    """Cones (start, end, radius, end radius), and the ends of vessels (place, outward, radius)."""

    def __init__(self, fillet=0.0):
        self.cones, self.ends, self.fillet = [], [], fillet

    def course(self, points, radii, first=True, last=True):
        points, radii = np.asarray(points, float) @ TURN, np.broadcast_to(radii, len(points)).astype(float)
        self.cones.append([(*points[i:i + 2], *radii[i:i + 2]) for i in range(len(points) - 1)])
        for wanted, i, j in ((first, 0, 1), (last, -1, -2)):
            if wanted:
                away = points[i] - points[j]
                self.ends.append((points[i], away / np.linalg.norm(away), radii[i]))
        return self

    def contour(self, spacing, stairs=False):
        """The surface, closed, with round ends."""
        cones = [cone for course in self.cones for cone in course]
        spacing = np.broadcast_to(spacing, 3).astype(float)
        reach = max(max(cone[2:]) for cone in cones) + self.fillet
        places = np.array([cone[:2] for cone in cones]).reshape(-1, 3)
        low = places.min(0) - reach - 3.3 * spacing
        size = np.ceil((places.max(0) + reach + 3 * spacing - low) / spacing).astype(int) + 1
        field = np.full(size[::-1], 1e3, np.float32)

        def box(course):
            far = max(max(cone[2:]) for cone in course) + self.fillet + 3 * spacing
            ends = np.array([cone[:2] for cone in course]).reshape(-1, 3)
            a = np.maximum(((ends.min(0) - far - low) / spacing).astype(int), 0)
            b = np.minimum(((ends.max(0) + far - low) / spacing).astype(int) + 2, size)
            return a, (slice(a[2], b[2]), slice(a[1], b[1]), slice(a[0], b[0]))

        for course in self.cones:
            _, whole = box(course)
            part = np.full(size[::-1], 1e3, np.float32)
            for start, end, r0, r1 in course:
                a, own = box([(start, end, r0, r1)])
                near = part[own]
                x, y, z = (low[i] - start[i] + spacing[i] * (a[i] + np.arange(near.shape[2 - i])) for i in range(3))
                x, y, z, d = x[None, None], y[None, :, None], z[:, None, None], end - start
                t = np.clip((x * d[0] + y * d[1] + z * d[2]) / (d @ d), 0, 1)
                distance = np.sqrt((x - t * d[0])**2 + (y - t * d[1])**2 + (z - t * d[2])**2) - r0 - (r1 - r0) * t
                np.minimum(near, distance, out=near)
            a, b = field[whole], part[whole]
            h = np.maximum(self.fillet - np.abs(a - b), 0)
            a[...] = np.minimum(a, b) - (h * h / (4 * self.fillet) if self.fillet else 0)
        grid = pv.ImageData(dimensions=size, spacing=spacing, origin=low)
        grid["d"] = ((field < 0) if stairs else -field).astype(np.float32).ravel()
        mesh = grid.contour([0.5 if stairs else 0.0], scalars="d", method="flying_edges")
        mesh.clear_data()
        return mesh

    def cut(self, mesh, ragged=False):
        """Without what lies beyond the ends."""
        def beyond(p):
            out = np.full(len(p), -1e3)
            for place, away, radius in self.ends:
                out = np.maximum(out, np.minimum((p - place) @ away, 1.25 * radius - np.linalg.norm(p - place, axis=1)))
            return out

        if ragged:
            faces = mesh.faces.reshape(-1, 4)[:, 1:]
            return largest(mesh.extract_cells(beyond(mesh.points[faces].mean(1)) < 0).extract_surface(algorithm=None))
        mesh["beyond"] = beyond(mesh.points)
        mesh = mesh.clip_scalar(scalars="beyond", value=0.0)
        mesh = mesh.triangulate().clean(tolerance=1e-5, absolute=False)
        return largest(surface(mesh.points, faces_of(mesh)))


def largest(mesh):
    mesh = mesh.connectivity("largest").extract_surface(algorithm=None)
    mesh.clear_data()
    return mesh


def surface(points, faces):
    return pv.PolyData(np.asarray(points, float), np.hstack([np.full((len(faces), 1), 3), faces]))


def faces_of(mesh):
    return mesh.faces.reshape(-1, 4)[:, 1:]


# Shapes.

def tube(radius, length):
    return Shape().course([[0, 0, 0], [0, 0, length / 2], [0, 0, length]], radius)


def stenosis(radius, degree):
    z = np.linspace(0, 16 * radius, 80)
    narrow = degree * np.exp(-((z / radius - 8) / 1.5)**2)
    return Shape().course(np.c_[0 * z, 0 * z, z], radius * (1 - narrow))


def aneurysm(radius):
    return tube(radius, 16 * radius).course([[1.6 * radius, 0, 8 * radius], [1.7 * radius, 0, 8 * radius]], 1.8 * radius, False, False)


def cone(radius, end, length):
    z = np.linspace(0, length, 20)
    return Shape().course(np.c_[0 * z, 0 * z, z], np.linspace(radius, end, 20))


def bend(radius, gap):
    """A U whose legs are so many radii apart."""
    way = radius * (1 + gap / 2)
    angle = np.linspace(0, np.pi, 40)
    arch = np.c_[way * np.cos(angle), 0 * angle, 10 * radius + way * np.sin(angle)]
    return Shape().course([[way, 0, 0], *arch, [-way, 0, 0]], radius)


def coil(radius, gap, turns=3):
    angle = np.linspace(0, 2 * np.pi * turns, 60 * turns)
    rise = radius * (2 + gap) / (2 * np.pi)
    return Shape().course(np.c_[4 * radius * np.cos(angle), 4 * radius * np.sin(angle), rise * angle], radius)


def ring(radius):
    """Vessels around a hole, as in the circle of Willis."""
    angle = np.linspace(0, 2 * np.pi, 60)
    shape = Shape(0.4 * radius).course(np.c_[6 * radius * np.cos(angle), 6 * radius * np.sin(angle), 0 * angle], radius, False, False)
    for at in np.radians([10, 130, 250]):
        way = np.array([np.cos(at), np.sin(at), 0.3])
        shape.course([6 * radius * way * [1, 1, 0], 11 * radius * way, 16 * radius * way], 0.8 * radius, first=False)
    return shape


def comb(radius, branches):
    """Branches of a half, a third and a quarter of the trunk's radius, one close to the next."""
    length = radius * (3 * branches + 6)
    shape = Shape(0.2 * radius).course([[0, 0, 0], [0, 0, length / 2], [0, 0, length]], radius)
    for i in range(branches):
        way = np.array([np.cos(2.4 * i), np.sin(2.4 * i), 0.4])
        own = radius / (2 + i % 3)
        root = np.array([0, 0, radius * (3 * i + 4)])
        shape.course([root, root + way * (radius + 3 * own), root + way * (radius + 8 * own)], own, first=False)
    return shape


def tree(seed, radius, generations, exponent=3.0):
    """Forks of unequal branches by Murray's law, each branch bent."""
    random = np.random.default_rng(seed)
    shape = Shape(0.25 * radius)

    def grow(start, way, r, left, first):
        bow = random.normal(size=3) * 0.25
        ways = [way + bow * t for t in np.linspace(0, 1, 6)]
        points = np.cumsum([start] + [r * 2 * w / np.linalg.norm(w) for w in ways], axis=0)
        shape.course(points, np.linspace(r, 0.95 * r, len(points)), first, left == 0)
        if left:
            share = random.uniform(0.35, 0.65)
            out = ways[-1] / np.linalg.norm(ways[-1])
            side = np.cross(out, random.normal(size=3))
            side /= np.linalg.norm(side)
            for part, sign in ((share, 1), (1 - share, -1)):
                grow(points[-1], out + sign * side * 0.9, 0.95 * r * part**(1 / exponent), left - 1, False)

    grow(np.zeros(3), np.array([0, 0, 1.0]), radius, generations, True)
    return shape


def swept(points, radius, around=24):
    """A tube around a line, that may run into itself, with open ends."""
    points = np.asarray(points, float) @ TURN
    side = np.array([0, 1.0, 0]) @ TURN
    ways = np.gradient(points, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    up = np.cross(ways, side)
    turns = 2 * np.pi * np.arange(around) / around
    rings = [p + radius * (np.outer(np.cos(turns), u) + np.outer(np.sin(turns), side)) for p, u in zip(points, up)]
    i, j = np.meshgrid(np.arange(len(points) - 1), np.arange(around), indexing="ij")
    at = lambda di, dj: ((i + di) * around + (j + dj) % around).ravel()  # noqa: E731
    return surface(np.vstack(rings), np.vstack([np.c_[at(0, 0), at(1, 1), at(0, 1)], np.c_[at(0, 0), at(1, 0), at(1, 1)]]))


# Dressings.

def noisy(mesh, share, seed=1):
    """Vertices moved at random by a share of the mean edge."""
    random = np.random.default_rng(seed)
    faces = faces_of(mesh)
    edge = np.linalg.norm(mesh.points[faces[:, 0]] - mesh.points[faces[:, 1]], axis=1).mean()
    return surface(mesh.points + random.normal(size=mesh.points.shape) * share * edge, faces)


def spiked(mesh, share, edges, seed=2):
    """A share of the vertices moved by so many mean edges, which makes triangles run into others."""
    random = np.random.default_rng(seed)
    faces = faces_of(mesh)
    edge = np.linalg.norm(mesh.points[faces[:, 0]] - mesh.points[faces[:, 1]], axis=1).mean()
    points = np.array(mesh.points, float)
    some = random.random(len(points)) < share
    away = random.normal(size=(some.sum(), 3))
    points[some] += edges * edge * away / np.linalg.norm(away, axis=1)[:, None]
    return surface(points, faces)


def capped(mesh):
    return mesh.fill_holes(1e6).triangulate().clean()


def soup(mesh, rounding=None):
    """Each triangle with vertices of its own, rounded to so many digits."""
    points = mesh.points[faces_of(mesh)].reshape(-1, 3).astype(float)
    points = points if rounding is None else np.round(points, rounding)
    return surface(points, np.arange(len(points)).reshape(-1, 3))


def twice(mesh, every=7):
    faces = faces_of(mesh)
    return surface(mesh.points, np.vstack([faces, faces[::every]]))


def holed(mesh, holes=12, seed=3):
    random = np.random.default_rng(seed)
    faces = faces_of(mesh)
    middles = mesh.points[faces].mean(1)
    kept = np.ones(len(faces), bool)
    edge = np.sqrt(mesh.area / len(faces) * 2)
    for at in random.choice(len(faces), holes, replace=False):
        kept &= np.linalg.norm(middles - middles[at], axis=1) > random.uniform(0.5, 4) * edge
    return surface(mesh.points, faces[kept])


def turned(mesh, share=0.2, seed=4):
    random = np.random.default_rng(seed)
    faces = faces_of(mesh).copy()
    some = random.random(len(faces)) < share
    faces[some] = faces[some][:, ::-1]
    return surface(mesh.points, faces)


def specks(mesh, pieces=40, seed=5):
    random = np.random.default_rng(seed)
    low, high = np.array(mesh.bounds).reshape(3, 2).T
    balls = [pv.Sphere(radius=0.02 * mesh.length * r, center=low + (high - low) * at, theta_resolution=8, phi_resolution=8)
             for r, at in zip(random.uniform(0.1, 1, pieces), random.random((pieces, 3)))]
    return pv.merge([mesh, *balls]).extract_surface(algorithm=None)


def finned(mesh, fins=10, seed=6):
    """Triangles that stand on edges of others, so that these have three."""
    random = np.random.default_rng(seed)
    faces, points = faces_of(mesh), np.array(mesh.points, float)
    out = []
    for i, t in enumerate(random.choice(len(faces), fins, replace=False)):
        a, b, c = points[faces[t]]
        normal = np.cross(b - a, c - a)
        points = np.vstack([points, (a + b) / 2 + normal / np.linalg.norm(normal) * np.linalg.norm(b - a)])
        out.append([faces[t][0], faces[t][1], len(points) - 1])
    return surface(points, np.vstack([faces, out]))


def dented(shape, mesh, depth, seed=7):
    """The wall pushed in until it goes through the other side, at one place of each course."""
    random = np.random.default_rng(seed)
    points = np.array(mesh.points, float)
    for course in shape.cones:
        a, b, r, _ = course[len(course) // 2]
        side = np.cross(b - a, random.normal(size=3))
        side /= np.linalg.norm(side)
        away = points - (a + side * r)
        points -= side * (depth * r * np.exp(-(away**2).sum(1) / (0.6 * r)**2))[:, None]
    return surface(points, faces_of(mesh))


def scaled(mesh, factor):
    return surface(np.asarray(mesh.points, float) * factor, faces_of(mesh))


def family():
    """(name, function that makes the surface)."""
    shapes = {
        "tube, 0.5 mm": (lambda: tube(0.5, 20), 0.15),
        "tube, 2 mm": (lambda: tube(2, 40), 0.5),
        "tube, 15 mm": (lambda: tube(15, 150), 2.5),
        "short tube, 5 mm": (lambda: tube(5, 12), 0.8),
        "stenosis of 70 %": (lambda: stenosis(3, 0.7), 0.4),
        "stenosis of 90 %": (lambda: stenosis(3, 0.9), 0.25),
        "cone, 8 to 1 mm": (lambda: cone(8, 1, 80), 0.8),
        "aneurysm": (lambda: aneurysm(2), 0.4),
        "bend, legs 0.6 radii apart": (lambda: bend(3, 0.6), 0.5),
        "bend, legs 0.15 radii apart": (lambda: bend(3, 0.15), 0.2),
        "coil, turns 0.3 radii apart": (lambda: coil(2, 0.3), 0.3),
        "ring": (lambda: ring(1.5), 0.35),
        "comb of 12": (lambda: comb(4, 12), 0.4),
        "tree of 8": (lambda: tree(1, 3, 3), 0.4),
        "tree of 16": (lambda: tree(2, 3, 4), 0.35),
        "tree of 32": (lambda: tree(5, 3, 5), 0.3),
    }
    for name, (make, spacing) in shapes.items():
        yield f"{name}, open", lambda m=make, s=spacing: m().cut(m().contour(s))
        yield f"{name}, capped", lambda m=make, s=spacing: capped(m().cut(m().contour(s)))
    for name in ("tube, 2 mm", "bend, legs 0.6 radii apart", "ring", "comb of 12", "tree of 16"):
        make, spacing = shapes[name]
        yield f"{name}, ragged", lambda m=make, s=spacing: m().cut(m().contour(s), ragged=True)
        yield f"{name}, round ends", lambda m=make, s=spacing: m().contour(s)
        yield f"{name}, stairs, ragged", lambda m=make, s=spacing: m().cut(m().contour(s, stairs=True), ragged=True)
        yield f"{name}, stairs of uneven voxels", lambda m=make, s=spacing: m().cut(m().contour([s, s, 2 * s], stairs=True), ragged=True)
        yield f"{name}, stairs, round ends", lambda m=make, s=spacing: m().contour(s, stairs=True)
        yield f"{name}, noise", lambda m=make, s=spacing: noisy(m().cut(m().contour(s)), 0.1)
        yield f"{name}, much noise", lambda m=make, s=spacing: noisy(m().cut(m().contour(s)), 0.3)
        yield f"{name}, sparse", lambda m=make, s=spacing: m().cut(m().contour(s)).decimate(0.9)
    for name in ("tube, 2 mm", "tree of 8"):
        make, spacing = shapes[name]
        opened = lambda m=make, s=spacing: m().cut(m().contour(s))  # noqa: E731
        yield f"{name}, spikes", lambda o=opened: spiked(o(), 0.005, 2.0)
        yield f"{name}, many spikes", lambda o=opened: spiked(o(), 0.05, 2.0)
        yield f"{name}, dented through", lambda m=make, o=opened: dented(m(), o(), 2.1)
        yield f"{name}, no common vertices", lambda o=opened: soup(o())
        yield f"{name}, rounded to 0.01", lambda o=opened: soup(o(), 2)
        yield f"{name}, rounded to 0.1", lambda o=opened: soup(o(), 1)
        yield f"{name}, triangles twice", lambda o=opened: twice(o())
        yield f"{name}, holes", lambda o=opened: holed(o())
        yield f"{name}, turned triangles", lambda o=opened: turned(o())
        yield f"{name}, other pieces", lambda o=opened: specks(o())
        yield f"{name}, fins", lambda o=opened: finned(o())
        yield f"{name}, in cm", lambda o=opened: scaled(o(), 0.1)
        yield f"{name}, in m", lambda o=opened: scaled(o(), 0.001)
    for overlap in (0.02, 0.1, 0.3):
        angle = np.linspace(0, np.pi, 24)
        way = 3 - 3 * overlap / 2
        leg = np.linspace(0, 29, 24)[:, None]
        arch = np.c_[8 * np.cos(angle) * 1.0, 0 * angle, 45 + 8 * np.sin(angle)]
        down = lambda sign: np.c_[sign * (way + (8 - way) * (leg / 29)**2), 0 * leg, 15 + leg]  # noqa: E731
        line = [[6, 0, 0], [4.5, 0, 7], *down(1), *arch, *down(-1)[::-1], [-4.5, 0, 7], [-6, 0, 0]]
        yield f"swept bend, legs {overlap:g} radii into each other", lambda p=line: swept(p, 3)
