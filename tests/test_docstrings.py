"""Docstrings of the public functions are numpydoc: every parameter is named, and what is returned."""

import inspect
import re

import pytest

import simc_core

FUNCTIONS = {name: value for name, value in vars(simc_core).items() if inspect.isfunction(inspect.unwrap(value))}


def sections(text: str) -> dict[str, str]:
    parts = re.split(r"^(\w[\w ]*)\n-{3,}\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_and_results_are_named(name):
    function = inspect.unwrap(FUNCTIONS[name])
    found = sections(inspect.getdoc(function))
    heads = re.findall(r"^\*{0,2}(\w+(?:, \w+)*) : \S", found["Parameters"], flags=re.MULTILINE)
    named = [parameter for head in heads for parameter in head.split(", ")]
    assert set(named) == set(inspect.signature(function).parameters)
    assert len(named) == len(set(named))
    assert found["Returns"].strip()
