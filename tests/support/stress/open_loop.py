"""Requests at a rate, whether or not those before have been answered."""
import http.client
import queue
import threading
import time
from typing import Callable

from verdict import milliseconds, percentile


class OpenLoop:
    """Calls `deed` at a rate. A latency is counted from the moment that the call was due, so that a service that
    stops answering shows in every one of them. The threads are there before: to start one takes time."""

    def __init__(self, deed: Callable[[int], object], rate: float, seconds: float, threads: int = 64):
        self.deed, self.rate, self.count = deed, rate, int(rate * seconds)
        self.latencies: list[float] = []
        self.answers: dict[object, int] = {}
        self.due: queue.Queue = queue.Queue()
        self.lock = threading.Lock()
        self.workers = [threading.Thread(target=self.work, daemon=True) for _ in range(threads)]

    def work(self) -> None:
        while True:
            item = self.due.get()
            if item is None:
                return
            number, at = item
            try:
                answer = self.deed(number)
            except (OSError, http.client.HTTPException) as failure:
                answer = type(failure).__name__
            with self.lock:
                self.latencies.append(time.monotonic() - at)
                self.answers[answer] = self.answers.get(answer, 0) + 1

    def run(self) -> "OpenLoop":
        for worker in self.workers:
            worker.start()
        begun = time.monotonic()
        for number in range(self.count):
            at = begun + number / self.rate
            time.sleep(max(0., at - time.monotonic()))
            self.due.put((number, at))
        for _ in self.workers:
            self.due.put(None)
        for worker in self.workers:
            worker.join()
        return self

    def beside(self) -> threading.Thread:
        """Runs it in a thread of its own, started."""
        thread = threading.Thread(target=self.run, daemon=True)
        thread.start()
        return thread

    def p99_ms(self) -> float:
        return percentile(self.latencies, .99) * 1000

    def failed(self) -> dict[object, int]:
        return {answer: n for answer, n in self.answers.items() if not isinstance(answer, int) or answer >= 500}

    def __str__(self) -> str:
        return f"{len(self.latencies)} in {milliseconds(self.latencies)}, {self.answers}"
