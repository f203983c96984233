"""Who may open a session: pages of this very address, and those of `server.corsAllowedOrigins`.

Streamlit asks the same question, but for an origin that is not its own it first asks a host outside which address
this machine has, twice, and every visitor waits. So it is answered here, and Streamlit does not see the origin:
without one it takes the connection as ours.
"""

from urllib.parse import urlsplit

from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit import config

POLICY_VIOLATION = 1008  # RFC 6455, 7.4.1


class OriginCheck:
    """ASGI middleware for websockets; everything else passes.

    Parameters
    ----------
    app : ASGIApp
        What is protected.
    """

    def __init__(self, app: ASGIApp):
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a websocket on without its origin, or close it before it is open."""
        if scope["type"] != "websocket":
            await self.app(scope, receive, send)
            return
        origins, hosts = _values(scope, b"origin"), _values(scope, b"host")
        if origins and not (len(origins) == len(hosts) == 1 and is_allowed(origins[0], hosts[0])):
            await send({"type": "websocket.close", "code": POLICY_VIOLATION})
            return
        headers = [(name, value) for name, value in scope["headers"] if name != b"origin"]
        await self.app({**scope, "headers": headers}, receive, send)


def is_allowed(origin: str, host: str) -> bool:
    """Whether a page of this origin may talk to the server that was asked as this host.

    Parameters
    ----------
    origin : str
        The header Origin, such as "https://simc.example.org".
    host : str
        The header Host, such as "simc.example.org" or "127.0.0.1:8501".

    Returns
    -------
    bool
        True for the same host and port, and for the origins in the setting `server.corsAllowedOrigins`.
    """
    origin = origin.lower()
    try:
        place = urlsplit(origin).netloc
    except ValueError:  # not an address at all
        return False
    if place and place == host.lower():
        return True
    return origin in {allowed.strip().lower().rstrip("/") for allowed in config.get_option("server.corsAllowedOrigins")}


def _values(scope: Scope, name: bytes) -> list[str]:
    return [value.decode("latin-1") for key, value in scope["headers"] if key == name]
