"""Files of at most 300 lines, functions of at most 40 besides their docstring."""

import ast
import subprocess
import sys
from pathlib import Path

LONGEST_FILE, LONGEST_FUNCTION = 300, 40
CODE = (".py", ".hpp", ".cpp", ".js", ".ts", ".typ", ".css")


def tracked() -> list[Path]:
    """Files under version control or about to be."""
    listing = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        capture_output=True,
        text=True,
        check=True,
    )
    paths = map(Path, listing.stdout.splitlines())
    return [path for path in paths if path.exists() and "reference" not in path.parts]


def too_long(path: Path) -> list[str]:
    """One line for a file that is too long and for each of its functions that is."""
    text = path.read_text(encoding="utf-8")
    lines = text.count("\n")
    found = [f"{path}: {lines} lines"] if lines > LONGEST_FILE else []
    if path.suffix == ".py":
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                docstring = (ast.get_docstring(node, clean=False) or "").count("\n")
                length = (node.end_lineno or node.lineno) - node.lineno + 1 - docstring
                if length > LONGEST_FUNCTION:
                    found.append(f"{path}:{node.lineno}: {node.name} has {length} lines")
    return found


def main() -> int:
    """Print what is too long; 1 where anything is."""
    found = [line for path in tracked() if path.suffix in CODE for line in too_long(path)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
