"""The pipeline: counts, progress, cancelling, and the same as the command line."""
import json
import os
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import lumen

PROGRAM = os.environ.get("LUMEN_PROGRAM")


def test_every_level_has_the_triangles_of_its_rate(vessel):
    for rate in [0.0, 0.25, 0.5, 0.75, 0.9]:
        assert abs(len(vessel.levels[rate].triangles) - round(14400 * (1 - rate))) <= 1
    level, reduced = vessel.levels[0.9], vessel.reduced
    assert (level.points == reduced.points).all() and (level.triangles == reduced.triangles).all()
    assert len(vessel.smoothed.triangles) == 14400
    for rate in [-0.1, 1.0, float("nan")]:
        with pytest.raises(KeyError):
            vessel.levels[rate]


def test_the_certificate_knows_the_radius_of_the_tube(vessel):
    [branch] = vessel.certificate["branches"]
    assert branch["opened"]["radius_mm"]["mean"] == pytest.approx(2.0, rel=2e-3)
    assert branch["length_mm"] == pytest.approx(60, rel=1e-3)
    assert vessel.certificate["verdict"] == "kept" and vessel.report["output"]["triangles"] == 1440
    assert vessel.verdict["is_safe"] is True and "of the length" in vessel.verdict["head"]


def test_progress_never_falls_and_ends_at_one(tube):
    told = []
    lumen.Surface(*tube).optimise(progress=lambda what, part: told.append((what, part)))
    parts = [part for _, part in told]
    assert parts == sorted(parts) and 0 <= parts[0] and parts[-1] == 1
    assert {"Smoothing", "Reducing", "Measuring calibre"} <= {what for what, _ in told}


def test_settings_have_the_names_of_the_table():
    told = lumen.settings(smoothing="paper", reduction=90, keep="all", adapt=True, fill_holes=2.5)["settings"]
    assert told["target"] == {"Reduction": 900} and told["keep"] == "All" and told["mending"]["fill_mm"] == 2.5
    assert (told["smoothing"]["pass_band"], told["smoothing"]["iterations"], told["smoothing"]["adapt"]) == (0.01, 100, True)
    file = lumen.settings(pass_band=0.1)
    assert lumen.settings(file) == file and lumen.settings({"pass_band": 0.1}) == file
    assert lumen.settings(file, reduction="auto")["settings"]["target"] == "Auto"
    centimetres = {**file, "unit": "cm"}
    assert lumen.settings(centimetres, pass_band=0.1) == centimetres


def test_safe_is_the_highest_rate_that_keeps_every_calibre(tube):
    result = lumen.Surface(*tube).optimise(smoothing="none", reduction="safe", tolerance=2)
    percent = result.report["safe"]["percent"]
    assert result.report["reduction_percent"] == pytest.approx(percent, abs=0.1)
    assert result.certificate["verdict"] == "kept"


def test_another_target_goes_over_safe(tube):
    for over in [{"reduction": 50}, {"triangles": 7200}, {"max_deviation": 0.1}]:
        assert lumen.settings({"reduction": "safe"}, **over) == lumen.settings(**over)
    result = lumen.Surface(*tube).optimise({"reduction": "safe", "smoothing": "none"}, triangles=7200)
    assert len(result.reduced.triangles) == pytest.approx(7200, abs=1)


@pytest.mark.skipif(not PROGRAM, reason="LUMEN_PROGRAM names no command line to compare with")
@pytest.mark.parametrize("named", [{"pass_band": 0.01, "iterations": 100, "reduction": 90}, {"reduction": "auto"}])
def test_the_command_line_makes_the_same(tmp_path, tube, named):
    lumen.Surface(*tube).save(tmp_path / "tube.ply")
    options = [f"--{name.replace('_', '-')}={value}" for name, value in named.items()]
    subprocess.run([PROGRAM, "optimise", "tube.ply", "-o", "out.ply", "--report", "out.json", *options], cwd=tmp_path, check=True,
                   capture_output=True)
    result = lumen.read(tmp_path / "tube.ply", "tube.ply").optimise(**named)
    result.reduced.save(tmp_path / "own.ply")
    assert (tmp_path / "own.ply").read_bytes() == (tmp_path / "out.ply").read_bytes()
    own, other = result.report, json.loads((tmp_path / "out.json").read_text())
    for report in [own, other]:
        del report["stages_ms"], report["calibre"]["ms"]
    assert own == other


def test_an_exception_of_the_progress_ends_the_work_and_comes_out(tube):
    calls = []

    def refuse(what, part):
        calls.append(what)
        raise ZeroDivisionError("enough")

    with pytest.raises(ZeroDivisionError, match="enough"):
        lumen.Surface(*tube).optimise(progress=refuse)
    assert len(calls) == 1


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no SIGINT to a thread")
@pytest.mark.parametrize("stage", ["opening", "Smoothing", "Reducing"])
def test_an_interrupt_ends_the_work_within_a_second(stage):
    aorta = lumen.read("sample:aorta") if stage != "opening" else None
    sent, is_there = [], threading.Event()

    def interrupt():
        is_there.wait()
        # Python's main thread is in the work: this one runs because the work lets it.
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    def tell(what, part):
        if what == stage:
            is_there.set()

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        if stage == "opening":
            is_there.set()
            lumen.read("sample:coronary")
        else:
            aorta.optimise(progress=tell)
    assert time.monotonic() - sent[0] < 1
    thread.join()


def test_other_threads_of_python_run_meanwhile(tube):
    turns, is_over = [], threading.Event()

    def count():
        while not is_over.is_set():
            turns.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    lumen.Surface(*tube).optimise()
    is_over.set()
    thread.join()
    # Were Python held for the whole of it, there would be one or two.
    assert len(turns) > 20


def test_the_autopilot_arrives_in_a_straight_tube(tube):
    surface = lumen.Surface(*tube)
    told = []
    summary = surface.trial(progress=lambda what, part: told.append(part))
    assert summary["success"] and summary["reason"].startswith("the tip arrived")
    assert told == sorted(told)
    assert np.isfinite(summary["max_wall_force_n"])
    again = surface.trial()
    assert (again["steps"], again["max_wall_force_n"]) == (summary["steps"], summary["max_wall_force_n"])


def test_what_the_readme_shows_runs(tmp_path, monkeypatch, tube, capsys):
    lumen.Surface(*tube).save(tmp_path / "aorta.stl")
    monkeypatch.chdir(tmp_path)
    readme = Path(__file__).parents[1].joinpath("README.md").read_text()
    exec(readme.split("```python\n")[1].split("```")[0], {})
    assert "of the length" in capsys.readouterr().out
    sizes = [len(lumen.read(tmp_path / f"aorta{rate}.stl").triangles) for rate in [90, 95]]
    assert abs(sizes[0] - 1440) <= 1 and abs(sizes[1] - 720) <= 1
