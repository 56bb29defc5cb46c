"""Surfaces in and out: arrays, files, masks."""
import gc
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import lumen


def test_area_and_volume_of_a_sphere(sphere):
    report = lumen.Surface(*sphere).report
    # A polyhedron inside the ball: a little less than 4 pi r^2 and 4/3 pi r^3.
    assert report["area_mm2"] == pytest.approx(4 * np.pi * 100, rel=3e-3)
    assert report["volume_mm3"] == pytest.approx(4 / 3 * np.pi * 1000, rel=4e-3)
    assert report["volume_mm3"] < 4 / 3 * np.pi * 1000
    assert (report["boundary_edges"], report["components"], report["orientable"]) == (0, 1, True)


def test_arrays_look_at_the_surface_and_outlive_it(tube):
    surface = lumen.Surface(*tube)
    points, triangles = surface.points, surface.triangles
    assert (points.dtype, points.shape, triangles.dtype, triangles.shape) == (np.float32, (7248, 3), np.uint32, (14400, 3))
    assert np.shares_memory(points, surface.points) and np.shares_memory(triangles, surface.triangles)
    assert not points.flags.owndata
    with pytest.raises(ValueError):
        points[0] = 0
    before = points.copy()
    del surface
    gc.collect()
    assert (points == before).all()
    assert {tuple(row) for row in points} == {tuple(row) for row in tube[0]}


def test_corners_of_single_triangles_are_welded(sphere):
    points, triangles = sphere
    surface = lumen.Surface(points[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    assert len(surface.points) == len(points) and len(surface.triangles) == len(triangles)


def test_windings_come_to_agree_outwards(sphere):
    points, triangles = sphere
    turned = triangles.copy()
    turned[::3] = turned[::3, ::-1]
    surface = lumen.Surface(points, turned)
    corners = surface.points[surface.triangles].astype(float)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(surface.report["volume_mm3"], rel=1e-5)
    assert surface.report["reoriented_triangles"] > 0


@pytest.mark.parametrize("ending", ["stl", "ply", "obj", "vtp", "vtk"])
def test_files_are_written_and_read(tmp_path, tube, ending):
    surface, path = lumen.Surface(*tube), tmp_path / f"tube.{ending}"
    lumen.write(surface, path)
    assert [found.name for found in tmp_path.iterdir()] == [path.name]
    read = lumen.read(path)
    assert {tuple(row) for row in read.points} == {tuple(row) for row in surface.points}
    assert len(read.triangles) == len(surface.triangles)
    again = lumen.read(path.read_bytes(), path.name)
    assert (again.points == read.points).all()


def test_threads_that_write_one_file_leave_a_whole_one(tmp_path, tube):
    surface, path = lumen.Surface(*tube), tmp_path / "tube.stl"
    with ThreadPoolExecutor(8) as pool:
        written = [pool.submit(surface.save, path) for _ in range(40)]
    errors = [future.exception() for future in written]
    # Windows does not always let two rename to one name at once.
    assert os.name == "nt" or not any(errors)
    assert [found.name for found in tmp_path.iterdir()] == [path.name]
    assert len(lumen.read(path).triangles) == len(surface.triangles)


def test_units_become_millimetres(tmp_path, tube):
    surface = lumen.Surface(tube[0] / 1000, tube[1], unit="m")
    assert np.allclose(np.ptp(surface.points, axis=0), [4, 4, 60], atol=0.02)
    surface.save(tmp_path / "tube.stl")
    centimetres = lumen.read(tmp_path / "tube.stl", unit="cm")
    assert np.allclose(centimetres.points.max(), 600, atol=0.1)


def test_the_surface_of_a_mask_has_the_radius_of_the_tube_in_it():
    x, y, z = np.meshgrid(*[np.arange(n) * 0.5 for n in (40, 40, 100)], indexing="ij")
    mask = ((x - 10) ** 2 + (y - 10) ** 2 < 4.0 ** 2) & (z > 4) & (z < 45)
    surface = lumen.from_voxels(mask, (0.5, 0.5, 0.5), (1, 2, 3))
    radii = np.hypot(surface.points[:, 0] - 11, surface.points[:, 1] - 12)
    walls = (surface.points[:, 2] > 11) & (surface.points[:, 2] < 43)
    assert radii[walls].mean() == pytest.approx(4.0, abs=0.15)
    assert (lumen.from_voxels(mask * 7, (0.5, 0.5, 0.5), (1, 2, 3), label=7).points == surface.points).all()


def test_a_threshold_in_a_scan_is_where_it_says():
    axes = [np.arange(48) * 0.5 - 12] * 3
    distance = np.sqrt(sum(along ** 2 for along in np.meshgrid(*axes, indexing="ij")))
    surface = lumen.from_voxels((100 - 10 * distance).astype(np.float32), (0.5, 0.5, 0.5), (-12, -12, -12), threshold=20)
    assert np.allclose(np.linalg.norm(surface.points, axis=1), 8, atol=0.02)
    assert surface.report["threshold"]["value"] == 20
    for unfit in [np.zeros((4, 4)), np.zeros((4, 4, 4), complex), np.full((4, 4, 4), "a")]:
        with pytest.raises(ValueError):
            lumen.from_voxels(unfit)


def test_centrelines_are_what_vtk_takes(tube):
    found = lumen.Surface(*tube).centrelines()
    assert (found.points.dtype, found.lines.dtype) == (np.float64, np.int64)
    assert found.points.shape == (len(found.radius), 3) and len(found.area) == len(found.abscissa) == len(found.radius)
    assert found.lines.tolist() == [len(found.radius), *range(len(found.radius))]
    assert found.parents.tolist() == [-1]
    # A prism of 48 sides: its inscribed radius is r cos(pi / 48), its area that of the polygon.
    inner = slice(5, -5)
    assert np.allclose(found.radius[inner], 2 * np.cos(np.pi / 48), atol=1e-3)
    assert np.allclose(found.area[inner], 24 * 4 * np.sin(2 * np.pi / 48), atol=1e-3)
    assert np.allclose(found.points[inner, :2], 0, atol=1e-3)
    assert found.abscissa[-1] == pytest.approx(60, abs=0.1)
