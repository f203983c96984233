"""`python -m benchmarks.soak [minutes]`: visitors come, work and go for an hour; what the process holds meanwhile.

A few stay and release the slider, each release another design; others open one page after another and leave. Now and
then the resident memory, open descriptors and threads of the process.
"""

import asyncio
import random
import sys
import time
from pathlib import Path

from benchmarks.visitors import memory, query
from tests.browser.tools import Server
from tests.server.client import Client

MINUTES, LONGEST = 60.0, 600.0
STAYING, PAUSE = 5, 10.0  # clients that stay, and seconds between two releases of one of them
COMING = 6.0  # seconds between two that come
PAGES = ("", "plant", "from_data", "half_rule", "tuning", "rules", "cascade", "take_home", "many", "accuracy")
LOOKS = 12  # lines of the table


async def soak(seconds: float) -> None:
    """Print the table while it grows."""
    server, runs, end = Server(), [0], time.monotonic() + seconds
    try:
        print(f"{'min':>5} {'runs':>7} {'MB':>7} {'descriptors':>12} {'threads':>8}")
        async with asyncio.timeout(seconds + 120):
            work = [stay(server.url, end, runs) for _ in range(STAYING)]
            await asyncio.gather(*work, come_and_go(server.url, end, runs), watch(server, end, seconds / LOOKS, runs))
            await asyncio.sleep(5)  # the last sessions are closed
        print("all have left:")
        look(server, seconds, runs)
    finally:
        server.stop()


async def stay(url: str, end: float, runs: list[int]) -> None:
    """A client that tunes until the end."""
    client = Client(url)
    await client.open()
    while time.monotonic() < end:
        await client.run("tuning", query(f"{random.uniform(5, 9):.5g}"))
        runs[0] += 1
        await asyncio.sleep(random.uniform(0.5, 1.5) * PAUSE)
    await client.close()


async def come_and_go(url: str, end: float, runs: list[int]) -> None:
    """Visitors who open a page each, with a plant that nobody had before, and leave."""
    while time.monotonic() < end:
        client = Client(url)
        await client.open()
        theta = f"{random.uniform(1, 9):.6g}"
        await client.run(random.choice(PAGES), f"plant=exp(-{theta}s)/((6s%2B1)(4s%2B1))&order={random.randint(1, 2)}")
        runs[0] += 1
        await client.close()
        await asyncio.sleep(random.uniform(0.5, 1.5) * COMING)


async def watch(server: Server, end: float, every: float, runs: list[int]) -> None:
    """A line now and then."""
    begin = time.monotonic()
    while time.monotonic() < end:
        look(server, time.monotonic() - begin, runs)
        await asyncio.sleep(min(every, max(end - time.monotonic(), 0.1)))


def look(server: Server, seconds: float, runs: list[int]) -> None:
    """One line of the table."""
    process = Path(f"/proc/{server.process.pid}")
    descriptors, threads = (len(list((process / what).iterdir())) for what in ("fd", "task"))
    print(f"{seconds / 60:5.1f} {runs[0]:7d} {memory(server):7.0f} {descriptors:12d} {threads:8d}", flush=True)


if __name__ == "__main__":
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else MINUTES
    if not 0 < minutes <= LONGEST:
        sys.exit(f"minutes must be > 0 and <= {LONGEST:g}, found {minutes:g}")
    asyncio.run(soak(60 * minutes))
