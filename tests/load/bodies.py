"""Large bodies in both directions, and ranges of one, each compared."""
import http.client
import os
import random
import threading
import time

from closed_loop import closed_loop
from service import Service, small_dem
from verdict import Verdict, milliseconds


def upload(service: Service, mib: int) -> tuple[float, int]:
    """(seconds until the last byte was taken, status) of a body that is no DEM but for its first bytes."""
    piece = os.urandom(1 << 20)
    connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=300)
    connection.putrequest("POST", "/jobs")
    connection.putheader("Content-Type", "image/tiff")
    connection.putheader("Content-Length", str(mib << 20))
    connection.endheaders()
    begun = time.monotonic()
    connection.send(b"II*\0" + piece[4:])
    for _ in range(mib - 1):
        connection.send(piece)
    took = time.monotonic() - begun
    status = connection.getresponse().status
    connection.close()
    return took, status


def ranges(service: Service, path: str, whole: bytes, seconds: float) -> tuple[list[float], int]:
    """(latencies, wrong answers) of 16 clients that ask for pieces of `whole`."""
    clients = 16
    randoms = [random.Random(seed) for seed in range(clients)]

    def ask(connection: http.client.HTTPConnection, number: int) -> bool:
        first = randoms[number].randrange(len(whole))
        last = min(len(whole) - 1, first + randoms[number].randrange(1 << 18))
        connection.request("GET", path, headers={"Range": f"bytes={first}-{last}"})
        response = connection.getresponse()
        body = response.read()
        return response.status == 206 and body == whole[first:last + 1]
    return closed_loop(service, clients, seconds, ask)


def run(folder: str, verdict: Verdict, options) -> None:
    mib = 32 if options.quick else 512
    with Service(folder) as service:
        before = service.figure("VmRSS")
        took, status = upload(service, mib)
        verdict.say(f"upload of {mib} MiB", rate=f"{mib / took:.0f} MiB/s", status=status)
        verdict.ask("what is no DEM is refused", 400 <= status < 500, status)
        threads = [threading.Thread(target=upload, args=(service, mib // 8)) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        grown = service.figure("VmHWM") - before
        verdict.ask("uploads cost less than 64 MiB of memory", grown < 65536, f"{grown} KiB")
        job = service.submit(small_dem(1, 240, 200))[1]["jobID"]
        service.wait(job, 300)
        path = f"/jobs/{job}/results/horizon.geojson"
        whole = service.request("GET", path)[2]
        latencies, wrong = ranges(service, path, whole, options.seconds or (3 if options.quick else 15))
        verdict.ask(f"ranges of {len(whole) >> 10} KiB: each is right", not wrong and latencies,
                    f"{len(latencies)}, {milliseconds(latencies)}")
