"""Processes that are forked: what has no threads to work with says so, and nothing waits forever."""
import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system forks no processes")

#: In a process of its own, whose children are the ones in question.
BEGIN = """
import multiprocessing, os, sys, warnings
# Newer Pythons warn of every fork of a process with threads.
warnings.simplefilter("ignore", DeprecationWarning)
sys.path.insert(0, {tests!r})
import lumen
from conftest import tube
POINTS, TRIANGLES = tube()

def work(_=None):
    return len(lumen.Surface(POINTS, TRIANGLES).centrelines().radius) > 50

def refused(surface=None):
    works = [work] if surface is None else [work, surface.optimise, surface.centrelines, surface.trial, lambda: surface.report,
                                            lambda: surface.save("none.stl"), lambda: lumen.read("sample:aorta"),
                                            lambda: lumen.Guidewire(surface)]
    told = []
    for each in works:
        try:
            each()
        except RuntimeError as error:
            told.append("'spawn'" in str(error))
    return told == [True] * len(works)

def forked(run):
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if run() else 1)
        finally:
            os._exit(2)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
"""


def run(script):
    begin = BEGIN.format(tests=os.path.dirname(__file__))
    done = subprocess.run([sys.executable, "-c", begin + script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_child_of_a_process_that_has_worked_is_refused_everything():
    run("""
surface = lumen.Surface(POINTS, TRIANGLES)
assert work()
assert forked(lambda: refused(surface)) == 0
assert forked(lambda: forked(refused) == 0) == 0, "and so is a child of that child"
assert forked(lambda: len(surface.points) == len(POINTS)) == 0, "what is there can be looked at"
with multiprocessing.get_context("fork").Pool(2) as pool:
    try:
        pool.map(work, range(2))
    except RuntimeError as error:
        assert "forked" in str(error)
    else:
        raise AssertionError("they worked")
assert work(), "the parent goes on"
""")


def test_a_child_of_a_process_that_has_not_worked_works():
    run("""
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map(work, range(2)) == [True, True]
assert forked(lambda: work() and forked(refused) == 0) == 0, "and its own child is refused"
assert work()
""")
