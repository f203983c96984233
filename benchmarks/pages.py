"""`python -m benchmarks.pages`: what a page costs the server, in ms of its processor, beside a bare page.

    arrival    a visitor opens the link, on a warm server where others have opened it, and leaves
    again      the page runs once more in one session, with another tau_c each time

Time of the processor, so that it holds on a busy machine too, but for what two threads on one core take from each
other. Bounded: about a minute.
"""

import asyncio
import os
import tempfile
from pathlib import Path

from benchmarks.visitors import BARE, query, visit
from tests.browser.tools import Server
from tests.server.client import Client

PAGES = ("home", "plant", "from_data", "half_rule", "tuning", "rules", "cascade", "take_home", "many", "accuracy")
WARM, TIMES = 3, 30


async def cost(server: Server, page: str, link: str) -> tuple[float, float]:
    """Of an arrival and of a further run."""
    for _ in range(WARM):
        await visit(server.url, link, page)
    begin = used(server)
    for _ in range(TIMES):
        await visit(server.url, link, page)
    arrival, client = used(server) - begin, Client(server.url)
    await client.open()
    await client.run(page, link)
    begin = used(server)
    for i in range(TIMES):
        await client.run(page, link and query(f"{7 + (1 + i) / 100:g}"))
    again = used(server) - begin
    await client.close()
    return 1000 * arrival / TIMES, 1000 * again / TIMES


def used(server: Server) -> float:
    """Seconds of the processor that the server has had."""
    fields = Path(f"/proc/{server.process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Print the table."""
    print("| | arrival, ms | again, ms |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        rows(Server(script), {"a bare page": ("", "")})
    rows(Server(), {page: (page, query("7")) for page in PAGES})


def rows(server: Server, pages: dict[str, tuple[str, str]]) -> None:
    """A row for each page, with its link."""
    try:
        for name, (page, link) in pages.items():
            arrival, again = asyncio.run(cost(server, page, link))
            print(f"| {name} | {arrival:.0f} | {again:.0f} |", flush=True)
    finally:
        server.stop()


if __name__ == "__main__":
    main()
