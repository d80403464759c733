"""kill -9 of the service at random moments while clients submit, poll, fetch and dismiss."""
import http.client
import json
import random
import threading
import time
import uuid

import uploads
from history import History, Reference
from service import QUERY, Service

BROKEN = (OSError, http.client.HTTPException)  # a killed service breaks off anywhere


class Client(threading.Thread):
    """Sends jobs, asks for them, and writes every answer down."""

    def __init__(self, service: Service, history: History, references: list[Reference], seed: int):
        super().__init__(daemon=True)
        self.service, self.history, self.references = service, history, references
        self.random = random.Random(seed)
        self.over = threading.Event()

    def run(self) -> None:
        while not self.over.is_set():
            try:
                if self.random.random() < .25:
                    self.submit()
                else:
                    self.look()
            except BROKEN as failure:
                self.history.count(type(failure).__name__)
            self.over.wait(self.random.expovariate(20))

    def submit(self) -> None:
        reference = self.random.choice(self.references)
        key = str(uuid.UUID(int=self.random.getrandbits(128))) if self.random.random() < .7 else None
        path = None
        if self.random.random() < .3:
            path = uploads.upload(self.service, self.history, self.random, reference.dem)
            if path is None:
                return
        for _ in range(100):
            try:
                if path:
                    status, document = uploads.submit(self.service, path, key)
                else:
                    status, document = self.service.submit(reference.dem, QUERY, key, 15)
            except BROKEN:
                if key is None:
                    raise
                time.sleep(.05)  # with a key one asks again
                continue
            self.history.count(status)
            if status == 201:
                self.history.acknowledged(document["jobID"], reference, key)
                if key and self.random.random() < .2:
                    continue
                return
            if status not in (429, 503, 507):
                self.history.violated(f"a POST was answered {status}: {document}")
                return
            time.sleep(.05)

    def look(self) -> None:
        with self.history.lock:
            jobs = list(self.history.jobs)
        if not jobs:
            return
        job = self.random.choice(jobs[-50:] if self.random.random() < .8 else jobs)
        before = self.history.asked(job)
        status, _, body = self.service.request("GET", f"/jobs/{job}", timeout=15)
        self.history.count(status)
        if status == 404 and job not in self.history.dismissed:
            self.history.violated(f"I8: the acknowledged {job} is gone")
        if status != 200:
            return
        info = json.loads(body)
        self.history.answered(job, before, info)
        if info["status"] == "successful" and self.random.random() < .3:
            self.history.check_results(self.service, job)
        elif info["status"] in ("accepted", "running") and self.random.random() < .05:
            status, _, _ = self.service.request("DELETE", f"/jobs/{job}", timeout=15)
            if status == 200:
                with self.history.lock:
                    self.history.dismissed.add(job)


def run(folder: str, verdict, options) -> None:
    count = 20 if options.quick else 500
    rng = random.Random(options.seed)
    history = History()
    references = [Reference(folder, seed) for seed in range(3)]
    service = Service(folder)
    service.start()
    clients = [Client(service, history, references, options.seed * 100 + i) for i in range(4)]
    for client in clients:
        client.start()
    starts = []
    for number in range(count):
        time.sleep(rng.uniform(.1, 1.5))
        service.kill()
        starts.append(service.start())
        if (number + 1) % 50 == 0:
            verdict.say(f"{number + 1} kills", jobs=len(history.jobs), violations=len(history.violations))
    for client in clients:
        client.over.set()
    for client in clients:
        client.join()
    ends = history.check_end(service, 600)
    service.stop()
    service.start()  # it removes what belongs to no job
    service.stop()
    history.check_disk(service)
    verdict.say("answers", **{str(answer): n for answer, n in history.answers.items()})
    verdict.ask(f"{count} kills, {len(history.jobs)} jobs: I1 to I8 (seed {options.seed})", not history.violations,
                history.violations[:3] or ends)
    verdict.ask("listens again within 2 s of a kill", max(starts) < 2, f"{max(starts):.2f} s at most")
