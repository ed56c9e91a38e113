"""The page as a file or a folder of its own, which need no pendula."""

from __future__ import annotations

import base64
import hashlib
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from pendula._messages import Message
from pendula._writing import replacing
from pendula.lab.page import START, one_file, page_files, policy

if TYPE_CHECKING:
    from os import PathLike

FILE_ENDINGS = (".html", ".htm")
_INLINE = re.compile(r"<(script|style)(?: type=\"module\")?>(.*?)</\1>", re.DOTALL)


def export(path: str | PathLike[str], *, overwrite: bool = False) -> Path:
    """Write the page: to one file where the name ends in .html, to a folder otherwise.

    The file works from a disk, and in a sandboxed frame; the folder on any server, at any path.

    Returns:
        The file to open in a browser.

    Raises:
        MissingExtraError: where the page was not built.
        FileExistsError: where the path exists and `overwrite` is not set, or is a folder that holds
            anything else than an export.
        OSError: where it cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() in FILE_ENDINGS:
        source = one_file()
        with replacing(target, overwrite=overwrite) as unfinished:
            unfinished.write_text(_kept_in(source, alone=True), encoding="utf-8", newline="")
        return target
    files = page_files()
    _check_folder(target, files)
    with replacing(target, overwrite=overwrite) as unfinished:
        for name, source in files.items():
            copy = unfinished / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, copy)
        kept = _kept_in(files[START], alone=False)
        (unfinished / START).write_text(kept, encoding="utf-8", newline="")
    return target / START


def _kept_in(page: Path, *, alone: bool) -> str:
    """The HTML with the policy that `pendula lab` sends beside it.

    Args:
        page: the file.
        alone: whether its scripts and styles are within it; then their hashes name them.
    """
    html = page.read_bytes().decode()
    inside = _INLINE.findall(html) if alone else []
    hashes = (base64.b64encode(hashlib.sha256(each.encode()).digest()) for _, each in inside)
    own = " ".join(f"'sha256-{each.decode()}'" for each in hashes) or "'self'"
    meta = f'<meta http-equiv="Content-Security-Policy" content="{policy(own)}" />'
    return html.replace("<head>", f"<head>\n    {meta}", 1)


def _check_folder(target: Path, files: dict[str, Path]) -> None:
    """Refuse a folder that `overwrite` would empty of what no export has put there."""
    if not target.is_dir():
        return
    own = {name.partition("/")[0] for name in files}
    other = sorted(each.name for each in target.iterdir() if each.name not in own)
    if other:
        rule = "{path} holds {value}, which is no part of the laboratory"
        way_out = "choose a folder that does not exist"
        raise FileExistsError(Message("", rule, way_out, path=target, value=other[0]))
