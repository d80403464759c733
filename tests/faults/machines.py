"""Several services and a worker on one database and one bucket, or one folder: processes, the database and the server
of the bucket are killed and frozen under mixed load, the latter fails now and then, and all are restarted."""
import os
import random
import signal
import time

import bucket
import database
from history import History, Reference
from kills import Client
from service import Service

LEASE_SECONDS = 3


class Fleet:
    """Services of one store: each request goes to any of them."""

    def __init__(self, services: list[Service]):
        self.services = services
        self.random = random.Random(1)

    def request(self, *arguments, **named):
        return self.random.choice(self.services).request(*arguments, **named)

    def json(self, path: str) -> dict:
        return self.random.choice(self.services).json(path)

    def submit(self, *arguments, **named):
        return self.random.choice(self.services).submit(*arguments, **named)

    def wait(self, job: str, seconds: float = 120) -> dict:
        return self.random.choice(self.services).wait(job, seconds)


def start(process: Service, seconds: float = 60) -> None:
    """A service that finds no database does not start: whoever runs it starts it again."""
    end = time.monotonic() + seconds
    while True:
        try:
            process.start()
            return
        except RuntimeError:
            if time.monotonic() > end:
                raise
            time.sleep(.2)


def break_bucket(rng: random.Random, objects: bucket.Bucket) -> str:
    """One fault of the bucket's server, from its beginning to its end."""
    chance = rng.random()
    if chance < .25:
        objects.kill()
        time.sleep(rng.uniform(0, 4))
        objects.start()
        return "bucket stopped"
    if chance < .4:
        objects.freeze()
        time.sleep(rng.uniform(1, 12))
        objects.thaw()
        return "bucket frozen"
    objects.fail({**rng.choice(bucket.FAULTS), "share": rng.choice((.1, .5, 1))})
    time.sleep(rng.uniform(1, 4))
    objects.fail({})
    return "bucket failing"


def break_something(rng: random.Random, processes: list[Service], server: database.Database,
                    objects: bucket.Bucket | None) -> str:
    """One fault, from its beginning to its end."""
    if objects and rng.random() < .3:
        return break_bucket(rng, objects)
    chance = rng.random()
    victim = rng.choice(processes)
    if chance < .7:
        victim.kill()
        start(victim)
        return "killed"
    if chance < .8:
        os.kill(victim.pid(), signal.SIGSTOP)
        time.sleep(rng.uniform(1, 2.5) * LEASE_SECONDS)
        os.kill(victim.pid(), signal.SIGCONT)
        return "frozen"
    if chance < .9:
        server.stop(rng.choice(("immediate", "fast")))
        time.sleep(rng.uniform(0, 3))
        server.start()
        return "database stopped"
    if chance < .95:
        server.freeze()
        time.sleep(rng.uniform(1, 9))
        server.thaw()
        return "database frozen"
    begun = time.monotonic()
    victim.stop()
    start(victim)
    return "restarted" if time.monotonic() - begun < 25 else "restarted late"


def check_objects(history: History, server: database.Database, there: set[str]) -> str:
    """I7, once nothing is under way: rows without their object, and objects without a row."""
    named = {row[0] for row in server.query(
        "SELECT input_sha256 FROM farhorizon.jobs UNION SELECT sha256 FROM farhorizon.artifacts UNION "
        "SELECT gzip_sha256 FROM farhorizon.artifacts WHERE gzip_sha256 IS NOT NULL UNION "
        "SELECT zstd_sha256 FROM farhorizon.artifacts WHERE zstd_sha256 IS NOT NULL UNION "
        "SELECT sha256 FROM farhorizon.upload_parts UNION "
        "SELECT sha256 FROM farhorizon.uploads WHERE sha256 IS NOT NULL")}
    if named - there or there - named:
        history.violated(f"I7: {len(there - named)} orphans, {len(named - there)} dangling rows")
    return f"{len(there)} objects"


def run(folder: str, verdict, options) -> None:
    if not database.is_installed():
        verdict.say("machines: left out, for postgresql-15 is not installed")
        return
    count = 20 if options.quick else 500
    rng = random.Random(options.seed)
    history = History()
    references = [Reference(folder, seed) for seed in range(3)]
    server = database.Database()
    place = os.path.join(folder, "objects")
    objects = None if options.folder else bucket.Bucket(place)
    config = {"store": {"jobs": server.url, "objects": objects.url if objects else place,
                        "leaseSeconds": LEASE_SECONDS}}
    environment = objects.environment if objects else {}
    processes = [Service(os.path.join(folder, name), 1, config, environment=environment, role=role)
                 for name, role in (("ada", "serve"), ("bob", "serve"), ("eve", "serve"), ("worker", "work"))]
    for process in processes:
        start(process)
    fleet = Fleet(processes[:3])
    clients = [Client(fleet, history, references, options.seed * 100 + i) for i in range(4)]
    for client in clients:
        client.start()
    faults: dict[str, int] = {}
    for number in range(count):
        time.sleep(rng.uniform(.1, 1.5))
        fault = break_something(rng, processes, server, objects)
        faults[fault] = faults.get(fault, 0) + 1
        if (number + 1) % 50 == 0:
            verdict.say(f"{number + 1} faults", jobs=len(history.jobs), violations=len(history.violations))
    for process in processes:  # as an upgrade goes
        process.stop()
        start(process)
    for client in clients:
        client.over.set()
    for client in clients:
        client.join()
    ends = history.check_end(fleet, 600)
    for process in processes:
        process.stop()
    start(processes[0])  # it removes what belongs to no job
    time.sleep(2)
    processes[0].stop()
    there = objects.names() if objects else {name for _, _, files in os.walk(place) for name in files
                                             if len(name) == 64}
    if objects:
        if objects.names("incoming"):
            history.violated(f"I7: {len(objects.names('incoming'))} objects are still incoming")
        verdict.say("bucket", **objects.requests())
        objects.kill()
    verdict.say("faults", **faults)
    verdict.say("answers", **{str(answer): n for answer, n in history.answers.items()})
    verdict.say("store", objects=check_objects(history, server, there))
    server.remove()
    verdict.ask(f"{count} faults, {len(history.jobs)} jobs on three services and a worker: I1 to I8 "
                f"(seed {options.seed})", not history.violations, history.violations[:3] or ends)

