"""Three processes of 64 workers that only sleep, and two that take jobs, on one PostgreSQL server: what the store can
dispatch."""
import os
import threading
import time

import database
from service import PROGRAM, Service, small_dem
from verdict import Verdict, percentile

DOORS = ("ada", "bob")
WORKERS = {"one": 22, "two": 21, "three": 21}
SECONDS = 2  # that a job takes of the stand-in
STAND_IN = os.path.join(os.path.dirname(PROGRAM), "tests/stand_in_worker")
# Two clients: one sends three quarters of all jobs.
SOURCES = ("127.0.0.1", "127.0.0.1", "127.0.0.1", "127.0.0.2")
TICK = os.sysconf("SC_CLK_TCK")


def processor_seconds(server: database.Database) -> float:
    """Of the server and its processes, those that have ended too."""
    total = 0
    first, *others = server.processes()
    for process in (first, *others):
        try:
            with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            # utime and stime; of the first, those of its ended children too.
            total += sum(map(int, fields[11:15] if process == first else fields[11:13]))
        except OSError:
            pass
    return total / TICK


def send(services: list[Service], count: int, seconds: float, verdict: Verdict) -> list[str]:
    """Sends `count` jobs evenly within `seconds`, as far as answers come in time; their ids."""
    dem = small_dem(1)
    query = "?crs=EPSG:4326&levels=1&filename=slow.asc"
    lock = threading.Lock()
    jobs: list[str] = []
    others: list[object] = []
    begun = time.monotonic()
    numbers = iter(range(count))

    def client() -> None:
        while True:
            with lock:
                number = next(numbers, None)
            if number is None:
                return
            time.sleep(max(0, begun + seconds * number / count - time.monotonic()))
            status, document = services[number % len(services)].submit(dem, query, None, 60,
                                                                       SOURCES[number % len(SOURCES)])
            with lock:
                if status == 201:
                    jobs.append(document["jobID"])
                else:
                    others.append((status, document))

    threads = [threading.Thread(target=client) for _ in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    verdict.say("sent", jobs=len(jobs), a_second=round(len(jobs) / (time.monotonic() - begun), 1))
    verdict.ask("every POST is answered 201", not others, others[:2])
    return jobs


def wait(server: database.Database, seconds: float) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if server.query("SELECT count(*) FROM farhorizon.jobs WHERE state IN ('accepted', 'running')") == [["0"]]:
            return
        time.sleep(1)


def starts(server: database.Database, jobs: list[str]) -> list[float]:
    """Seconds from POST to start."""
    asked = set(jobs)
    return [int(wait) / 1000 for job, wait in server.query("SELECT id, started_ms - created_ms FROM farhorizon.jobs "
                                                           "WHERE started_ms IS NOT NULL") if job in asked]


def run(folder: str, verdict: Verdict, options) -> None:
    if not database.is_installed() or not os.path.exists(STAND_IN):
        verdict.say(f"machines: left out, for postgresql-15 or {STAND_IN} is not there")
        return
    workers = sum(WORKERS.values())
    steady, backlog = (300, 300) if options.quick else (2000, 10_000)
    server = database.Database()
    config = {"store": {"jobs": server.url, "objects": os.path.join(folder, "objects")},
              "worker": {"program": STAND_IN}, "jobs": {"maxWaiting": 20_000, "memoryBytes": 1 << 50}}
    services = [Service(os.path.join(folder, name), 0, config) for name in DOORS]
    processes = [Service(os.path.join(folder, name), count, config, role="work") for name, count in WORKERS.items()]
    for process in services + processes:
        process.start()
    most = workers / SECONDS

    jobs = send(services, steady, steady / (most / 2), verdict)
    wait(server, 120)
    waits = starts(server, jobs)
    verdict.say(f"half of what {workers} workers can do", starts=len(waits), p50_s=round(percentile(waits, .5), 3),
                p99_s=round(percentile(waits, .99), 3), most_s=round(max(waits), 3))

    for process in processes:
        process.stop()
    jobs = send(services, backlog, 0, verdict)
    spent = processor_seconds(server)
    begun = time.monotonic()
    for process in processes:
        process.start()
    wait(server, 10 * backlog / most + 60)
    took = time.monotonic() - begun
    spent = processor_seconds(server) - spent
    ends = server.query("SELECT state, count(*) FROM farhorizon.jobs GROUP BY state")
    verdict.ask(f"{steady + backlog} jobs, each successful", ends == [["successful", str(steady + backlog)]], ends)
    verdict.say("a backlog", jobs=len(jobs), a_second=round(len(jobs) / took, 1), at_most=most,
                database_ms_a_job=round(1000 * spent / len(jobs), 1), database_of_a_core=round(spent / took, 2))
    quarter = backlog // 4
    shares = {client: int(count) for client, count in server.query(
        f"SELECT client, count(*) FROM (SELECT client FROM farhorizon.jobs WHERE id >= '{min(jobs)}' "
        f"ORDER BY started_ms LIMIT {quarter}) AS first GROUP BY client")}
    verdict.ask("of the first quarter each client has about a half, though one sent three quarters of all",
                min(shares.values()) > .45 * quarter and len(shares) == 2, shares)
    for process in services + processes:
        process.stop()
    server.remove()
