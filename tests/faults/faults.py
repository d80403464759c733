"""See tests/faults/run."""
import argparse
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support/stress")]

import command  # noqa: E402
import crash_points  # noqa: E402
import disk  # noqa: E402
import kills  # noqa: E402
import limits  # noqa: E402
import machines  # noqa: E402
import opens  # noqa: E402
import power  # noqa: E402
import store  # noqa: E402

CASES = {"kills": kills.run, "crash_points": crash_points.run, "disk": disk.run, "power": power.run,
         "store": store.run, "limits": limits.run, "opens": opens.run,
         "machines": machines.run}


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seed", type=int, default=int(time.time()) % 100000, help="what a failure names")
    parser.add_argument("--folder", action="store_true", help="machines: objects in a folder, not in a bucket")


if __name__ == "__main__":
    sys.exit(command.run("tests/faults/run", CASES, add_options))
