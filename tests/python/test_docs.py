"""Examples in docstrings and pages run, and the types are complete."""

import doctest
import importlib.util
import pathlib
import re
import subprocess
import sys

import pytest

import diptych as dp
import diptych.convergence
import diptych.measure
import diptych.rates
import diptych.rendering
from conftest import ROOT


def examples():
    finder = doctest.DocTestFinder(exclude_empty=True)
    for module in (dp, diptych.convergence, diptych.measure, diptych.rates, diptych.rendering):
        yield from finder.find(module, module.__name__)
    for name in dp.__all__:  # what is compiled belongs to no module that doctest knows
        thing = getattr(dp, name)
        members = [thing, *vars(thing).values()] if isinstance(thing, type) else [thing]
        for member in members:
            text = getattr(member, "__doc__", None)
            if isinstance(text, str) and ">>>" in text and getattr(thing, "__module__", "") == "diptych._diptych":
                label = f"{name}.{getattr(member, '__name__', '')}"
                yield doctest.DocTestParser().get_doctest(text, {}, label, None, 0)


def with_examples():
    return [example for example in examples() if example.examples]


@pytest.mark.parametrize("example", with_examples(), ids=lambda example: example.name)
def test_docstrings_run(example):
    failures = []
    doctest.DocTestRunner(verbose=False).run(example, out=failures.append)
    assert not failures, "".join(failures)


def test_most_classes_and_all_functions_have_an_example():
    names = {example.name for example in with_examples()}
    assert len(names) >= 10, names


def test_all_that_is_public_is_documented():
    for name in dp.__all__:
        if name != "__version__":
            assert getattr(dp, name).__doc__, name


def blocks(page):
    """The fenced Python blocks, each with the number of its first line."""
    text = (ROOT / page).read_text()
    for match in re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        yield text[: match.start(1)].count("\n"), match[1]


@pytest.mark.parametrize("page", ["docs/python.md", "README.md"])
def test_pages_run(page, tmp_path, monkeypatch):
    """Blocks of a page run in order, in a folder that has the scenes. One that names Vulkan needs a device."""
    monkeypatch.setenv("MPLBACKEND", "Agg")
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    monkeypatch.chdir(tmp_path)
    names, ran = {}, 0
    for line, code in blocks(page):
        lacks_device = "vulkan" in code.lower() and not dp.devices()
        if lacks_device or ("matplotlib" in code and not importlib.util.find_spec("matplotlib")):
            continue
        exec(compile("\n" * line + code, str(ROOT / page), "exec"), names)
        ran += 1
    assert ran > 0, "no block could run"


def test_types_are_complete():
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    result = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--enable-incomplete-feature=Unpack",
                             "--cache-dir=/dev/null", "diptych"], cwd=ROOT / "python", capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_stub_has_what_the_module_has():
    """Names and members of the compiled classes, by the stub's text."""
    import ast
    from diptych import _diptych
    tree = ast.parse((pathlib.Path(dp.__file__).parent / "_diptych.pyi").read_text())
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}

    def members(node):
        own = {item.target.id if isinstance(item, ast.AnnAssign) else item.name for item in node.body
               if isinstance(item, (ast.AnnAssign, ast.FunctionDef))}
        bases = [getattr(base, "value", base) for base in node.bases]
        return own.union(*(members(classes[base.id]) for base in bases if base.id in classes))

    public = {name for name in vars(_diptych) if not name.startswith("_")}
    functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert public == {name for name in {*classes, *functions} if not name.startswith("_")}
    for name in public & set(classes):
        if not issubclass(getattr(_diptych, name), BaseException):
            bound = {member for member in vars(getattr(_diptych, name)) if not member.startswith("_")}
            assert bound == {member for member in members(classes[name]) if not member.startswith("_")}, name
