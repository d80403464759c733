"""Clients that ask again as soon as they are answered, each on a connection of its own."""
import http.client
import threading
import time
from typing import Callable

from service import Service


def closed_loop(service: Service, clients: int, seconds: float,
                ask: Callable[[http.client.HTTPConnection, int], bool]) -> tuple[list[float], int]:
    """(latencies, wrong answers). ask: one request of client `number` on its connection; whether its answer was right.
    It is timed as a whole."""
    latencies: list[float] = []
    wrong = [0]
    end = time.monotonic() + seconds

    def loop(number: int) -> None:
        connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=30)
        while time.monotonic() < end:
            begun = time.monotonic()
            right = ask(connection, number)
            latencies.append(time.monotonic() - begun)
            wrong[0] += not right
        connection.close()
    threads = [threading.Thread(target=loop, args=(number,)) for number in range(clients)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return latencies, wrong[0]
