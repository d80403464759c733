"""Disks that are full, have no inodes left, are for reading alone, or fail a sync."""
import os
import subprocess
import time

from service import QUERY, Service, small_dem
from verdict import Verdict


class Mount:
    """A file system in memory."""

    def __init__(self, folder: str, options: str):
        self.folder = folder
        os.makedirs(folder, exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], check=True)

    def remount(self, options: str) -> None:
        subprocess.run(["mount", "-o", "remount," + options, self.folder], check=True)

    def __enter__(self) -> "Mount":
        return self

    def __exit__(self, *_: object) -> None:
        subprocess.run(["umount", "-l", self.folder], check=False)


def fill(path: str) -> None:
    with open(path, "wb", buffering=0) as file:
        try:
            while file.write(b"\0" * 65536):
                pass
        except OSError:
            pass


def full(folder: str, verdict: Verdict) -> None:
    with Mount(folder, "size=64m"):
        service = Service(folder, workers=1, config={"jobs": {"minFreeBytes": 4 << 20}})
        with service:
            done = service.submit(small_dem(1))[1]["jobID"]
            service.wait(done)
            fill(os.path.join(folder, "filler"))
            status, document = service.submit(small_dem(2))
            verdict.ask("full disk: POST 507 no-space", (status, document.get("code")) == (507, "no-space"), status)
            verdict.ask("full disk: not ready", service.request("GET", "/readyz")[0] == 503)
            verdict.ask("full disk: results are read",
                        service.request("GET", f"/jobs/{done}/results/report.json")[0] == 200)
            verdict.ask("full disk: DELETE frees room", service.request("DELETE", "/jobs/" + done)[0] == 200)
            os.unlink(os.path.join(folder, "filler"))
            end = time.monotonic() + 10
            while service.request("GET", "/readyz")[0] != 200 and time.monotonic() < end:
                time.sleep(.2)
            status, document = service.submit(small_dem(2))
            verdict.ask("room again: a job is taken and done",
                        status == 201 and service.wait(document["jobID"])["status"] == "successful", status)


def no_inodes(folder: str, verdict: Verdict) -> None:
    with Mount(folder, "size=256m,nr_inodes=400"):
        with Service(folder, workers=1, config={"jobs": {"minFreeBytes": 0}}) as service:
            made = 0
            try:
                while True:
                    open(os.path.join(folder, f"inode-{made}"), "w", encoding="ascii").close()
                    made += 1
            except OSError:
                pass
            status, _ = service.submit(small_dem(1))
            verdict.ask("no inodes: POST 507 or 503", status in (503, 507), status)
            verdict.ask("no inodes: alive", service.request("GET", "/healthz")[0] == 200)
            for i in range(made):
                os.unlink(os.path.join(folder, f"inode-{i}"))
            status, document = service.submit(small_dem(1))
            verdict.ask("inodes again: a job is done",
                        status == 201 and service.wait(document["jobID"])["status"] == "successful", status)


def read_only(folder: str, verdict: Verdict) -> None:
    with Mount(folder, "size=64m") as mount:
        os.makedirs(os.path.join(folder, "beside"))
        mount.remount("ro")
        service = Service(os.path.join(folder + "-config"), workers=1)
        service.data = os.path.join(folder, "data")
        try:
            service.start()
            ended = None
            service.stop()
        except RuntimeError as failure:
            ended = str(failure)
        verdict.ask("a disk for reading alone: a start is refused, with the reason", ended and "ended with" in ended,
                    (ended or "it started")[:120])


def failed_sync(folder: str, verdict: Verdict) -> None:
    service = Service(folder, workers=1, wrap=("strace", "-f", "-o", "/dev/null", "-e", "trace=fsync,fdatasync", "-e",
                                               "inject=fsync,fdatasync:error=EIO:when=40+"))
    service.start()
    acknowledged = []
    try:
        for seed in range(60):
            status, document = service.submit(small_dem(seed), QUERY, timeout=10)
            if status == 201:
                acknowledged.append(document["jobID"])
    except OSError:
        pass
    except Exception as failure:  # http.client's, of a connection that broke off
        verdict.say("the connection ended", failure=type(failure).__name__)
    code = service.process.wait(20)
    verdict.ask("EIO of a sync ends the process with 74", code == 74, code)
    service.wrap = []
    service.start()
    lost = [job for job in acknowledged if service.wait(job, 120)["status"] != "successful"]
    verdict.ask(f"after EIO {len(acknowledged)} acknowledged jobs are done", acknowledged and not lost, lost or "all")
    service.stop()


def run(folder: str, verdict: Verdict, _options) -> None:
    failed_sync(os.path.join(folder, "eio"), verdict)
    if os.geteuid() != 0:
        print("left out: full disks need mounts, and those root")
        return
    full(os.path.join(folder, "full"), verdict)
    no_inodes(os.path.join(folder, "inodes"), verdict)
    read_only(os.path.join(folder, "ro"), verdict)
