"""The command line that tests/faults and tests/load share."""
import argparse
import os
import shutil
import tempfile
from typing import Callable

import service
from verdict import Verdict


def run(command: str, cases: dict[str, Callable], options: Callable[[argparse.ArgumentParser], None]) -> int:
    """Runs the cases that the command line names, or all, each in a folder of its own that is gone afterwards; the
    exit status. options: adds those of the command to --quick."""
    parser = argparse.ArgumentParser(prog=command, description=f"The head of {command} says what each case does.")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(cases))
    parser.add_argument("--quick", action="store_true", help="a part of each")
    options(parser)
    asked = parser.parse_args()
    unknown = [name for name in asked.cases if name not in cases]
    if unknown:
        parser.error(f"no case {unknown[0]}; cases are {', '.join(cases)}")
    if not os.path.exists(service.PROGRAM):
        parser.error(f"there is no {service.PROGRAM}; make it: cmake --workflow --preset release")
    print(", ".join(f"{name} {value}" for name, value in vars(asked).items() if name != "cases"), flush=True)
    verdict = Verdict()
    for name in asked.cases or cases:
        print(f"==> {name}", flush=True)
        folder = tempfile.mkdtemp(prefix=f"farhorizon-{name}-")
        cases[name](folder, verdict, asked)
        shutil.rmtree(folder, ignore_errors=True)
    return verdict.exit_status(command)
