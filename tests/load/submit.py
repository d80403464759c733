"""Small DEMs: one after another, and 500 in five seconds."""
import time

from open_loop import OpenLoop
from service import Service, small_dem
from verdict import Verdict, milliseconds


def run(folder: str, verdict: Verdict, options) -> None:
    count = 50 if options.quick else 500
    with Service(folder) as service:
        latencies = []
        end = time.monotonic() + (options.seconds or (3 if options.quick else 10))
        seed = 0
        while time.monotonic() < end:
            begun = time.monotonic()
            status, document = service.submit(small_dem(seed))
            latencies.append(time.monotonic() - begun)
            seed += 1
            if not verdict.asked and status != 201:
                verdict.ask("a POST is 201", False, document)
        verdict.say("POST one after another, beside the workers", latency=milliseconds(latencies))
        while service.json("/jobs?status=accepted,running&limit=1")["jobs"]:
            time.sleep(.2)
        done = len(service.json("/jobs?status=successful&limit=10000")["jobs"])
        health = OpenLoop(lambda _: service.request("GET", "/healthz", source="127.0.0.2")[0], 20, count / 100 + 3)
        thread = health.beside()
        # A client each: 256 connections an address are let in.
        posts = OpenLoop(lambda i: service.submit(small_dem(i % 7), timeout=120, source=f"127.0.0.{3 + i % 8}")[0],
                         100, count / 100, threads=count).run()
        thread.join()
        taken = posts.answers.get(201, 0)
        verdict.ask(f"{count} POSTs at 100/s: 201, 429 or 503", set(posts.answers) <= {201, 429, 503}, posts)
        verdict.ask("each answered within 2 s", max(posts.latencies) < 2, f"{max(posts.latencies):.1f} s at most")
        verdict.ask("/healthz meanwhile: p99 below 20 ms", health.p99_ms() < 20 and not health.failed(), health)
        end = time.monotonic() + 600
        while service.json("/jobs?status=accepted,running&limit=1")["jobs"] and time.monotonic() < end:
            time.sleep(.5)
        ended = len(service.json("/jobs?status=successful&limit=10000")["jobs"]) - done
        verdict.ask("every 201 ends successful", ended == taken, f"{ended} of {taken}")
