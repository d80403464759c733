"""Statuses: many connections at once, then beside busy workers."""
import http.client
import time

from closed_loop import closed_loop
from open_loop import OpenLoop
from service import Service, small_dem
from verdict import Verdict, milliseconds


def run(folder: str, verdict: Verdict, options) -> None:
    seconds = options.seconds or (3 if options.quick else 15)
    with Service(folder) as service:
        job = service.submit(small_dem(1))[1]["jobID"]
        service.wait(job)

        def ask(connection: http.client.HTTPConnection, _: int) -> bool:
            connection.request("GET", f"/jobs/{job}")
            response = connection.getresponse()
            response.read()
            return response.status == 200
        for connections in (1, 16):
            latencies, wrong = closed_loop(service, connections, seconds, ask)
            # The client is Python, on the same cores: a floor of the rate, no measure of the service.
            verdict.say(f"{connections} connections", rate=f"{len(latencies) / seconds:.0f}/s",
                        latency=milliseconds(latencies), memory_KiB=service.figure("VmRSS"))
            verdict.ask(f"{connections} connections: every status 200", not wrong, wrong)
        status, fields, _ = service.request("GET", f"/jobs/{job}")
        again, _, body = service.request("GET", f"/jobs/{job}", headers={"If-None-Match": fields["etag"]})
        verdict.ask("a status that has not changed is 304 without a body", (status, again, body) == (200, 304, b""), again)
        for seed in range(2):
            service.submit(small_dem(seed, 240, 200))
        time.sleep(1)
        loop = OpenLoop(lambda _: service.request("GET", f"/jobs/{job}", source="127.0.0.2")[0], 50, seconds).run()
        verdict.ask("beside two busy workers statuses have a p99 below 100 ms",
                    loop.p99_ms() < 100 and not loop.failed(), loop)
