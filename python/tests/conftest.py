"""Shapes of which area, volume and radius are known."""
import numpy as np
import pytest


def sphere(radius=10.0, rows=40, columns=80):
    """A closed sphere of triangles, its poles single points."""
    polar = np.linspace(0, np.pi, rows + 1)[1:-1]
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    ring = np.stack([np.outer(np.sin(polar), np.cos(around)), np.outer(np.sin(polar), np.sin(around)),
                     np.outer(np.cos(polar), np.ones(columns))], axis=-1).reshape(-1, 3)
    points = np.vstack([[0, 0, 1], ring, [0, 0, -1]]) * radius
    triangles = []
    for column in range(columns):
        following = (column + 1) % columns
        triangles.append([0, 1 + column, 1 + following])
        for row in range(rows - 2):
            a, b = 1 + row * columns + column, 1 + row * columns + following
            triangles += [[a, a + columns, b], [b, a + columns, b + columns]]
        last = 1 + (rows - 2) * columns
        triangles.append([last + column, len(points) - 1, last + following])
    return points.astype(np.float32), np.array(triangles)


def tube(radius=2.0, length=60.0, columns=48, rows=150):
    """A straight tube along z, open at both ends."""
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    points = [[radius * np.cos(a), radius * np.sin(a), z] for z in np.linspace(0, length, rows + 1) for a in around]
    triangles = []
    for row in range(rows):
        for column in range(columns):
            a, b = row * columns + column, row * columns + (column + 1) % columns
            triangles += [[a, b, a + columns], [b, b + columns, a + columns]]
    return np.array(points, np.float32), np.array(triangles)


@pytest.fixture(name="sphere", scope="session")
def of_a_sphere():
    return sphere()


@pytest.fixture(name="tube", scope="session")
def of_a_tube():
    return tube()


@pytest.fixture(scope="session")
def vessel(tube):
    """What is made of the tube at the paper's smoothing and 90 %."""
    import lumen
    return lumen.Surface(*tube).optimise(smoothing="paper", reduction=90)
