"""The power fails: at any moment, what was not synced may be there, in part or not at all.

One service is recorded (storage_log.py) while a client submits, waits and dismisses, through a stop and a new start.
Then what each of many cuts may leave is rebuilt, and a service is started on it: what the client had been answered by
then must hold. Of objects whose mark as incoming was lost nobody knows: they may be set aside.
"""
import functools
import math
import os
import random
import shutil
import time

import storage_log
from history import History, Reference
from service import QUERY, Service

# What stays of changes that are not certain: none; all; entries without contents, and the reverse; any part.
REMAINS = {
    "nothing": lambda rng, node: False,
    "all": lambda rng, node: True,
    "entries": lambda rng, node: node.folder,
    "contents": lambda rng, node: not node.folder,
    "parts": lambda rng, node: rng.random() < .5,
}


class Client:
    """What it was answered, and when."""

    def __init__(self, service: Service):
        self.service = service
        self.answers: list[tuple[float, str, str, object]] = []

    def note(self, what: str, job: str, detail: object = None) -> None:
        self.answers.append((time.time(), what, job, detail))

    def submit(self, reference: Reference) -> str:
        status, document = self.service.submit(reference.dem, QUERY)
        assert status == 201, document
        self.note("submitted", document["jobID"], reference)
        return document["jobID"]

    def wait(self, job: str) -> None:
        info = self.service.wait(job)
        assert info["status"] == "successful", info
        self.note("ended", job, info)

    def dismiss(self, job: str) -> None:
        self.note("dismisses", job)
        assert self.service.request("DELETE", "/jobs/" + job)[0] == 200
        self.note("dismissed", job)

    def known_at(self, when: float) -> History:
        """What it may hold a service to, from the answers before `when`."""
        history = History()
        doubtful = set()
        for at, what, job, detail in self.answers:
            if at >= when:
                break
            if what == "submitted":
                history.acknowledged(job, detail, None)
            elif what == "ended":
                history.states[job] = detail
            elif what == "dismisses":
                doubtful.add(job)
            else:
                doubtful.remove(job)
                history.dismissed.add(job)
        for job in doubtful:  # dismissed or not: both are right
            del history.jobs[job]
        return history


def record(folder: str, references: list[Reference]) -> tuple[Client, str]:
    log = os.path.join(folder, "calls")
    service = Service(folder, workers=1, wrap=storage_log.strace(log))
    client = Client(service)
    service.start(60)
    first = client.submit(references[0])
    client.wait(first)
    second = client.submit(references[1])
    client.dismiss(first)
    client.wait(second)
    third = client.submit(references[2])
    client.dismiss(third)
    client.submit(references[0])
    service.stop()
    shutil.move(log, log + "-1")
    service.start(60)
    client.wait(client.submit(references[1]))
    service.stop()
    whole = log + "-whole"
    with open(whole, "wb") as joined:
        for part in (log + "-1", log):
            with open(part, "rb") as lines:
                shutil.copyfileobj(lines, joined)
    return client, whole


def faults_after(folder: str, storage: storage_log.Storage, stays, history: History) -> list[str]:
    """What is wrong with a service that starts on what a cut now leaves."""
    service = Service(folder, workers=2)
    storage_log.rebuild(storage.root, service.data, stays)
    try:
        service.start()
        history.check_end(service, 60)
        service.stop()
        service.start()  # it removes what belongs to no job
        service.stop()
        history.check_disk(service, aside=True)
    except RuntimeError as failure:
        history.violated(str(failure))
    finally:
        service.stop()
    return history.violations


def run(folder: str, verdict, options) -> None:
    rng = random.Random(options.seed)
    references = [Reference(folder, seed) for seed in range(3)]
    client, log = record(os.path.join(folder, "recorded"), references)
    storage = storage_log.Storage(client.service.data)
    changes = [call for call in storage_log.calls(log) if storage.apply(call)]
    chosen = set(rng.sample(range(len(changes)), min(40 if options.quick else 400, len(changes))))
    found: dict[str, list[str]] = {name: [] for name in REMAINS}
    storage = storage_log.Storage(client.service.data)
    for number, call in enumerate(changes):
        storage.apply(call)
        if number not in chosen:
            continue
        name = rng.choice(list(REMAINS))
        until = changes[number + 1].begun if number + 1 < len(changes) else math.inf
        state = os.path.join(folder, f"cut-{number}")
        wrong = faults_after(state, storage, functools.partial(REMAINS[name], rng), client.known_at(until))
        found[name].append([f"after change {number} ({call.name}): {what}" for what in wrong])
        if not wrong:
            shutil.rmtree(state)
    for name, cuts in found.items():
        wrong = [what for cut in cuts for what in cut]
        verdict.ask(f"{len(cuts)} power cuts, of what was not synced stays: {name} (seed {options.seed})", not wrong,
                    wrong[:3])
