"""`pendula lab` and `pendula rerun`: files and links, the page opened or exported."""

from __future__ import annotations

import re
import shlex
import webbrowser
from pathlib import Path

import pytest

import pendula
from commands import Call, interrupted
from lab_pages import write_page
from pendula.lab import page, read_link
from pendula.lab.address import entries_of
from pendula.lab.server import LabServer

LINK = "#system=simple&length=0.5&state=3,0.1&t_max=2&method=rk4&step=0.01"


@pytest.fixture
def small_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "static"
    write_page(folder)
    monkeypatch.setattr(page, "STATIC", folder)


@pytest.fixture
def not_built(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "STATIC", Path("nowhere"))


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is opened in a browser; the server ends at once."""
    urls: list[str] = []
    monkeypatch.setattr(webbrowser, "open", urls.append)
    monkeypatch.setattr(LabServer, "serve_forever", lambda self: None)
    monkeypatch.setenv("DISPLAY", ":0")
    return urls


# ---- rerun ----


def test_a_link_is_run_again_into_a_file(call: Call, tmp_path: Path) -> None:
    """Lab to link to file: the bits of the run in Python."""
    code, out, err = call(f"rerun 'http://127.0.0.1:8642/{LINK}' -o run.csv")
    assert (code, err) == (0, "")
    assert out.startswith("run.csv: 201 times; rk4, step 0.01 s: 200 steps")
    run = pendula.load(tmp_path / "run.csv")
    system = pendula.SimplePendulum(length=0.5)
    wanted = pendula.solve(system, (3.0, 0.1), 2.0, "rk4", step=0.01)
    assert run.states.tobytes() == wanted.states.tobytes()
    assert call("rerun run.csv -o again.csv")[0] == 0
    assert (tmp_path / "again.csv").read_bytes() == (tmp_path / "run.csv").read_bytes()


def test_a_run_that_is_repeated_is_shown(call: Call) -> None:
    code, out, _ = call(f"rerun '{LINK}'")
    assert code == 0
    assert "theta [rad]" in out


def test_the_run_of_a_link_is_shown_as_that_of_a_file(call: Call) -> None:
    assert call(f"rerun '{LINK}' -o run.csv")[0] == 0
    _, of_the_file, _ = call("show run.csv")
    code, of_the_link, err = call(f"show 'http://127.0.0.1:8642/{LINK}'")
    assert (code, err) == (0, "")
    assert of_the_link.startswith("link to a run of SimplePendulum(length=0.5")
    assert of_the_link.splitlines()[1:] == of_the_file.splitlines()[1:]
    assert call(f"show '{LINK}&lenght=1'")[0] == 2


@pytest.mark.parametrize(
    ("line", "code", "says"),
    [
        (f"rerun '{LINK}&lenght=1'", 2, "the link: the simple pendulum's link has no key 'lenght'"),
        (
            f"rerun '{LINK.replace('0.01', '5')}'",
            2,
            "the link: step must not exceed the span of 2.0 s",
        ),
        ("rerun http://127.0.0.1:8642/", 2, "the link: no recipe follows a #"),
        (f"rerun '{LINK}&max_steps=5'", 1, "rk4 stopped at t = 0.05 s of 2 s with step 0.01 s"),
        (f"rerun '{LINK}' -o run.txt", 2, "the file name must end in"),
        ("rerun nothing.csv", 2, "no such file: nothing.csv"),
        ("rerun", 2, "Missing argument"),
    ],
)
def test_what_cannot_be_run_again_is_told_in_a_line(
    line: str, code: int, says: str, call: Call
) -> None:
    ended, out, err = call(line)
    assert (ended, out) == (code, "")
    assert says in err
    assert err.startswith("pendula: ")
    assert err.count("\n") == 1


# ---- lab ----


@pytest.mark.usefixtures("small_page")
def test_the_page_is_opened(call: Call, opened: list[str]) -> None:
    code, out, err = call("lab --port 0")
    assert code == 0
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\n", out)
    assert opened == [out.strip()]
    assert err == "Ctrl-C ends the laboratory\n"


@pytest.mark.usefixtures("small_page")
def test_a_link_is_opened_on_this_machine(call: Call, opened: list[str]) -> None:
    code, out, _ = call(f"lab 'https://example.org/lab.html{LINK}&lang=es'")
    assert code == 0
    assert opened == [out.strip()]
    assert opened[0].startswith("http://127.0.0.1:")
    assert opened[0].endswith(f"/{LINK}&lang=es")


@pytest.mark.usefixtures("small_page")
def test_a_file_is_opened_as_its_recipe(call: Call, opened: list[str]) -> None:
    assert call("solve double --method rk4 --step 10ms --t-max 2s -o run.csv")[0] == 0
    code, _, err = call("lab run.csv --port 0")
    assert (code, err) == (0, "Ctrl-C ends the laboratory\n")
    again = read_link(opened[0]).run()
    assert again.states.tobytes() == pendula.load("run.csv").states.tobytes()


@pytest.mark.usefixtures("small_page")
def test_what_the_page_does_not_show_of_a_file_is_told(call: Call, opened: list[str]) -> None:
    assert call("solve double --t-max 2s --event 'flip 1' -o run.csv")[0] == 0
    _, _, err = call("lab run.csv --port 0")
    assert err.splitlines()[0] == "run.csv: shown without its events"
    assert "method=taylor" in opened[0]


@pytest.mark.usefixtures("small_page")
def test_a_file_of_more_than_doubles_is_not_shown(call: Call, opened: list[str]) -> None:
    assert call("solve simple --digits 12 --t-max 2s -o run.csv")[0] == 0
    code, _, err = call("lab run.csv")
    assert (code, opened) == (2, [])
    assert err == (
        "pendula: digits = 12 is not kept by the page, which computes in doubles; "
        "use pendula rerun 'run.csv'\n"
    )


RECTANGLE = "--theta1=-3rad:2rad --theta2 0rad:3rad --size 4x4 --t-max 4s"


@pytest.mark.usefixtures("small_page")
@pytest.mark.parametrize(
    ("line", "keys", "lost"),
    [
        ("flip double --bobs --m1 2kg", {"map_quantity": "flip_time"}, ""),
        ("flip double --which 2 --tolerance 1e-6", {"map_quantity": "flip_time"}, "rod, tolerance"),
        ("megno double", {"map_quantity": "megno"}, "tolerance"),
    ],
)
def test_a_map_is_opened_as_what_it_maps(
    line: str, keys: dict[str, str], lost: str, call: Call, opened: list[str]
) -> None:
    assert call(f"map {line} {RECTANGLE} -o map.zarr")[0] == 0
    code, _, err = call("lab map.zarr --port 0")
    assert code == 0
    told = f"map.zarr: shown without its {lost.replace(', ', ' and ')}\n" if lost else ""
    assert err == f"{told}Ctrl-C ends the laboratory\n"
    entries = entries_of(opened[0])
    wanted = {"view": "map", "map_theta1": "-3,2", "map_theta2": "0,3", "map_t_max": "4", **keys}
    assert {key: entries[key] for key in wanted} == wanted
    recipe = read_link(opened[0])
    assert recipe.state == (-0.5, 1.5, 0.0, 0.0)
    if "--bobs" in line:
        assert recipe.system == pendula.DoublePendulum.bobs(m1=2.0)


@pytest.mark.usefixtures("small_page")
def test_a_map_of_another_kind_is_not_shown(call: Call, opened: list[str]) -> None:
    assert call(f"map sali double {RECTANGLE} -o map.zarr")[0] == 0
    code, _, err = call("lab map.zarr")
    assert (code, opened) == (2, [])
    assert err == (
        "pendula: map.zarr must hold a map of flips or of MEGNO to be shown in the laboratory, "
        "got one of 'sali'; use pendula show\n"
    )


@pytest.mark.usefixtures("small_page")
@pytest.mark.parametrize("name", ["swing.csv", "swing.txt", "swing.xlsx", "swing 1.mat"])
def test_a_table_of_measured_motion_is_told_where_to_go(
    name: str, call: Call, opened: list[str], tmp_path: Path
) -> None:
    (tmp_path / name).write_text("t,theta\n0,0.5\n0.1,0.4\n")
    code, _, err = call(f"lab '{name}'")
    assert (code, opened) == (2, [])
    assert err == (
        f"pendula: {name} was not written by pendula; open pendula lab "
        f"'#system=simple&t_max=10&view=data' and drop a text table of measured motion there, "
        f"or use pendula fit {shlex.quote(name)}\n"
    )


@pytest.mark.usefixtures("small_page")
@pytest.mark.parametrize("option", ["--no-browser", ""])
def test_no_browser_is_opened_where_none_is_wanted_or_has_a_window(
    option: str, call: Call, opened: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    if not option:
        monkeypatch.delenv("DISPLAY")
        monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
        monkeypatch.setattr("sys.platform", "linux")
    assert call(f"lab --port 0 {option}")[0] == 0
    assert opened == []


@pytest.mark.usefixtures("small_page")
@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("lab '#system=simple&t_max=1&method=rk5'", "did you mean 'rk4'?"),
        ("lab '#system=simple&t_max=1&lang=fr'", "the link: lang must be one of en, es"),
        (
            "lab '#system=simple&t_max=1&digits=12'",
            "digits = 12 is not kept by the page, which computes in doubles; use pendula rerun",
        ),
        ("lab nothing.csv", "no such file: nothing.csv"),
        ("lab run.txt", "the file name must end in"),
        ("lab --port 70000", "--port must be a whole number from 1 to 65535"),
        ("lab --port 8000 --export lab.html", "--port goes with a server"),
    ],
)
def test_what_cannot_be_shown_is_told_in_a_line(
    line: str, says: str, call: Call, opened: list[str]
) -> None:
    code, out, err = call(line)
    assert (code, out, opened) == (2, "", [])
    assert says in err
    assert err.count("\n") == 1


@pytest.mark.usefixtures("small_page")
def test_a_file_of_another_kind_is_not_shown(call: Call, opened: list[str]) -> None:
    line = "solve simple --t-max 1s --event 'velocity-zero 1' --events-file events.json"
    assert call(line)[0] == 0
    code, _, err = call("lab events.json")
    assert (code, opened) == (2, [])
    assert err == (
        "pendula: events.json must hold a trajectory or a map to be shown in the laboratory, "
        "got a file of the kind 'events'; use pendula show\n"
    )


def test_a_port_that_is_taken_is_told(call: Call, small_page: None, opened: list[str]) -> None:
    with LabServer(0) as server:
        code, _, err = call(f"lab --port {server.server_port}")
    assert code == 1
    assert err.startswith(f"pendula: --port = {server.server_port} cannot be had: ")
    assert err.endswith("; take another, or leave it out\n")


@pytest.mark.usefixtures("not_built")
@pytest.mark.parametrize("line", ["lab", "lab --export lab.html", "lab --export site"])
def test_without_a_built_page_one_line_says_what_to_do(line: str, call: Call) -> None:
    code, out, err = call(line)
    assert (code, out) == (1, "")
    assert err.startswith("pendula: the page of the laboratory was not built; in a clone")
    assert "make lab" in err
    assert err.count("\n") == 1


def test_ctrl_c_ends_the_server(tmp_path: Path) -> None:
    write_page(tmp_path / "static")
    code = (
        "import sys; from pathlib import Path; from pendula.lab import page\n"
        "page.STATIC = Path('static'); from pendula.cli import main\n"
        "print('ready', flush=True); sys.exit(main(sys.argv[1:]))"
    )
    ended, out, err = interrupted(tmp_path, "lab --no-browser --port 0", 1.5, code)
    assert ended == 130
    assert out.startswith("http://127.0.0.1:")
    assert err == "Ctrl-C ends the laboratory\npendula: interrupted\n"
