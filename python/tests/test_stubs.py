"""The types in `lumen/__init__.pyi` are those of what is there."""
import ast
import inspect
from pathlib import Path

import lumen


def test_the_stubs_name_what_is_there_and_nothing_else():
    told = ast.parse(Path(lumen.__file__).with_suffix(".pyi").read_text())
    names = set()
    for item in told.body:
        if isinstance(item, ast.FunctionDef):
            names.add(item.name)
            parameters = {argument.arg for argument in item.args.args + item.args.kwonlyargs}
            assert parameters <= set(inspect.signature(getattr(lumen, item.name)).parameters), item.name
        if isinstance(item, ast.ClassDef):
            names.add(item.name)
            own = {part.name for part in item.body if isinstance(part, ast.FunctionDef)} - {"__init__", "__getitem__"}
            there = {name for name in vars(getattr(lumen, item.name)) if not name.startswith("_")}
            assert own == there, item.name
        if isinstance(item, ast.Assign):
            # What only the stubs have is no name that programs can use.
            assert all(target.id.startswith("_") for target in item.targets), ast.unparse(item)
    assert names | {"__version__"} == set(lumen.__all__)


def test_everything_has_a_docstring():
    things = [getattr(lumen, name) for name in lumen.__all__ if name != "__version__"]
    assert "Not for clinical decisions" in lumen.__doc__
    assert [thing for thing in things if not thing.__doc__] == []
