"""make licences: what the app is built on, with the licence of each, as deploy/LICENCES.md.

Names and versions are those of requirements.lock; licences are what the installed packages say of themselves.
"""

import re
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path

ROOT = Path(__file__).parents[1]
LIST = ROOT / "deploy" / "LICENCES.md"
TITLE = """# What SIMC is built on

SIMC itself is under the MIT licence (LICENSE). This list is made by `make licences`; do not edit it.
Streamlit brings fonts (Source Sans, Source Code, Material Symbols: SIL OFL 1.1 and Apache 2.0) and plotly.js (MIT).

| package | version | licence |
|---|---|---|
"""
VENDORED = "| uPlot (pages/common/live/vendor) | 1.6.32 | MIT |\n"


def main() -> None:
    """Write the list."""
    LIST.write_text(listed(), encoding="utf-8")


def listed() -> str:
    """The whole list as Markdown."""
    pins = re.findall(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)", (ROOT / "requirements.lock").read_text(), re.MULTILINE)
    rows = [f"| {name} | {version} | {licence(name)} |\n" for name, version in sorted(pins) if installed(name, version)]
    return TITLE + "".join(rows) + VENDORED


def installed(name: str, version: str) -> bool:
    """Whether this machine uses it in this version: some lines of the lock are for other systems."""
    try:
        return metadata(name)["Version"] == version
    except PackageNotFoundError:
        return False


def licence(name: str) -> str:
    """What the package says: an SPDX expression, else its classifier, else the first line of its licence text."""
    said = metadata(name)
    if said["License-Expression"]:
        return said["License-Expression"]
    classifiers = [line for line in said.get_all("Classifier", []) if line.startswith("License :: ")]
    if classifiers:
        return ", ".join(line.split(" :: ")[-1] for line in classifiers)
    return (said["License"] or "not said").splitlines()[0]


if __name__ == "__main__":
    main()
