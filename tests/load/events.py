"""Many subscribers to the events of a few jobs."""
import datetime
import json
import re
import resource
import selectors
import socket
import time

from service import TERMINAL, Service, small_dem
from verdict import Verdict, milliseconds, percentile


class Subscriber:
    """A stream of a job's events, read as it comes."""

    def __init__(self, service: Service, job: str):
        self.socket = socket.create_connection(("127.0.0.1", service.port), timeout=30)
        self.socket.sendall(f"GET /jobs/{job}/events HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        self.unread = b""
        self.last: dict = {}

    def take(self) -> tuple[bool, list[float]]:
        """(whether the stream goes on, the seconds that the events in the socket took)"""
        piece = self.socket.recv(65536)
        now = time.time()
        delays = []
        self.unread += piece
        while (found := re.search(rb"data: (\{.*\})\n", self.unread)) is not None:
            self.unread = self.unread[found.end():]
            self.last = json.loads(found[1])
            updated = datetime.datetime.fromisoformat(self.last["updated"].replace("Z", "+00:00")).timestamp()
            delays.append(now - updated)
        return bool(piece), delays


def run(folder: str, verdict: Verdict, options) -> None:
    count, jobs = (200, 4) if options.quick else (2000, 20)
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    config = {"http": {"maxConnections": 4096, "maxConnectionsPerAddress": 4096}, "jobs": {"maxWatches": 4096}}
    with Service(folder, config=config) as service:
        # The first ones run while the subscribers come.
        ids = [service.submit(small_dem(seed, 120, 100), timeout=300)[1]["jobID"] for seed in range(jobs)]
        before = service.figure("VmRSS")
        selector = selectors.DefaultSelector()
        subscribers = []
        for number in range(count):
            subscribers.append(Subscriber(service, ids[-1 - number % jobs]))
            selector.register(subscribers[-1].socket, selectors.EVENT_READ, subscribers[-1])
        memory = (service.figure("VmRSS") - before) / count
        # What has happened before a subscriber came is no delay of an event.
        come = time.time()
        delays: list[float] = []
        left = count
        end = time.monotonic() + 600
        while left and time.monotonic() < end:
            for key, _ in selector.select(1):
                goes_on, took = key.data.take()
                delays += [one for one in took if time.time() - one > come]
                if not goes_on:
                    selector.unregister(key.fileobj)
                    key.data.socket.close()
                    left -= 1
        ends = [one.last.get("status") for one in subscribers]
        verdict.ask(f"{count} subscribers of {jobs} jobs: each has seen the end", set(ends) <= set(TERMINAL), set(ends))
        verdict.ask("events' p99 below 500 ms", delays and percentile(delays, .99) < .5,
                    f"{len(delays)} in {milliseconds(delays)}")
        verdict.ask("a subscriber takes less than 32 KiB", memory < 32, f"{memory:.1f} KiB")
        verdict.ask("the service has let go of all", service.descriptors() < 150, service.descriptors())
