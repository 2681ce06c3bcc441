"""Stubs, doc strings and the example."""
import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import mms_slam

PACKAGE = Path(mms_slam.__file__).parent
SOURCE = Path(__file__).resolve().parents[3]


def arguments_of(function):
    found = function.args
    return [a.arg for a in (*found.posonlyargs, *found.args, *found.kwonlyargs) if a.arg != "self"]


def runtime_arguments(function):
    """From the first line of the doc string, as "process(self: Slam, color: ..., stamp: int)"."""
    line = function.__doc__.splitlines()[0]
    names = re.findall(r"(?:\(|, )\**(\w+)(?=:|=|,|\))", re.sub(r"\[[^\]]*\]", "", line))
    return [name for name in names if name not in ("self", "args")]


def test_stubs_name_what_there_is():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    assert (PACKAGE / "py.typed").is_file()
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert {*classes, *functions} == set(mms_slam.__all__)
    for name, function in functions.items():
        assert runtime_arguments(getattr(mms_slam, name)) == arguments_of(function), name
    for name, node in classes.items():
        real = getattr(mms_slam, name)
        stub = {f.name: f for f in node.body if isinstance(f, ast.FunctionDef)}
        if issubclass(real, Exception):
            assert [base.id for base in node.bases] == [real.__bases__[0].__name__]
            continue
        members = {key for key in vars(real) if not key.startswith("_") or key in stub}
        made = "__init__" in vars(real) and "No constructor" not in (real.__init__.__doc__ or "")
        assert members | ({"__init__"} if "__init__" in stub else set()) == set(stub), name
        assert made or "__init__" not in stub
        for key, function in stub.items():
            if not key.startswith("__") and callable(getattr(real, key)):
                assert runtime_arguments(getattr(real, key)) == arguments_of(function), (name, key)


def test_all_is_described():
    for name in mms_slam.__all__:
        item = getattr(mms_slam, name)
        if inspect.isclass(item) and issubclass(item, Exception):
            continue
        assert item.__doc__, name
        for key, member in vars(item).items() if inspect.isclass(item) else ():
            if not key.startswith("_"):
                text = member.__func__.__doc__ if isinstance(member, staticmethod) else member.__doc__
                assert text and text.strip(), (name, key)


def test_example_plots(tmp_path):
    picture = tmp_path / "run.png"
    done = subprocess.run(
        [sys.executable, SOURCE / "examples/python/plot_run.py",
         "sim:rack_aisle?frames=20&width=320", picture], capture_output=True, text=True,
        env={"PYTHONPATH": str(PACKAGE.parent), "HOME": str(tmp_path), "PATH": "/usr/bin:/bin"},
        check=False)
    assert done.returncode == 0, done.stderr
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 20000
