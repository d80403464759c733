"""A mixed day: 70 % statuses, 10 % DEMs, 15 % results, 5 % lists; what may not grow, does not."""
import os
import random
import threading
import time

from open_loop import OpenLoop
from service import Service, small_dem
from verdict import Verdict


class Gauge(threading.Thread):
    """Looks at the service every few seconds."""

    def __init__(self, service: Service, interval: float):
        super().__init__(daemon=True)
        self.service, self.interval, self.over = service, interval, threading.Event()
        self.rows: list[tuple[float, int, int, int, int]] = []

    def run(self) -> None:
        begun = time.monotonic()
        while not self.over.wait(self.interval):
            wal = os.path.join(self.service.data, "jobs.sqlite-wal")
            self.rows.append((time.monotonic() - begun, self.service.figure("VmRSS"), self.service.descriptors(),
                              self.service.figure("Threads"), os.path.getsize(wal) if os.path.exists(wal) else 0))

    def growth(self, column: int) -> tuple[float, float]:
        """The means of the second and of the last quarter: the first one warms up."""
        quarter = max(1, len(self.rows) // 4)
        mean = lambda rows: sum(row[column] for row in rows) / len(rows)  # noqa: E731
        return mean(self.rows[quarter:2 * quarter] or self.rows), mean(self.rows[-quarter:])


def run(folder: str, verdict: Verdict, options) -> None:
    seconds = options.seconds or (20 if options.quick else 600)
    rng = random.Random(1)
    jobs: list[str] = []
    # So few are kept that the store comes to rest within the run.
    with Service(folder, config={"jobs": {"keepJobs": 50}}) as service:
        jobs.append(service.submit(small_dem(0))[1]["jobID"])
        service.wait(jobs[0])

        def deed(number: int) -> int:
            kind = rng.random()
            job = jobs[rng.randrange(max(0, len(jobs) - 20), len(jobs))]
            if kind < .7:
                return service.request("GET", f"/jobs/{job}")[0]
            if kind < .8:
                status, document = service.submit(small_dem(number % 11))
                if status == 201:
                    jobs.append(document["jobID"])
                return status
            if kind < .95:
                return service.request("GET", f"/jobs/{job}/results/report.json")[0]
            return service.request("GET", "/jobs?limit=20")[0]
        gauge = Gauge(service, max(.5, seconds / 100))
        gauge.start()
        loop = OpenLoop(deed, 10, seconds).run()
        gauge.over.set()
        gauge.join()
        verdict.ask("a mixed day: no failure", not loop.failed(), loop)
        quarters = len(loop.latencies) // 4
        verdict.say("latency by quarters, p99", ms=[round(sorted(loop.latencies[i * quarters:(i + 1) * quarters])
                                                          [int(.99 * quarters)] * 1000) for i in range(4)])
        for column, what, most in ((1, "memory, KiB", 4096), (2, "descriptors", 8), (3, "threads", 2),
                                   (4, "log of the database, bytes", 1 << 22)):
            first, last = gauge.growth(column)
            verdict.ask(f"{what}: does not grow", last - first < most, f"{first:.0f} to {last:.0f}")
