"""What is refused: an exception with its data, and nothing else."""
import numpy as np
import pytest

import lumen

CORNERS = np.eye(4, 3, dtype=np.float32)


@pytest.mark.parametrize("points, triangles, expected", [
    (CORNERS, [[0, 1, 4]], ValueError),
    (CORNERS, [[0, 1, -1]], ValueError),
    (CORNERS, [[0.0, 1.0, 2.0]], TypeError),
    (CORNERS[:, :2], [[0, 1, 2]], ValueError),
    (CORNERS, [0, 1, 2], ValueError),
    ([["a", "b", "c"]], [[0, 0, 0]], ValueError),
    (CORNERS * np.nan, [[0, 1, 2]], lumen.Error),
    (CORNERS, np.zeros((0, 3), int), lumen.Error),
    (CORNERS, [[1, 1, 1]], lumen.Error),
])
def test_arrays_that_are_no_surface(points, triangles, expected):
    with pytest.raises(expected):
        lumen.Surface(points, triangles)


def test_an_error_has_its_name_and_its_numbers(tube):
    with pytest.raises(lumen.Error) as caught:
        lumen.Surface(*tube).optimise(pass_band=5)
    assert caught.value.id == "errors-pass-band" and caught.value.values == {"value": 5.0}
    assert str(caught.value) == "the pass band must lie between 0.001 and 2, not 5"


@pytest.mark.parametrize("named, expected", [
    ({"passband": 0.1}, TypeError),
    ({"window": "boxcar"}, ValueError),
    ({"iterations": 1.5}, ValueError),
    ({"reduction": 100}, lumen.Error),
    ({"reduction": 90, "triangles": 5}, TypeError),
    ({"keep": 10_000}, lumen.Error),
    ({"smoothing": "rough"}, ValueError),
])
def test_settings_that_are_none(tube, named, expected):
    with pytest.raises(expected):
        lumen.Surface(*tube).optimise(**named)


def test_safe_is_no_setting_before_there_is_a_surface():
    for given in [{"settings": {"reduction": "safe"}}, {"reduction": "safe"}, {"settings": lumen.settings(), "reduction": "safe"}]:
        with pytest.raises(ValueError, match="found by optimise"):
            lumen.settings(**given)


def test_what_would_have_no_effect(tmp_path, tube):
    surface, mask = lumen.Surface(*tube), np.zeros((8, 8, 8), np.uint8)
    mask[2:6, 2:6, 2:6] = 1
    with pytest.raises(TypeError, match="unit"):
        surface.optimise({**lumen.settings(), "unit": "cm"})
    for unfit in [{"unit": "mm"}, {"threshold": 100}, {"label": 1}, {"seed": (0, 0, 0)}]:
        with pytest.raises(TypeError, match="sample"):
            lumen.read("sample:aorta", **unfit)
    with pytest.raises(TypeError, match="threshold and label"):
        lumen.from_voxels(mask, threshold=0.5, label=1)
    surface.save(tmp_path / "tube.stl")
    for source in [tmp_path / "tube.stl", (tmp_path / "tube.stl").read_bytes()]:
        assert len(lumen.read(source, "sample:aorta").triangles) == len(surface.triangles)


def test_a_rate_below_one_percent_is_warned_of():
    with pytest.warns(UserWarning, match="reduction=90"):
        lumen.settings(reduction=0.9)


def test_files_that_are_none(tmp_path, tube):
    with pytest.raises(FileNotFoundError) as caught:
        lumen.read(tmp_path / "none.stl")
    assert str(caught.value.filename) == str(tmp_path / "none.stl")
    for bytes in [b"", b"\0" * 200, b"solid a\nfacet", b"NRRD0004\ntype: uint8\n\n", bytes_of_nothing()]:
        with pytest.raises(lumen.Error) as caught:
            lumen.read(bytes, "broken.stl")
        assert caught.value.id
    surface = lumen.Surface(*tube)
    with pytest.raises(ValueError, match="does not end in"):
        surface.save(tmp_path / "tube.docx")
    with pytest.raises(OSError):
        surface.save(tmp_path / "none" / "tube.stl")
    assert list(tmp_path.iterdir()) == []
    surface.save(tmp_path / "tube.stl")
    for unfit in [{"threshold": 100}, {"label": 1}]:
        with pytest.raises(TypeError):
            lumen.read(tmp_path / "tube.stl", **unfit)
    with pytest.raises(lumen.Error):
        lumen.read(tmp_path / "tube.stl", unit="furlong")


def bytes_of_nothing():
    """A binary STL that promises more than is there."""
    return b"\0" * 80 + (1000).to_bytes(4, "little") + b"\0" * 50


def test_a_ball_has_no_vessels_to_steer_through_or_to_keep(sphere):
    ball = lumen.Surface(*sphere)
    with pytest.raises(lumen.Error) as caught:
        ball.optimise(reduction="safe")
    assert caught.value.id
    with pytest.raises(lumen.Error) as caught:
        ball.trial()
    assert caught.value.id
    with pytest.raises(lumen.Error):
        lumen.Guidewire(ball)


def test_lines_that_a_guidewire_cannot_follow(tube):
    wire = lumen.Guidewire(lumen.Surface(*tube))
    before = wire.ask(observe={})
    for request in [{"pull": {}}, {"step": {"repeat": 0}}, {"reset": {"wire": "rope"}}, {}]:
        with pytest.raises(ValueError):
            wire.ask(**request)
    assert wire.ask(observe={}) == before
