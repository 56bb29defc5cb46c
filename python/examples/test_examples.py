"""The examples, run from outside: workers that are killed, a second run, the notebook."""
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import lumen
import pytest

HERE = Path(__file__).parent
PROGRAM = os.environ.get("LUMEN_PROGRAM")
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]
from conftest import tube


@pytest.fixture(name="surfaces")
def of_tubes(tmp_path):
    """Eleven tubes, two of them of the same bytes, and a file that is none."""
    folder = tmp_path / "surfaces"
    folder.mkdir()
    for number in range(11):
        lumen.Surface(*tube(2.0, 50 + number % 10)).save(folder / f"tube{number}.stl")
    (folder / "broken.stl").write_bytes(b"solid")
    (folder / "notes.txt").write_text("no surface")
    return folder


def written(folder):
    """When each report was written, to the nanosecond."""
    return {path.stem: path.stat().st_mtime_ns for path in folder.glob("*.json")}


def test_a_killed_worker_loses_nothing_and_nothing_is_done_twice(surfaces, tmp_path):
    import many
    from threading import Thread

    from dask.distributed import Client
    results, killed = tmp_path / "results", {}
    # What cannot be read, whoever runs this.
    (surfaces / "folder.stl").mkdir()
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        workers = client.run(os.getpid)
        assert len(set(workers.values())) == 2 and os.getpid() not in workers.values()

        def kill():
            while len(written(results)) < 2:
                time.sleep(0.01)
            killed.update(written(results))
            os.kill(next(iter(workers.values())), getattr(signal, "SIGKILL", signal.SIGTERM))

        killer = Thread(target=kill)
        killer.start()
        files, made, errors = many.run(client, surfaces, results, smoothing="paper", reduction=90)
        killer.join()
        assert 2 <= len(killed) < 10, "it was killed in the middle"
        unread = [str(surfaces / name) for name in ["broken.stl", "folder.stl"]]
        assert len(files) == 11 and sorted(errors) == unread
        there = written(results)
        assert len(there) == 10 and all((results / f"{name}.stl").exists() for name in there)
        assert {name: there[name] for name in killed} == killed, "what was there is not made again"
        for name in there:
            assert abs(json.loads((results / f"{name}.json").read_text())["output"]["triangles"] - 1440) <= 1
            assert len(lumen.read(results / f"{name}.stl").triangles) in range(1439, 1442)
        # A second run makes nothing, and other settings make all.
        files, made, errors = many.run(client, surfaces, results, smoothing="paper", reduction=90)
        assert (made, len(errors), written(results)) == ([], 2, there)
        lumen.Surface(*tube(1.5)).save(surfaces / "new.stl")
        files, made, errors = many.run(client, surfaces, results, smoothing="paper", reduction=90)
        assert len(made) == 1 and files[made[0]].endswith("new.stl")


def test_what_failed_is_told_at_the_end(surfaces, tmp_path):
    (surfaces / "folder.stl").mkdir()

    def run(*named):
        command = [sys.executable, str(HERE / "many.py"), str(surfaces), str(tmp_path / "results"), *named]
        return subprocess.run(command, capture_output=True, text=True, timeout=300)

    done = run("smoothing=none", "reduction=90")
    assert done.returncode == 1, done.stderr
    assert "12 surfaces: 10 made, 0 were there, 2 failed" in done.stdout
    assert f"{surfaces / 'broken.stl'}: " in done.stdout and f"{surfaces / 'folder.stl'}: " in done.stdout
    unset = run("reduction=safe")
    assert unset.returncode == 1 and "found by optimise" in unset.stderr and "Traceback" not in unset.stderr


@pytest.mark.skipif(not PROGRAM, reason="LUMEN_PROGRAM names no command line")
@pytest.mark.skipif(os.name == "nt", reason="Windows kills no groups of processes")
def test_snakemake_does_what_is_missing(surfaces, tmp_path):
    (surfaces / "folder.stl").mkdir()
    settings = tmp_path / "settings.json"
    settings.write_text(json.dumps(lumen.settings(smoothing="paper", reduction=90)))
    config = [f"{name}={tmp_path / name}" for name in ["surfaces", "results"]] + [f"settings={settings}"]
    flags = "--cores 2 --rerun-incomplete --keep-going --rerun-triggers input".split()
    assert " ".join(flags) in (HERE / "Snakefile").read_text()
    command = [sys.executable, "-m", "snakemake", *flags, "--snakefile", str(HERE / "Snakefile"), "--config", *config]

    def run(status, *more):
        done = subprocess.run([*command, *more], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == status, done.stdout + done.stderr
        return written(tmp_path / "results")

    # It is killed with all that it has started, in the middle; what was whole then stays.
    killed = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    while len(written(tmp_path / "results")) < 3 and killed.poll() is None:
        time.sleep(0.01)
    assert killed.poll() is None, "it was killed in the middle"
    os.killpg(killed.pid, signal.SIGKILL)
    killed.wait()
    time.sleep(0.5)
    early = written(tmp_path / "results")
    run(0, "--unlock")
    # One of them is no surface, and one no file: the others are done.
    first = run(1)
    assert len(first) == 10 and sum(first[name] == early[name] for name in early) >= 1
    for path in (tmp_path / "results").glob("*.stl"):
        assert len(lumen.read(path).triangles) in range(1439, 1442)
    (surfaces / "broken.stl").unlink()
    (surfaces / "folder.stl").rmdir()
    for path in surfaces.iterdir():
        os.utime(path)
    assert run(0) == first
    lumen.Surface(*tube(1.5)).save(surfaces / "new.stl")
    second = run(0)
    assert len(second) == 11 and {name: second[name] for name in first} == first


def test_the_notebook_goes_from_a_mask_to_a_certified_surface(tmp_path):
    import nbformat
    from nbclient import NotebookClient
    notebook = nbformat.read(HERE / "mask_to_surface.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "no results are committed"
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    said = "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", []))
    assert "branch 3" in said and "kept" in said
    assert (tmp_path / "certified.png").stat().st_size > 10_000
    assert len(lumen.read(tmp_path / "certified.stl").triangles) > 500
