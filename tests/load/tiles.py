"""Tiles a minute by the service, against as many loops of `farhorizon build` as it has workers."""
import os
import subprocess
import threading
import time

from service import PROGRAM, QUERY, Service, small_dem
from verdict import Verdict


def run(folder: str, verdict: Verdict, options) -> None:
    each = 1 if options.quick else 4
    dems = [small_dem(seed, 130, 110) for seed in range(2 * each)]
    query = QUERY.replace("levels=1", "levels=5")

    def loop(number: int) -> None:
        for i in range(number, len(dems), 2):
            path = os.path.join(folder, f"{i}.asc")
            with open(path, "wb") as file:
                file.write(dems[i])
            subprocess.run([PROGRAM, "build", path, "-o", os.path.join(folder, f"out-{i}"), "--crs", "EPSG:4326",
                            "--threads", "1"], check=True, stderr=subprocess.DEVNULL)

    def by_service() -> float:
        with Service(os.path.join(folder, "service"), workers=2) as service:
            begun = time.monotonic()
            jobs = [service.submit(dem, query)[1]["jobID"] for dem in dems]
            ends = [service.wait(job, 600)["status"] for job in jobs]
            verdict.ask("every tile is done", set(ends) == {"successful"}, ends)
            return time.monotonic() - begun

    begun = time.monotonic()
    threads = [threading.Thread(target=loop, args=(number,)) for number in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    loops = time.monotonic() - begun
    service = by_service()
    verdict.ask("tiles a minute within 10 % of two loops of build", service < 1.1 * loops,
                f"{60 * len(dems) / service:.1f} and {60 * len(dems) / loops:.1f}")
