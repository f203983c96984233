"""What `pip install .` gives: simc_core alone, which needs neither the pages nor Streamlit."""

import subprocess
import sys
import tomllib
import zipfile

import pytest

from tests.browser.tools import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
# None in sys.modules makes an import fail as if the package were not installed. scipy.signal and scipy.stats stand here
# because they double the time in which every process of the program starts.
IMPORT = """
import sys
sys.modules.update(dict.fromkeys(["streamlit", "plotly", "control", "pages", "scipy.signal", "scipy.stats"]))
sys.path.insert(0, sys.argv[1])
import simc_core
print(simc_core.__file__, simc_core.simc(simc_core.FirstOrderDelay(1, 1, 8)).tau_I)
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, built without network by the build backend of the development environment."""
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return next(folder.glob("*.whl"))


def test_the_wheel_holds_the_library_alone(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0] for name in names} == {"simc_core", f"simc-{PROJECT['version']}.dist-info"}
    modules = {str(path.relative_to(ROOT)) for path in (ROOT / "simc_core").rglob("*.py")}
    assert {name for name in names if name.endswith(".py")} == modules
    assert "simc_core/py.typed" in names


def test_the_wheel_works_without_the_app(wheel, tmp_path):
    command = [sys.executable, "-P", "-c", IMPORT, str(wheel)]
    printed = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True).stdout
    place, tau_I = printed.split()
    assert place.startswith(str(wheel))
    assert float(tau_I) == 8  # [SK03 Table 1]: min(tau1, 4 (tau_c + theta)) = min(8, 8)


def test_the_app_extra_is_what_the_app_runs_with():
    assert PROJECT["optional-dependencies"]["app"] == (ROOT / "requirements.txt").read_text().splitlines()
