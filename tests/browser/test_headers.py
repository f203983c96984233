"""The policy of our answers in a real browser: pages work under it, and what it forbids does not happen."""

from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

from playwright.sync_api import expect

from tests.browser.tools import Server

# That every page and every tab of them works under the policy is seen in test_for_everyone.py.
MODEL = ("plant", "from_data?example=step", "half_rule")
PAGES = (
    "",
    *MODEL,
    "tuning",
    "rules",
    "cascade",
    "take_home",
    "many",
    "lessons",
    "lessons?lesson=V1&step=3",
    "accuracy",
    "sources",
)
REFUSED = "chrome-error://chromewebdata/"


def test_what_the_policy_forbids_does_not_happen(server, chromium):
    page = chromium.new_page()
    page.goto(server)
    forbidden = page.evaluate(
        """() => new Promise(done => {
            const found = [];
            document.addEventListener('securitypolicyviolation', event => {
                found.push(event.effectiveDirective);
                if (found.length === 3) done(found.sort());
            });
            const script = document.createElement('script');
            script.textContent = 'globalThis.intruder = 1';
            document.head.append(script);
            new Image().src = 'https://example.org/a.png';
            fetch('https://example.org/').catch(() => {});
        })"""
    )
    assert forbidden == ["connect-src", "img-src", "script-src-elem"]
    assert page.evaluate("globalThis.intruder") is None
    page.close()


class CoursePage(BaseHTTPRequestHandler):
    """A page of another origin with ours in a frame; the query is the address of ours."""

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(f'<iframe src="{self.path.partition("?")[2]}" width="900" height="700"></iframe>'.encode())

    def log_message(self, *_) -> None:
        pass


@contextmanager
def course() -> Iterator[str]:
    """The address of a course page; each one is another origin."""
    with ThreadingHTTPServer(("127.0.0.1", 0), CoursePage) as page:
        Thread(target=page.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{page.server_port}"
        page.shutdown()


def test_a_page_that_is_named_frames_ours_and_another_one_does_not(chromium):
    with course() as named, course() as other:
        server = Server(environment={"SIMC_FRAMED_BY": named})
        page = chromium.new_page()
        try:
            page.goto(f"{named}/?{server.url}/plant")
            expect(page.frame_locator("iframe").locator(".js-plotly-plot").first).to_be_visible(timeout=30_000)
            page.goto(f"{other}/?{server.url}/plant")
            assert page.frames[1].url == REFUSED
        finally:
            page.close()
            server.stop()


def test_no_other_page_frames_ours_when_none_is_named(server, chromium):
    page = chromium.new_page()
    with course() as other:
        page.goto(f"{other}/?{server}/plant")
        assert page.frames[1].url == REFUSED
    page.close()


def test_the_settings_are_copied_as_they_are_shown(server, open_page):
    page = open_page(f"{server}/tuning?plant=2/(5s%2B1)*exp(-s)")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    box = page.locator(".st-key-settings_text")
    shown = box.locator("pre").inner_text()
    assert "Kc = " in shown
    box.get_by_role("button").click()
    expect(box.get_by_role("button")).to_have_text("Copied")
    assert page.evaluate("navigator.clipboard.readText()") == shown
