"""The service dies at the N-th call of a kind, for each N of one job's life: strace does that.

strace counts the calls of each thread by themselves: the N-th is that of the thread that comes to it first. After a new start the job that was acknowledged must
end successful with the right bytes, and no object may lack or be too many.
"""
import os
import re
import subprocess
import time

from history import History, Reference
from kills import BROKEN
from service import QUERY, Service

CALLS = ("fsync", "fdatasync", "rename", "link", "unlink", "pwrite64", "ftruncate")


def attach(service: Service, call: str, number: int) -> subprocess.Popen:
    """strace on every thread that there is now; kills with the number-th call of any of them."""
    tracer = subprocess.Popen(
        ["strace", "-f", "-o", "/dev/null", "-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={number}",
         "-p", str(service.pid())], stderr=subprocess.PIPE, text=True)
    threads = len(os.listdir(f"/proc/{service.pid()}/task"))
    attached = 0
    while attached < threads:
        line = tracer.stderr.readline()
        if not line:
            raise RuntimeError("strace does not attach: it may need root, or ptrace is forbidden")
        found = re.search(r"attached(?: with (\d+) threads)?", line)
        if found:
            attached += int(found[1] or 1)
    return tracer


def one(folder: str, reference: Reference, call: str, number: int) -> tuple[bool, list[str]]:
    """(whether the service died, what was violated)"""
    service = Service(folder, workers=1)
    history = History()
    service.start()
    tracer = attach(service, call, number)
    try:
        status, document = service.submit(reference.dem, QUERY, timeout=20)
        if status == 201:
            history.acknowledged(document["jobID"], reference, None)
            if service.wait(document["jobID"], 20)["status"] == "successful":
                service.request("DELETE", "/jobs/" + document["jobID"])
                history.dismissed.add(document["jobID"])
    except BROKEN:
        pass  # it died, as it should
    time.sleep(.1)
    died = service.process.poll() is not None
    if not died:
        service.stop()
    tracer.wait()
    service.start()
    history.check_end(service, 60)
    service.stop()
    service.start()
    service.stop()
    history.check_disk(service)
    return died, history.violations


def run(folder: str, verdict, options) -> None:
    reference = Reference(folder, 1)
    step = 7 if options.quick else 1
    for call in CALLS:
        violations, died, number = [], 0, 1
        while number < 400:
            point = os.path.join(folder, f"{call}-{number}")
            dead, found = one(point, reference, call, number)
            violations += [f"{call} {number}: {what}" for what in found]
            died += dead
            if not dead:
                break
            number += step
        verdict.ask(f"killed at {died} calls of {call}: acknowledged is kept", not violations, violations[:3])
