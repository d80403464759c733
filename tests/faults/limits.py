"""Descriptors, frozen workers, drains, and a clock that jumps."""
import os
import signal
import socket
import time

from service import Service, small_dem
from verdict import Verdict


def ticks(pid: str) -> int:
    """The processor time that a process has used."""
    with open(f"/proc/{pid}/stat", encoding="ascii", errors="replace") as file:
        return int(file.read().rsplit(")", 1)[1].split()[11])


def worker_of(service: Service, job: str, seconds: float = 20) -> int:
    """The process that works on a job; 0 where none does. The job's folder is mounted in it, and in the one that
    waits for it, which takes no time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{pid}/mountinfo", "rb") as file:
                    inside = job.encode() in file.read() or job in os.readlink(f"/proc/{pid}/cwd")
                if inside and int(pid) != service.pid() and ticks(pid) > 20:
                    return int(pid)
            except OSError:
                continue
        time.sleep(.05)
    return 0


def descriptors(folder: str, verdict: Verdict) -> None:
    wrap = ("prlimit", "--nofile=128:128")
    with Service(folder, wrap=wrap) as service:
        idle = []
        try:
            for _ in range(300):
                idle.append(socket.create_connection(("127.0.0.1", service.port), timeout=2))
        except OSError:
            pass
        time.sleep(.5)
        try:
            status = service.request("GET", "/healthz", timeout=5)[0]
        except OSError as failure:
            status = type(failure).__name__
        verdict.ask(f"128 descriptors, {len(idle)} idle connections: /healthz answers", status == 200, status)
        for connection in idle:
            connection.close()
        time.sleep(.5)
        status, document = service.submit(small_dem(1))
        verdict.ask("descriptors again: a job is done",
                    status == 201 and service.wait(document["jobID"])["status"] == "successful", status)


def frozen_worker(folder: str, verdict: Verdict) -> None:
    with Service(folder, workers=1) as service:
        job = service.submit(small_dem(1, 240, 200))[1]["jobID"]
        pid = worker_of(service, job)
        if not verdict.ask("the worker of a job is found", pid):
            return
        os.kill(pid, signal.SIGSTOP)
        begun = time.monotonic()
        while os.path.exists(f"/proc/{pid}") and time.monotonic() - begun < 40:
            time.sleep(.1)
        verdict.ask("a stopped worker is noticed within 20 s", time.monotonic() - begun < 20,
                    f"{time.monotonic() - begun:.1f} s")
        info = service.wait(job, 180)
        verdict.ask("and its job runs again", info["status"] == "successful", (info["status"], info.get("attempt"), info.get("exception")))


def drain(folder: str, verdict: Verdict) -> None:
    service = Service(folder, workers=1)
    service.start()
    dem = small_dem(1, 240, 200)
    # So rough that it may need more memory than was expected, and with that a second attempt.
    usual = service.wait(service.submit(dem)[1]["jobID"], 180)["attempt"]
    job = service.submit(dem)[1]["jobID"]
    worker_of(service, job)
    took = service.stop(30)
    verdict.ask("SIGTERM beside a long job: exit 0 within 10 s", took < 10 and service.process.returncode == 0,
                f"{took:.1f} s, {service.process.returncode}")
    service.start()
    info = service.wait(job, 180)
    verdict.ask("the job that was cut off is done, and has spent no attempt for that",
                info["status"] == "successful" and info["attempt"] == usual, (info["status"], info.get("attempt"), info.get("exception")))
    service.stop()


def clock(folder: str, verdict: Verdict) -> None:
    """A service that is started again an hour earlier."""
    service = Service(folder, workers=1)
    service.start()
    first = service.submit(small_dem(1))[1]["jobID"]
    before = service.wait(first)
    service.stop()
    service.wrap = ["faketime", "-f", "-1h"]
    try:
        service.start()
        second = service.submit(small_dem(2))[1]["jobID"]
        after = service.wait(second)
        again = service.json("/jobs/" + first)
        verdict.ask("an hour back: times and order of jobs do not go back",
                    after["status"] == "successful" and after["created"] >= before["created"] and second > first
                    and again["updated"] >= before["updated"], (before["created"], after["created"]))
    finally:
        service.stop()


def run(folder: str, verdict: Verdict, _options) -> None:
    for case in (descriptors, frozen_worker, drain, clock):
        case(os.path.join(folder, case.__name__), verdict)
