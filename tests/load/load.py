"""See tests/load/run."""
import argparse
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support/stress")]

import bodies  # noqa: E402
import command  # noqa: E402
import events  # noqa: E402
import machines  # noqa: E402
import nodes  # noqa: E402
import overload  # noqa: E402
import poll  # noqa: E402
import slow  # noqa: E402
import soak  # noqa: E402
import storage  # noqa: E402
import submit  # noqa: E402
import tiles  # noqa: E402
import upgrade  # noqa: E402

LOADS = {"poll": poll.run, "submit": submit.run, "overload": overload.run, "slow": slow.run, "bodies": bodies.run,
         "tiles": tiles.run, "events": events.run, "machines": machines.run, "nodes": nodes.run,
         "upgrade": upgrade.run, "storage": storage.run, "soak": soak.run}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seconds", type=int, help="of each")
    parser.add_argument("--older", metavar="PROGRAM", help="the farhorizon that upgrade begins with")


if __name__ == "__main__":
    sys.exit(command.run("tests/load/run", LOADS, add_options))
