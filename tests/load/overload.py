"""Three times as many DEMs as the workers can do; statuses beside them; then the queue is worked off."""
import time

from open_loop import OpenLoop
from service import Service, small_dem
from verdict import Verdict


def run(folder: str, verdict: Verdict, options) -> None:
    seconds = options.seconds or (10 if options.quick else 60)
    with Service(folder, config={"jobs": {"maxWaiting": 200}}) as service:
        jobs = [service.submit(small_dem(seed))[1]["jobID"] for seed in range(12)]
        begun = time.monotonic()
        for job in jobs:
            service.wait(job)
        capacity = len(jobs) / (time.monotonic() - begun)
        before = service.figure("VmRSS")
        statuses = OpenLoop(lambda _: service.request("GET", f"/jobs/{jobs[0]}", source="127.0.0.2")[0], 20, seconds)
        thread = statuses.beside()
        posts = OpenLoop(lambda i: service.submit(small_dem(i % 7), timeout=60, source=f"127.0.0.{3 + i % 4}")[0],
                         3 * capacity, seconds, threads=100).run()
        thread.join()
        verdict.say("offered", rate=f"{3 * capacity:.1f}/s", posts=posts, memory_KiB=f"{before} to {service.figure('VmRSS')}")
        verdict.ask("overload: 201, 429 or 503", set(posts.answers) <= {201, 429, 503}, posts.answers)
        verdict.ask("statuses meanwhile: p99 below 100 ms", statuses.p99_ms() < 100 and not statuses.failed(), statuses)
        verdict.ask("overload costs less than 64 MiB", service.figure("VmRSS") - before < 65536)
        end = time.monotonic() + 600
        while service.json("/jobs?status=accepted,running&limit=1")["jobs"] and time.monotonic() < end:
            time.sleep(.5)
        done = len(service.json("/jobs?status=successful&limit=10000")["jobs"]) - len(jobs)
        verdict.ask("nothing that was taken is lost", done == posts.answers.get(201, 0), f"{done} done")
