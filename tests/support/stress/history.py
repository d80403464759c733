"""What clients were answered, and the invariants that it is held to.

I1 each acknowledged job reaches exactly one terminal state; I2 no job shows two results; I3 a client sees states,
progress and times move forward only; I4 successful means that all outputs are there and right; I5 dismissed never
becomes successful; I6 one Idempotency-Key, one job; I7 no orphan object and no dangling row once all is done; I8 no
201 without durable bytes (a job that was acknowledged is there after any kill).
"""
import hashlib
import os
import sqlite3
import subprocess
import threading
import time

from service import PROGRAM, Service, TERMINAL, small_dem

RANK = {"accepted": 0, "running": 1, "successful": 2, "failed": 2, "dismissed": 2}


class Reference:
    """A DEM and the bytes that `farhorizon build` makes of it: what its job must leave."""

    def __init__(self, folder: str, seed: int):
        self.dem = small_dem(seed)
        os.makedirs(folder, exist_ok=True)
        dem = os.path.join(folder, "dem.asc")
        with open(dem, "wb") as file:
            file.write(self.dem)
        out = os.path.join(folder, f"built-{seed}")
        subprocess.run([PROGRAM, "build", dem, "-o", out, "--crs", "EPSG:4326", "--levels", "1"], check=True,
                       stderr=subprocess.DEVNULL)
        self.hashes = {}
        for name in os.listdir(out):
            with open(os.path.join(out, name), "rb") as file:
                self.hashes[name] = hashlib.sha256(file.read()).hexdigest()


class History:
    """Threads: safe."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.violations: list[str] = []
        self.answers: dict[object, int] = {}
        self.jobs: dict[str, Reference] = {}
        self.keys: dict[str, set[str]] = {}
        self.states: dict[str, dict] = {}
        self.dismissed: set[str] = set()

    def violated(self, what: str) -> None:
        with self.lock:
            self.violations.append(what)
        print("VIOLATED " + what, flush=True)

    def count(self, answer: object) -> None:
        with self.lock:
            self.answers[answer] = self.answers.get(answer, 0) + 1

    def acknowledged(self, job: str, reference: Reference, key: str | None) -> None:
        with self.lock:
            self.jobs[job] = reference
            if key:
                self.keys.setdefault(key, set()).add(job)
                several = len(self.keys[key]) > 1
        if key and several:
            self.violated(f"I6: the key {key} has made {self.keys[key]}")

    def asked(self, job: str) -> tuple[dict | None, bool]:
        """What was known of a job before it is asked for: to be given to `answered`."""
        with self.lock:
            return self.states.get(job), job in self.dismissed

    def answered(self, job: str, before: tuple[dict | None, bool], now: dict) -> None:
        known, was_dismissed = before
        if was_dismissed and now["status"] != "dismissed":
            self.violated(f"I5: {job} was dismissed and is {now['status']}")
        if known:
            if known["status"] in TERMINAL and now["status"] not in (known["status"], "dismissed"):
                self.violated(f"I1: {job} was {known['status']} and is {now['status']}")
            if now["progress"] < known["progress"] or now["updated"] < known["updated"]:
                self.violated(f"I3: progress or time of {job} went back: {known} {now}")
            if known.get("finished") and now.get("finished") != known["finished"] and now["status"] != "dismissed":
                self.violated(f"I2: {job} has ended twice")
        with self.lock:
            if self.states.get(job) is known:
                self.states[job] = now

    def check_results(self, service: Service, job: str) -> None:
        """I2 and I4: every file, as `build` writes it."""
        for name, expected in self.jobs[job].hashes.items():
            for _ in range(200):  # a storage that is broken for a while is answered 503: one asks again
                status, _, body = service.request("GET", f"/jobs/{job}/results/{name}")
                if status != 503:
                    break
                self.count(503)
                time.sleep(.5)
            right = status == 200 and hashlib.sha256(body).hexdigest() == expected
            if not right and job not in self.dismissed:
                self.violated(f"I4: {name} of the successful {job}: {status}")

    def check_end(self, service: Service, seconds: float = 300) -> dict[str, int]:
        """Waits for all jobs and holds the service to I1, I4 and I8; how many ended in which state."""
        ends: dict[str, int] = {}
        for job in self.jobs:
            before = self.asked(job)
            status, _, _ = service.request("GET", f"/jobs/{job}")
            if status == 404:
                if job not in self.dismissed:
                    self.violated(f"I8: the acknowledged {job} is gone")
                continue
            info = service.wait(job, seconds)
            self.answered(job, before, info)
            ends[info["status"]] = ends.get(info["status"], 0) + 1
            if info["status"] not in TERMINAL:
                self.violated(f"I1: {job} is still {info['status']}")
            if info["status"] == "failed":
                self.violated(f"I1: {job} has failed: {info.get('exception')}")
            if info["status"] == "successful":
                self.check_results(service, job)
        return ends

    def check_disk(self, service: Service, aside: bool = False) -> None:
        """I7, of a stopped service: objects and rows against each other. aside: objects that nobody knows may have
        been set aside."""
        database = sqlite3.connect(f"file:{service.data}/jobs.sqlite?mode=ro", uri=True)
        named = {row[0] for row in database.execute(
            "SELECT input_sha256 FROM jobs UNION SELECT sha256 FROM artifacts UNION "
            "SELECT gzip_sha256 FROM artifacts WHERE gzip_sha256 IS NOT NULL UNION "
            "SELECT zstd_sha256 FROM artifacts WHERE zstd_sha256 IS NOT NULL UNION SELECT sha256 FROM upload_parts "
            "UNION SELECT sha256 FROM uploads WHERE sha256 IS NOT NULL")}
        database.close()
        there, left = set(), []
        for folder, _, files in os.walk(service.data):
            below, *rest = os.path.relpath(folder, service.data).split(os.sep)
            for name in files:
                if aside and rest == ["stray"]:
                    continue
                if below == "objects" and len(name) == 64:
                    there.add(name)
                elif below in ("spool", "work"):
                    left.append(name)
        if there - named or named - there or left:
            self.violated(f"I7: {len(there - named)} orphans, {len(named - there)} dangling rows, left: {left[:5]}")
