"""Large bodies in both directions, and ranges of one, each compared."""
import http.client
import os
import random
import threading
import time

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
    latencies: list[float] = []
    wrong = [0]
    end = time.monotonic() + seconds

    def loop(seed: int) -> None:
        rng = random.Random(seed)
        connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=30)
        while time.monotonic() < end:
            first = rng.randrange(len(whole))
            last = min(len(whole) - 1, first + rng.randrange(1 << 18))
            begun = time.monotonic()
            connection.request("GET", path, headers={"Range": f"bytes={first}-{last}"})
            response = connection.getresponse()
            body = response.read()
            latencies.append(time.monotonic() - begun)
            wrong[0] += response.status != 206 or body != whole[first:last + 1]
    threads = [threading.Thread(target=loop, args=(seed,)) for seed in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return latencies, wrong[0]


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
