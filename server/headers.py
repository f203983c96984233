"""What a browser may load, run and frame on our pages. Nothing from another host, so nothing leaves the machine.

Streamlit and our components need more than 'self' in a few places; each is named beside its line. A browser test
opens every page and fails on any violation.
"""

import os
import re

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

FRAMED_BY = "SIMC_FRAMED_BY"
ORIGIN = re.compile(r"https?://[a-z0-9.-]+(:\d{1,5})?", re.IGNORECASE)
POLICY = {
    "default-src": "'self'",
    # blob: the code of our live components comes with the session and is loaded as a module from a blob.
    # The hash is that of the one inline script in Streamlit's index.html, `window.prerenderReady = false`.
    # wasm: how Streamlit's side multiplies 64-bit integers of messages (long.js); it permits no eval of a text.
    "script-src": "'self' blob: 'wasm-unsafe-eval' 'sha256-THxz9J9+wf7rhwR2YkXJoSZ13UCmYyC+3lNDv2+8ugA='",
    # Streamlit (emotion) and Plotly write their styles into the page.
    "style-src": "'self' 'unsafe-inline'",
    # data: Plotly's picture of a figure, icons; blob: the picture that is downloaded.
    "img-src": "'self' data: blob:",
    "font-src": "'self' data:",
    "connect-src": "'self'",
    "worker-src": "'self' blob:",
    "frame-src": "'none'",
    "object-src": "'none'",
    "base-uri": "'self'",
    "form-action": "'self'",
}
USUAL = {
    "X-Content-Type-Options": "nosniff",
    # The address of a page holds the design: another site need not learn it.
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}


class SecurityHeaders:
    """ASGI middleware: the headers above on every answer.

    Parameters
    ----------
    app : ASGIApp
        What answers.
    framed_by : str, optional
        Origins, separated by blanks, whose pages may show ours in a frame, such as "https://course.example.org".
        None: the environment variable SIMC_FRAMED_BY. Our own pages always may.

    Raises
    ------
    ValueError
        If one of them is not an origin.
    """

    def __init__(self, app: ASGIApp, framed_by: str | None = None):
        self.app = app
        self.headers = USUAL | {"Content-Security-Policy": policy(framed_by or os.environ.get(FRAMED_BY, ""))}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer with the headers."""

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(self.headers)
            await send(message)

        await self.app(scope, receive, with_headers if scope["type"] == "http" else send)


def policy(framed_by: str = "") -> str:
    """The value of Content-Security-Policy.

    Parameters
    ----------
    framed_by : str
        Origins, separated by blanks, that may show our pages in a frame.

    Returns
    -------
    str
        One directive after the other, separated by semicolons.

    Raises
    ------
    ValueError
        If one of them is not an origin.

    References
    ----------
    .. [1] Content Security Policy Level 3, https://www.w3.org/TR/CSP3/
    """
    origins = framed_by.split()
    for origin in origins:
        if not ORIGIN.fullmatch(origin):
            raise ValueError(f"{FRAMED_BY} must hold origins such as https://course.example.org, found {origin!r}")
    directives = POLICY | {"frame-ancestors": " ".join(["'self'", *origins])}
    return "; ".join(f"{name} {sources}" for name, sources in directives.items())
