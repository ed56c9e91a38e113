"""The built page in a real browser, as `pendula lab` serves and exports it."""

from __future__ import annotations

import os
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import browsers
import pendula
from browsers import browser
from lab_pages import asked, serving
from pendula.lab import page, read_link
from pendula.lab.export import export

CHOOSE_EXAMPLES = """(async () => {
  const list = document.querySelector("header select");
  const links = new Set();
  for (const { value } of list.options) {
    list.value = value;
    list.dispatchEvent(new Event("change", { bubbles: true }));
    await new Promise((done) => setTimeout(done, 700));
    links.add(location.hash);
  }
  return [...links];
})()"""
LINK = "#system=simple&length=1&state=2,0&t_max=20&lang=en"
PICTURE = (
    "#system=double&form=rods&state=2.0943951023931957,-0.17453292519943295,0,0&t_max=30"
    "&method=taylor&lang=en&theme=light&speed=5&view=compare&compare=rk4,dop853,gauss4"
)
PARTED = """new Promise((done) => {
  const look = setInterval(() => {
    const clock = /^(\\d+\\.\\d{3}) s$/m.exec(document.body.innerText);
    if (clock && Number(clock[1]) > 13) done(clearInterval(look));
  }, 20);
})"""  # the clock of the stage is beyond 13 s
KEPT = "navigator.serviceWorker.ready.then(({ scope }) => scope)"
PERIOD = f"Period: exact {pendula.SimplePendulum().period(2.0):.5g} s"  # of a release at 2 rad

pytestmark = [
    pytest.mark.skipif(not (page.STATIC / page.ONE_FILE).exists(), reason="not built: make lab"),
    pytest.mark.skipif(not browsers.PROGRAM, reason="there is no chromium here"),
]


def check(url: str, text: str, folder: Path) -> None:
    """The page shows the text, complains of nothing, and asks for nothing from elsewhere."""
    with browser(folder) as one:
        one.open(url)
        assert one.shows(text)
        assert one.said == []
        assert one.requested
        for address in one.requested:
            own = (
                address.startswith(("blob:", "data:")) or urlsplit(address)[:2] == urlsplit(url)[:2]
            )
            assert own, address


def test_every_built_file_is_served_and_the_page_holds_no_script() -> None:
    built = {path.relative_to(page.STATIC) for path in page.STATIC.rglob("*") if path.is_file()}
    with serving() as server:
        served = {Path(name.lstrip("/")) for name in server.files if name != "/"}
        assert served == built - {Path(page.ONE_FILE)}
        _, _, html = asked(server, "/")
    assert b"<style" not in html
    assert b" style=" not in html
    assert b"://" not in html


def test_the_server_shows_the_pendulum_of_a_link(tmp_path: Path) -> None:
    with serving() as server:
        check(f"{server.url}{LINK}", PERIOD, tmp_path)


def test_the_page_is_kept_for_when_the_server_has_ended(tmp_path: Path) -> None:
    with serving() as server, browser(tmp_path) as one:
        one.open(f"{server.url}{LINK}")
        assert one.shows(PERIOD)
        assert one.value(KEPT) == server.url
    assert one.said == []


def test_a_link_is_refused_by_the_page_too(tmp_path: Path) -> None:
    with serving() as server:
        check(f"{server.url}{LINK}&metod=rk4", "metod", tmp_path)


def test_the_addresses_of_all_examples_are_links_of_python(tmp_path: Path) -> None:
    """What the page writes is read, and means the same once Python has written it again."""
    with serving() as server, browser(tmp_path) as one:
        one.open(f"{server.url}{LINK}")
        assert one.shows(PERIOD)
        links = one.value(CHOOSE_EXAMPLES)
    assert len(links) > 5
    for link in links:
        recipe = read_link(link)
        assert read_link(recipe.link()) == recipe


def test_the_picture_of_the_readme_is_drawn(tmp_path: Path) -> None:
    """It becomes the one in docs/images where PENDULA_LAB_PICTURE names that file."""
    with serving() as server, browser(tmp_path) as one:
        one.open(f"{server.url}{PICTURE}")
        one.picture(1280, 790)  # sets the size
        assert one.shows("gauss4")
        one.value(PARTED)
        drawn = one.picture(1280, 790)
    assert drawn.startswith(b"\x89PNG")
    assert 50_000 < len(drawn) < 150_000  # an empty page has 10 kB
    if "PENDULA_LAB_PICTURE" in os.environ:
        Path(os.environ["PENDULA_LAB_PICTURE"]).write_bytes(drawn)


def test_one_file_works_from_a_disk(tmp_path: Path) -> None:
    alone = export(tmp_path / "lab.html")
    check(f"{alone.as_uri()}{LINK}", PERIOD, tmp_path)


def test_one_file_works_in_a_sandboxed_frame(tmp_path: Path) -> None:
    export(tmp_path / "lab.html")
    course = tmp_path / "course.html"
    frame = f'<iframe src="lab.html{LINK}&embed=1" sandbox="allow-scripts"></iframe>'
    course.write_text(f"<!doctype html><title>course</title>{frame}", encoding="utf-8")
    check(course.as_uri(), PERIOD, tmp_path)


def test_a_folder_works_below_a_path_of_any_server(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    export(tmp_path / "a/lab")

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None: ...

    handler = partial(Quiet, directory=str(tmp_path))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        check(f"http://127.0.0.1:{server.server_port}/a/lab/{LINK}", PERIOD, tmp_path)
        server.shutdown()
