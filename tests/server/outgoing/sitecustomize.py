"""Loaded by a Python whose PYTHONPATH names this folder: writes down every address it asks for or connects to."""

import os
import sys

WATCHED = ("socket.connect", "socket.sendto", "socket.sendmsg", "socket.getaddrinfo", "socket.gethostbyname")
LOG = open(os.environ["OUTGOING_LOG"], "a", buffering=1)  # noqa: SIM115  open as long as the process


def note(event: str, arguments: tuple) -> None:
    if event in WATCHED:
        LOG.write(f"{event} {arguments[-1] if event == 'socket.connect' else arguments}\n")


sys.addaudithook(note)
LOG.write("watching\n")
