"""What stands between the network and the pages: who may open a session, headers, static files. Knows no page.

origin              a websocket from a foreign page is refused here, and nobody outside is asked
headers             what a browser may load, run and frame
compressed_static   the files of the browser's side, compressed once
answers             what a browser waits for is not lost when a run begins
"""

from starlette.middleware import Middleware

from server.answers import keep_answers
from server.compressed_static import CompressedStatic
from server.headers import SecurityHeaders
from server.origin import OriginCheck


def middleware() -> list[Middleware]:
    """The layers round the app, outermost first."""
    keep_answers()
    return [Middleware(OriginCheck), Middleware(SecurityHeaders), Middleware(CompressedStatic)]
