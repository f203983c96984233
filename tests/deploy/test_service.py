"""The unit for systemd, the image and the compose file, as far as they can be tried without systemd and Docker."""

import asyncio
import re
import shutil
import subprocess

import pytest

from tests.browser.tools import ROOT, Server
from tests.server.client import Client

DEPLOY = ROOT / "deploy"


@pytest.fixture
def unit(tmp_path) -> str:
    """The unit with the app where it is here."""
    path = tmp_path / "simc@8501.service"
    text = (DEPLOY / "simc@.service").read_text()
    path.write_text(text.replace("/opt/simc/.venv/bin/streamlit", shutil.which("true")).replace("/opt/simc", str(ROOT)))
    return str(path)


def analyze(*arguments: str) -> subprocess.CompletedProcess:
    assert shutil.which("systemd-analyze"), "apt-get install systemd"
    return subprocess.run(["systemd-analyze", *arguments], capture_output=True, text=True, check=False, timeout=30)


def test_systemd_understands_every_line_of_the_unit(unit):
    found = analyze("verify", "--man=no", unit)
    ours = [line for line in found.stderr.splitlines() if "simc@" in line]
    assert (found.returncode, ours) == (0, [])


def test_systemd_finds_the_unit_well_enclosed(unit):
    """0 is the least a process can do to its machine, 10 the most; systemd's own words: OK below 5, SAFE below 2."""
    found = analyze("security", "--offline=yes", "--no-pager", "--threshold=20", unit)
    assert found.returncode == 0, found.stdout


def test_the_image_holds_all_that_the_app_needs(tmp_path):
    """What the Dockerfile copies, alone in a folder, starts with the command of the unit and answers."""
    copied = re.findall(r"^COPY (.+) (\S+)$", (DEPLOY / "Dockerfile").read_text(), re.MULTILINE)
    for sources, _ in copied:
        for source in sources.split():
            if (ROOT / source).is_dir():
                shutil.copytree(ROOT / source, tmp_path / source)
            else:
                shutil.copy(ROOT / source, tmp_path / source)
    kept_out = (DEPLOY / "Dockerfile.dockerignore").read_text().splitlines()
    assert {f"!{source}" for sources, _ in copied for source in sources.split()} == {
        line for line in kept_out if line.startswith("!")
    }
    server = Server(tmp_path / "app.py", folder=tmp_path, options=("--server.address=0.0.0.0",))
    try:
        asyncio.run(asyncio.wait_for(visit(server.url), 60))
    finally:
        server.stop()


async def visit(url: str) -> None:
    client = Client(url)
    await client.open()
    await client.run("tuning")
    await client.close()
