"""Every public function and method tells its parameters, what it gives, and an example that is run."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import saltus
import saltus.dask
import saltus.systems
from saltus._tables import TABLES


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Functions and methods by their names."""
    for module in (saltus, saltus.dask, saltus.systems):
        for name in [*module.__all__, "map"]:
            one = getattr(module, name, None)
            if inspect.isfunction(one):
                yield f"{module.__name__}.{name}", one
            # functions of an expression are NumPy's own, which call them
            elif inspect.isclass(one) and not issubclass(one, (Exception, saltus.systems.Expression)):
                yield from methods(f"{module.__name__}.{name}", one)


def methods(name: str, kind: type) -> Iterator[tuple[str, Callable[..., Any]]]:
    for method, found in vars(kind).items():
        call = getattr(found, "__func__", found)
        if not method.startswith("_") and inspect.isfunction(call):
            yield f"{name}.{method}", call


FUNCTIONS = dict(public())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_docstring_tells_parameters_results_and_an_example(name: str) -> None:
    function = FUNCTIONS[name]
    told = inspect.getdoc(function) or ""
    sections = re.findall(r"^(\w[\w ]+)\n-+$", told, re.MULTILINE)
    signature = inspect.signature(function)
    for parameter in signature.parameters.values():
        if parameter.name not in ("self", "cls"):
            wanted = rf"^\*{{0,2}}(\*{{0,2}}\w+, )*\*{{0,2}}{parameter.name}(, \w+)*( :|$)"
            assert re.search(wanted, told, re.MULTILINE), f"{name} does not tell {parameter.name}"
    if signature.return_annotation not in ("None", None):
        assert "Returns" in sections, f"{name} does not tell what it gives"
    assert "Examples" in sections, f"{name} has no example"
    assert ">>> " in told


@pytest.mark.parametrize("module", [saltus, saltus.systems], ids=lambda module: module.__name__)
def test_each_class_has_a_docstring_and_those_that_are_made_by_hand_an_example(module: Any) -> None:
    for name in module.__all__:
        one = getattr(module, name)
        if not inspect.isclass(one):
            continue
        told = inspect.getdoc(one) or ""
        assert told, name
        # tables have their keys, errors their message, and results come out of functions
        given = name in module.__all__ and (one in TABLES.values() or issubclass(one, Exception))
        if not given:
            assert "Examples\n--------" in told, f"{name} has no example"
