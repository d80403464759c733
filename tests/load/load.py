"""See tests/load/run."""
import argparse
import os
import shutil
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../support/stress")]

import bodies  # noqa: E402
import overload  # noqa: E402
import poll  # noqa: E402
import service  # noqa: E402
import slow  # noqa: E402
import soak  # noqa: E402
import submit  # noqa: E402
import tiles  # noqa: E402
from verdict import Verdict  # noqa: E402

LOADS = {"poll": poll.run, "submit": submit.run, "overload": overload.run, "slow": slow.run, "bodies": bodies.run,
         "tiles": tiles.run, "soak": soak.run}


def main() -> int:
    parser = argparse.ArgumentParser(description="Loads the released service; see the head of tests/load/run.")
    parser.add_argument("loads", nargs="*", metavar="LOAD", help=", ".join(LOADS))
    parser.add_argument("--quick", action="store_true", help="a few seconds of each")
    parser.add_argument("--seconds", type=int, help="of each")
    options = parser.parse_args()
    unknown = [name for name in options.loads if name not in LOADS]
    if unknown:
        parser.error(f"no load {unknown[0]}; loads are {', '.join(LOADS)}")
    if not os.path.exists(service.PROGRAM):
        parser.error(f"there is no {service.PROGRAM}; tests/run makes it")
    verdict = Verdict()
    for name in options.loads or LOADS:
        print(f"==> {name}", flush=True)
        folder = tempfile.mkdtemp(prefix=f"farhorizon-{name}-")
        LOADS[name](folder, verdict, options)
        shutil.rmtree(folder, ignore_errors=True)
    return verdict.exit_status("tests/load/run")


if __name__ == "__main__":
    sys.exit(main())
