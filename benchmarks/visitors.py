"""Visitors of one process as websockets, without browsers: how long their pages take, what they need of memory.

n sessions   clients that stay, each releasing the slider now and then: from the request to the end of the script
n arrivals   clients that open one link within a few seconds: from the connection to the end of the script, beside
             a bare page in the same run
"""

import asyncio
import math
import random
import re
import statistics
import tempfile
import time
from pathlib import Path

from tests.browser.tools import Server
from tests.server.client import Client

SESSIONS, RELEASES, PAUSE = (1, 30, 100), 3, 10.0  # pause: mean seconds between two releases of one session
ARRIVALS = ((30, 1.0), (100, 10.0))  # visitors, and the seconds within which they come
PLANT = "exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"
BARE = "import streamlit as st\nst.metric('value', st.slider('tau_c', 0, 1000, 500))\n"
PATIENCE = 60.0  # s


async def sessions(n: int) -> dict[str, float]:
    """n clients of one process, whose first designs differ."""
    server = Server()
    try:
        async with asyncio.timeout(4 * PATIENCE):
            await visit(server.url, query("7"))  # the process has imported everything
            before, clients = memory(server), [Client(server.url) for _ in range(n)]
            for each in clients:  # one after the other: a class that comes in, not a stampede
                await each.open()
                await each.run("tuning", query("7"))
            times = await asyncio.gather(
                *(release(each, *((RELEASES, PAUSE) if n > 1 else (10, 0.5))) for each in clients)
            )
            grown = memory(server) - before
            await asyncio.gather(*(each.close() for each in clients))
        found = [time for each in times for time in each]
        return {"median ms": statistics.median(found), "p95 ms": p95(found), "MB per session": grown / n}
    finally:
        server.stop()


async def release(client: Client, times: int, pause: float) -> list[float]:
    """Releases of the slider at random moments; ms of each."""
    found = []
    for _ in range(times):
        await asyncio.sleep(random.uniform(0.5, 1.5) * pause)
        found.append(await client.run("tuning", query(f"{random.uniform(5, 9):.4g}")))
    return found


def all_arrivals(n: int, within: float) -> dict[str, dict[str, float]]:
    """Arrivals at the tuning page and, in the same run, at a bare one."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        bare = asyncio.run(arrivals(Server(script), "", "", n, within))
    return {"tuning": asyncio.run(arrivals(Server(), "tuning", query("7"), n, within)), "bare": bare}


async def arrivals(server: Server, page: str, link: str, n: int, within: float) -> dict[str, float]:
    """n visitors who open one link at random moments within so many seconds."""
    try:
        async with asyncio.timeout(PATIENCE):
            await visit(
                server.url, "" if not page else f"{link}&b=0.9", page
            )  # everything is imported, no table is made
            times = await asyncio.gather(*(late(random.uniform(0, within), server.url, link, page) for _ in range(n)))
        return {"median ms": statistics.median(times), "p95 ms": p95(times)}
    finally:
        server.stop()


async def late(wait: float, *link: str) -> float:
    """A visit after a while."""
    await asyncio.sleep(wait)
    return await visit(*link)


async def visit(url: str, link: str, page: str = "tuning") -> float:
    """Open a page, and leave; ms from the connection to the end of the script."""
    begin, client = time.perf_counter(), Client(url)
    await client.open()
    await client.run(page, link)
    taken = 1000 * (time.perf_counter() - begin)
    await client.close()
    return taken


def query(tau_c: str) -> str:
    """The link of a design."""
    return f"plant={PLANT}&order=1&tau_c={tau_c}"


def memory(server: Server) -> float:
    """Resident memory of the process, MB."""
    status = Path(f"/proc/{server.process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024


def p95(times: list[float]) -> float:
    """95 % of the times are below."""
    return sorted(times)[math.ceil(0.95 * len(times)) - 1]
