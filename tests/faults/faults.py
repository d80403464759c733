"""See tests/faults/run."""
import argparse
import os
import shutil
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support/stress")]

import crash_points  # noqa: E402
import disk  # noqa: E402
import kills  # noqa: E402
import limits  # noqa: E402
import service  # noqa: E402
import store  # noqa: E402
from verdict import Verdict  # noqa: E402

CASES = {"kills": kills.run, "crash_points": crash_points.run, "disk": disk.run, "store": store.run,
         "limits": limits.run}


def main() -> int:
    parser = argparse.ArgumentParser(description="Breaks the released service; see the head of tests/faults/run.")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(CASES))
    parser.add_argument("--quick", action="store_true", help="a part of each")
    parser.add_argument("--seed", type=int, default=int(time.time()) % 100000)
    options = parser.parse_args()
    unknown = [name for name in options.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {unknown[0]}; cases are {', '.join(CASES)}")
    if not os.path.exists(service.PROGRAM):
        parser.error(f"there is no {service.PROGRAM}; tests/run makes it")
    print(f"seed {options.seed}", flush=True)
    verdict = Verdict()
    for name in options.cases or CASES:
        print(f"==> {name}", flush=True)
        folder = tempfile.mkdtemp(prefix=f"farhorizon-{name}-")
        CASES[name](folder, verdict, options)
        shutil.rmtree(folder, ignore_errors=True)
    return verdict.exit_status("tests/faults/run")


if __name__ == "__main__":
    sys.exit(main())
