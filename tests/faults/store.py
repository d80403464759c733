"""Stores that are not what the service left: refused with what to do, nothing deleted."""
import os
import random
import shutil
import subprocess

from service import PROGRAM, Service, small_dem
from verdict import Verdict


def objects(service: Service) -> dict[str, int]:
    found = {}
    for folder, _, files in os.walk(os.path.join(service.data, "objects")):
        for name in files:
            if len(name) == 64:
                found[name] = os.path.getsize(os.path.join(folder, name))
    return found


def refuses(service: Service) -> str | None:
    """What a start says; None where it listens."""
    try:
        service.start()
    except RuntimeError as failure:
        return str(failure)
    service.stop()
    return None


def run(folder: str, verdict: Verdict, options) -> None:
    rng = random.Random(options.seed)
    service = Service(folder, workers=2)
    service.start()
    jobs = [service.submit(small_dem(seed))[1]["jobID"] for seed in range(4)]
    for job in jobs:
        service.wait(job)
    service.stop()
    database = os.path.join(service.data, "jobs.sqlite")
    before = objects(service)
    older = os.path.join(folder, "older")
    shutil.copy(database, older)
    service.start()
    jobs.append(service.submit(small_dem(9))[1]["jobID"])
    service.wait(jobs[-1])
    service.stop()
    before = objects(service)
    good = os.path.join(folder, "good")
    shutil.copytree(service.data, good)

    def restore() -> None:
        shutil.rmtree(service.data)
        shutil.copytree(good, service.data)

    for name, spoil in (("is missing", lambda: os.unlink(database)),
                        ("is empty", lambda: open(database, "w", encoding="ascii").close()),
                        ("is an older one", lambda: shutil.copy(older, database)),
                        ("is cut off", lambda: os.truncate(database, os.path.getsize(database) // 2)),
                        ("is no database", lambda: open(database, "w", encoding="ascii").write("x" * 8192))):
        spoil()
        said = refuses(service)
        verdict.ask(f"a database that {name}: a start is refused, nothing deleted",
                    said and objects(service) == before, (said or "it started")[-160:].strip())
        restore()

    wrong, refused = 0, 0
    flips = 20 if options.quick else 200
    for _ in range(flips):
        with open(database, "r+b") as file:
            at = rng.randrange(os.path.getsize(database))
            file.seek(at)
            byte = file.read(1)[0]
            file.seek(at)
            file.write(bytes([byte ^ (1 << rng.randrange(8))]))
        if refuses(service):
            refused += 1
            subprocess.run([PROGRAM, "fsck", service.data, "--repair"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, check=False)
        wrong += not set(before) <= set(objects(service)) | set(strays(service))
        restore()
    verdict.ask(f"{flips} databases with a bit flipped: no object deleted", not wrong, f"{refused} starts refused")
    damaged_result(service, jobs[0], verdict)


def strays(service: Service) -> list[str]:
    return [name for folder, _, files in os.walk(service.data) for name in files if "stray" in folder]


def damaged_result(service: Service, job: str, verdict: Verdict) -> None:
    service.start()
    sha = service.json(f"/jobs/{job}/results")["report.json"]["sha256"]
    path = os.path.join(service.data, "objects", sha[:2], sha)
    os.chmod(path, 0o600)
    with open(path, "r+b") as file:
        file.seek(10)
        file.write(b"\xff")
    status, _, body = service.request("GET", f"/jobs/{job}/results/report.json")
    verdict.ask("a damaged result is 500 result-corrupt", status == 500 and b"result-corrupt" in body, status)
    service.stop()
    said = subprocess.run([PROGRAM, "fsck", service.data, "--repair"], capture_output=True, text=True, check=False)
    service.start()
    verdict.ask("fsck --repair lets its job run again", service.wait(job)["status"] == "successful",
                said.stdout.splitlines()[-1:])
    service.stop()
