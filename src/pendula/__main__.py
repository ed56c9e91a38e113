"""`python -m pendula` is the command `pendula`."""

import sys

from pendula.cli import main

if __name__ == "__main__":
    sys.exit(main())
