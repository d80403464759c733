"""Three services on one PostgreSQL server: one after the other is killed while a backlog is worked off, then they are
restarted in turn under load, which clients that retry do not notice."""
import http.client
import json
import os
import threading
import time
import uuid

import database
from service import PROGRAM, TERMINAL, Service, small_dem
from verdict import Verdict

WORKERS = 2  # of each service: few, so that jobs come faster than they are done
SECONDS = 2  # that a job takes of the stand-in
LEASE_SECONDS = 3
STAND_IN = os.path.join(os.path.dirname(PROGRAM), "tests/stand_in_worker")
QUERY = "?crs=EPSG:4326&levels=1&filename=slow.asc"
GIVES_UP = 30  # seconds after which a client with retries has failed


class Client(threading.Thread):
    """Sends a job and asks for it until it has ended, again and again. Whatever may pass is tried again, elsewhere."""

    def __init__(self, services: list[Service], number: int, over: threading.Event):
        super().__init__()
        self.services, self.number, self.over = services, number, over
        self.dem = small_dem(number)
        self.done = self.requests = self.retries = 0
        self.longest = 0.0
        self.failures: list[str] = []
        self.manifests: dict[str, bytes] = {}  # of each job that has succeeded

    def ask(self, method: str, path: str, body: bytes | None = None, headers: dict | None = None) -> tuple[int, bytes]:
        begun = time.monotonic()
        self.requests += 1
        said = ""
        while time.monotonic() - begun < GIVES_UP:
            self.number += 1
            try:
                status, _, answer = self.services[self.number % len(self.services)].request(method, path, body,
                                                                                            headers, 10)
                if status not in (429, 502, 503, 504):
                    self.longest = max(self.longest, time.monotonic() - begun)
                    return status, answer
                said = str(status)
            except (OSError, http.client.HTTPException) as error:
                said = repr(error)
            self.retries += 1
            time.sleep(.1)
        self.failures.append(f"{method} {path}: {said}")
        return 0, b""

    def run(self) -> None:
        while not self.over.is_set():
            key = {"Idempotency-Key": f'"{uuid.uuid4()}"', "Content-Type": "application/octet-stream"}
            status, answer = self.ask("POST", "/jobs" + QUERY, self.dem, key)
            if status not in (200, 201):
                self.failures.append(f"POST: {status} {answer[:200]!r}")
                continue
            job = json.loads(answer)["jobID"]
            info: dict = {}
            end = time.monotonic() + 120
            while info.get("status") not in TERMINAL and time.monotonic() < end:
                time.sleep(.2)
                status, answer = self.ask("GET", f"/jobs/{job}")
                info = json.loads(answer) if status == 200 else {"status": "failed", "message": f"{status} {answer!r}"}
            status, self.manifests[job] = self.ask("GET", f"/jobs/{job}/results/manifest.json")
            if info["status"] != "successful" or status != 200:
                self.failures.append(f"{job}: {info['status']} {info.get('message')}, results {status}")
            self.done += 1


def fill(services: list[Service], server: database.Database, backlog: int) -> list[object]:
    """Sends jobs until so many wait; what was answered but 201."""
    dem = small_dem(0)
    refused: list[object] = []
    lock = threading.Lock()

    def more_is_needed() -> bool:
        with lock:  # the database is asked over one connection
            return waiting(server) < backlog and not refused

    def send(service: Service) -> None:
        while more_is_needed():
            status, document = service.submit(dem, QUERY)
            if status != 201:
                refused.append((status, document))

    threads = [threading.Thread(target=send, args=(service,)) for service in services]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return refused


def waiting(server: database.Database) -> int:
    return int(server.query("SELECT count(*) FROM farhorizon.jobs WHERE state = 'accepted'")[0][0])


def a_second(server: database.Database, seconds: float) -> float:
    """Jobs that end, each second, within the next ones."""
    count = "SELECT count(*) FROM farhorizon.jobs WHERE state = 'successful'"
    before, begun = int(server.query(count)[0][0]), time.monotonic()
    time.sleep(seconds)
    return (int(server.query(count)[0][0]) - before) / (time.monotonic() - begun)


def run(folder: str, verdict: Verdict, options) -> None:
    if not database.is_installed() or not os.path.exists(STAND_IN):
        verdict.say(f"nodes: left out, for postgresql-15 or {STAND_IN} is not there")
        return
    watched, rounds = (8, 1) if options.quick else (20, 3)
    server = database.Database()
    config = {"store": {"jobs": server.url, "objects": os.path.join(folder, "objects"), "leaseSeconds": LEASE_SECONDS},
              "worker": {"program": STAND_IN}, "jobs": {"maxWaiting": 20_000, "memoryBytes": 1 << 50}}
    services = [Service(os.path.join(folder, name), WORKERS, config) for name in ("ada", "bob", "eve")]
    for service in services:
        service.start()
    most = len(services) * WORKERS / SECONDS

    backlog = round(most * (3 * watched + 3 * 2 * LEASE_SECONDS))
    refused = fill(services, server, backlog)
    verdict.ask("every POST of the backlog is answered 201", not refused, refused[:2])
    rates = []
    for service in services:  # the last one stays
        time.sleep(2 * LEASE_SECONDS)
        rates.append(a_second(server, watched))
        if service != services[-1]:
            service.kill()
    verdict.say("jobs a second of three, two and one service", **{str(3 - i): round(rate, 1) for i, rate in
                                                                  enumerate(rates)}, at_most=most)
    verdict.ask("what is done goes by how many live", .5 < rates[1] / rates[0] < .85 and .2 < rates[2] / rates[0] < .5,
                rates)
    verdict.ask("the backlog lasted", waiting(server))
    for service in services[:2]:
        service.start()

    over = threading.Event()
    clients = [Client(services, number, over) for number in range(8)]
    for client in clients:
        client.start()
    slowest = 0.0
    for _ in range(rounds):
        for service in services:
            time.sleep(2)
            slowest = max(slowest, service.stop())
            service.start()
    over.set()
    for client in clients:
        client.join()
    failures = [failure for client in clients for failure in client.failures]
    verdict.say("restarted in turn", rounds=rounds, jobs=sum(client.done for client in clients),
                requests=sum(client.requests for client in clients),
                retries=sum(client.retries for client in clients), slowest_stop_s=round(slowest, 1),
                longest_request_s=round(max(client.longest for client in clients), 2))
    verdict.ask("no client that retries sees a failure", not failures, failures[:3])
    left = server.query("SELECT state, count(*) FROM farhorizon.jobs WHERE state NOT IN ('successful', 'accepted', "
                        "'running') GROUP BY state")
    verdict.ask("no job has failed", not left, left)
    for service in services:
        service.stop()
    server.remove()
