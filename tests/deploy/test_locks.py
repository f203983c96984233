"""The locks hold what the human lists ask for, each file with its hash; the licence list names what the lock holds."""

import re
import tomllib

import pytest

from deploy import licences
from tests.browser.tools import ROOT

PIN = re.compile(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)(.*(?:\n    --hash=\S+(?: \\)?)*)", re.MULTILINE)


def pins(name: str) -> dict[str, set[str]]:
    """Name and versions (several where systems differ) of a lock."""
    found: dict[str, set[str]] = {}
    for package, version, _ in PIN.findall((ROOT / name).read_text()):
        found.setdefault(package.lower(), set()).add(version)
    return found


@pytest.mark.parametrize("lock", ["requirements.lock", "requirements-dev.lock"])
def test_every_package_has_the_hashes_of_its_files(lock):
    entries = PIN.findall((ROOT / lock).read_text())
    assert len(entries) > 40
    for _, _, rest in entries:
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", rest)


def test_what_runs_is_what_the_list_asks_for():  # else: make lock
    wanted = dict(re.findall(r"^([^=\n]+)==([^\s;]+)", (ROOT / "requirements.txt").read_text(), re.MULTILINE))
    locked = pins("requirements.lock")
    assert {name: locked[name] for name in wanted} == {name: {version} for name, version in wanted.items()}


def test_what_is_tested_is_what_runs():  # else: make lock
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    wanted = dict(line.split("==") for line in groups["dev"])
    runs, tested = pins("requirements.lock"), pins("requirements-dev.lock")
    assert {name: tested[name] for name in wanted} == {name: {version} for name, version in wanted.items()}
    assert {name: tested[name] for name in runs} == runs


def test_the_licence_list_is_todays():  # else: make licences
    assert (ROOT / "deploy" / "LICENCES.md").read_text() == licences.listed()
