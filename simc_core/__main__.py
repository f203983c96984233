"""`python -m simc_core`, or `simc` where the package is installed: what can be done without a page."""

import argparse
import sys
from collections.abc import Sequence

from simc_core.many import command


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : sequence of str, optional
        None: those of the process.

    Returns
    -------
    int
        0 where all went well.
    """
    parser = argparse.ArgumentParser(prog="simc", description="SIMC tuning of PI and PID controllers.")
    commands = parser.add_subparsers(required=True, metavar="command")
    command.add_to(commands)
    given = parser.parse_args(arguments)
    return given.run(given)


if __name__ == "__main__":
    sys.exit(main())
