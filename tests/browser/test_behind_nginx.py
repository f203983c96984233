"""deploy/nginx.conf with Debian's nginx in front of two processes: a visitor stays with one, and everything works."""

import json
import os
import re
import shutil
import socket
import subprocess
import time
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
import uvicorn
from playwright.sync_api import expect

from pages.common.session import project
from pages.common.session.design import Design
from pages.common.session.loops import Entry, Loops
from simc_core import Plant
from tests.browser.tools import ROOT, Server, idle, watch

NODES = ("a", "b")
pytestmark = pytest.mark.xdist_group("nginx")  # they share nginx and a process, which the last one stops
PATIENCE = 30  # s


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory, server):
    """The address of nginx and the two processes behind it: the server of all tests, and one that may be stopped."""
    nginx = shutil.which("nginx", path=os.environ["PATH"] + ":/usr/sbin")
    assert nginx, "apt-get install nginx"
    folder, port = tmp_path_factory.mktemp("nginx"), free_port()
    second = Server()
    ports = {"a": urlsplit(server).port, "b": second.port}
    site = (ROOT / "deploy" / "nginx.conf").read_text()
    site = site.replace("127.0.0.1:8501", f"127.0.0.1:{ports['a']}")
    site = site.replace("127.0.0.1:8502", f"127.0.0.1:{ports['b']}")
    (folder / "site.conf").write_text(site.replace("listen 80;", f"listen 127.0.0.1:{port};"))
    temporary = "".join(
        f"{name}_temp_path {folder}/{name};" for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    )
    main = f"pid {folder}/pid; error_log {folder}/error.log; events {{}} http {{ access_log off; {temporary} "
    (folder / "nginx.conf").write_text(main + f"include {folder}/site.conf; }}")
    command = [nginx, "-c", str(folder / "nginx.conf"), "-p", str(folder), "-g", "daemon off; master_process off;"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        answered(port)
        yield f"http://127.0.0.1:{port}", second
    finally:
        process.terminate()
        process.wait(10)
        second.stop()


def answered(port: int) -> None:
    end = time.monotonic() + PATIENCE
    while True:
        try:
            with urlopen(f"http://127.0.0.1:{port}/_stcore/health", timeout=1):
                return
        except OSError:
            assert time.monotonic() < end, "nginx did not answer"
            time.sleep(0.1)


def test_newcomers_get_one_of_the_two_and_keep_it(cluster):
    url, _ = cluster
    given = []
    for _ in range(40):
        with urlopen(url, timeout=10) as answer:
            given.append(answer.headers["Set-Cookie"].split(";")[0])
    assert set(given) == {"simc_node=a", "simc_node=b"}  # by lot: 1 in 10^12 that one is missing


def test_nginx_lets_go_of_a_silent_connection_before_the_app_closes_it():
    """Else a request that meets the closing counts as a failure there, and visitors lose their session."""
    kept = [
        float(seconds) for seconds in re.findall(r"keepalive_timeout (\S+)s;", (ROOT / "deploy/nginx.conf").read_text())
    ]
    assert len(kept) == len(NODES)
    assert max(kept) < uvicorn.Config("any").timeout_keep_alive  # Streamlit leaves it as it is


@pytest.mark.parametrize("node", NODES)
def test_pages_uploads_and_downloads_work(cluster, chromium, tmp_path, node):
    url, _ = cluster
    faults: list[str] = []
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    context.add_cookies([{"name": "simc_node", "value": node, "url": url}])
    page = context.new_page()
    watch(page, faults)
    page.goto(f"{url}/tuning")
    idle(page)
    expect(page.locator(".live[data-exact=true]")).to_be_visible()
    file = tmp_path / "mine.json"
    file.write_text(project.dump(Loops((Entry(Design(Plant(7.0, 1.0, (9.0,)))),))))
    page.locator("input[type=file]").set_input_files(file)
    expect(page.locator(".st-key-line .katex").first).to_contain_text("9s")
    idle(page)
    with page.expect_download() as download:
        page.get_by_role("button", name="Save project").click()
    [loop] = json.loads(Path(download.value.path()).read_text())["loops"]
    assert loop["design"]["plant"] == "7 exp(-s)/(9 s + 1)"
    assert [each["value"] for each in context.cookies() if each["name"] == "simc_node"] == [node]
    large = tmp_path / "large.json"
    large.write_bytes(b" " * 1_100_000)
    page.locator("input[type=file]").set_input_files(large)
    expect(page.get_by_text("1.0MB or smaller").or_(page.get_by_text("must be 1"))).to_be_visible()
    context.close()
    assert not faults


def test_whoever_loses_a_process_goes_on_at_the_other(cluster, chromium):
    url, second = cluster
    second.stop()
    context = chromium.new_context()
    context.add_cookies([{"name": "simc_node", "value": "b", "url": url}])
    page = context.new_page()
    page.goto(f"{url}/plant?plant=2/(5s%2B1)")
    idle(page)
    expect(page.locator(".st-key-line .katex").first).to_contain_text("5s")
    context.close()
