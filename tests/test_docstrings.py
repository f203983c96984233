"""Docstrings of the public names are numpydoc: parameters, fields and results are named; there are examples."""

import dataclasses
import inspect
import re

import pytest

import simc_core

FUNCTIONS = {name: value for name, value in vars(simc_core).items() if inspect.isfunction(inspect.unwrap(value))}
CLASSES = {name: value for name, value in vars(simc_core).items() if dataclasses.is_dataclass(value)}


def sections(text: str) -> dict[str, str]:
    parts = re.split(r"^(\w[\w ]*)\n-{3,}\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def documented(name: str) -> dict[str, str]:
    return sections(inspect.getdoc(inspect.unwrap(getattr(simc_core, name))))


def named(section: str) -> list[str]:
    heads = re.findall(r"^\*{0,2}(\w+(?:, \w+)*) : \S", section, flags=re.MULTILINE)
    return [name for head in heads for name in head.split(", ")]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_and_results_are_named(name):
    found = documented(name)
    parameters = named(found["Parameters"])
    assert set(parameters) == set(inspect.signature(FUNCTIONS[name]).parameters)
    assert len(parameters) == len(set(parameters))
    assert found["Returns"].strip()


@pytest.mark.parametrize("name", CLASSES)
def test_fields_are_named(name):
    found = documented(name)
    fields = named(found.get("Parameters", "") + found.get("Attributes", ""))
    assert sorted(fields) == sorted(field.name for field in dataclasses.fields(CLASSES[name]))


@pytest.mark.parametrize("name", [*FUNCTIONS, *(name for name in CLASSES if "Parameters" in documented(name))])
def test_there_is_an_example_that_uses_the_name(name):
    """`make doctest` runs them. Classes with Attributes are results, which a user reads and does not make."""
    lines = [line for line in documented(name)["Examples"].splitlines() if line.startswith((">>> ", "... "))]
    assert any(re.search(rf"\b{name}\b", line) for line in lines if " import " not in line)
