"""The built page: the files that the package carries, and what each is."""

from __future__ import annotations

from pathlib import Path

from pendula._checks import MissingExtraError

STATIC = Path(__file__).with_name("static")
START = "index.html"  # of the page in several files
ONE_FILE = "lab.html"  # the same page in one
MIME_TYPES = {  # the system's own table may lack WebAssembly, or be wrong
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".txt": "text/plain; charset=utf-8",
    ".wasm": "application/wasm",
    ".webmanifest": "application/manifest+json",
    ".woff2": "font/woff2",
}


def policy(own: str, *more: str) -> str:
    """The content security policy of the page, which lets it load from nowhere else.

    Args:
        own: where its scripts and styles come from: 'self', or the hashes of those within it.
        *more: other directives.
    """
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {own} 'wasm-unsafe-eval'",  # WebAssembly is compiled, no text is run
            f"style-src {own}",
            "img-src 'self' data: blob:",
            "media-src blob:",  # a video that was recorded
            "connect-src 'self'",
            "worker-src 'self' blob:",  # in one file the workers' script is within it, too
            "base-uri 'none'",
            "form-action 'none'",
            *more,
        )
    )


def page_files() -> dict[str, Path]:
    """The files of the page by their paths with /, without the page in one file.

    Raises:
        MissingExtraError: where the page was not built.
    """
    if not (STATIC / START).is_file():
        raise _not_built()
    found = (path for path in sorted(STATIC.rglob("*")) if path.suffix in MIME_TYPES)
    files = {path.relative_to(STATIC).as_posix(): path for path in found if path.is_file()}
    files.pop(ONE_FILE, None)
    return files


def one_file() -> Path:
    """The page in one file.

    Raises:
        MissingExtraError: where it was not built.
    """
    path = STATIC / ONE_FILE
    if not path.is_file():
        raise _not_built()
    return path


def _not_built() -> MissingExtraError:
    way_out = "in a clone of pendula run: make lab (and pip install . to take it along)"
    return MissingExtraError(f"the page of the laboratory was not built; {way_out}")
