"""Clients that send their heads or bodies slowly, or do not read; statuses beside them."""
import socket
import threading
import time

from open_loop import OpenLoop
from service import Service, small_dem
from verdict import Verdict


def drip(service: Service, first: bytes, over: threading.Event) -> None:
    """Sends `first`, then a byte a second for as long as it is let."""
    try:
        with socket.create_connection(("127.0.0.1", service.port), timeout=10, source_address=("127.0.0.3", 0)) as peer:
            peer.sendall(first)
            while not over.wait(1):
                peer.sendall(b"x")
    except OSError:
        pass


def run(folder: str, verdict: Verdict, options) -> None:
    seconds = options.seconds or (5 if options.quick else 30)
    with Service(folder, config={"http": {"maxConnectionsPerAddress": 600}}) as service:
        job = service.submit(small_dem(1))[1]["jobID"]
        service.wait(job)
        ask = lambda _: service.request("GET", f"/jobs/{job}", source="127.0.0.2")[0]  # noqa: E731
        alone = OpenLoop(ask, 50, seconds).run()
        over = threading.Event()
        heads = [b"GET /jobs HTTP/1.1\r\nHost: x\r\nX-Slow: "] * 300
        posts = [b"POST /jobs HTTP/1.1\r\nHost: x\r\nContent-Type: image/tiff\r\nContent-Length: 99999\r\n\r\nII*\0"] * 100
        silent = [f"GET /jobs/{job}/results/horizon.geojson HTTP/1.1\r\nHost: x\r\n\r\n".encode() * 50] * 50
        clients = [threading.Thread(target=drip, args=(service, first, over), daemon=True)
                   for first in heads + posts + silent]
        for client in clients:
            client.start()
        beside = OpenLoop(ask, 50, seconds).run()
        verdict.ask("450 slow clients: statuses' p99 at most twice its own or 20 ms",
                    beside.p99_ms() < max(20, 2 * alone.p99_ms()) and not beside.failed(),
                    f"{alone.p99_ms():.1f} and {beside.p99_ms():.1f} ms")
        end = time.monotonic() + 60
        while service.descriptors() > 150 and time.monotonic() < end:
            time.sleep(.5)
        verdict.ask("slow heads are ended", service.descriptors() < 300, service.descriptors())
        over.set()
