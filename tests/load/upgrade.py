"""Three services of an older program on one PostgreSQL server: one after the other goes on with the new program, under
load, and what the old ones made is still there."""
import os
import threading
import time

import database
from nodes import Client
from service import PROGRAM, Service
from verdict import Verdict


def serves(service: Service, client: Client) -> bool:
    """Whether the results that `client` was given are those that it was given, of this service."""
    return all(service.request("GET", f"/jobs/{job}/results/manifest.json")[::2] == (200, manifest)
               for job, manifest in client.manifests.items())


def run(folder: str, verdict: Verdict, options) -> None:
    older = options.older
    if not database.is_installed() or not older or not os.path.exists(older):
        verdict.say("upgrade: left out, for postgresql-15 or the older program (--older PROGRAM) is not there")
        return
    server = database.Database()
    config = {"store": {"jobs": server.url, "objects": os.path.join(folder, "objects"), "leaseSeconds": 3}}
    services = [Service(os.path.join(folder, name), 1, config, program=older) for name in ("ada", "bob", "eve")]
    for service in services:
        service.start()
    over = threading.Event()
    clients = [Client(services, number, over) for number in range(6)]
    for client in clients:
        client.start()
    version = "SELECT version FROM farhorizon.schema_version"
    time.sleep(5)
    before = server.query(version)[0][0]
    of_the_old = 0
    for service in services:
        of_the_old = max(of_the_old, sum(client.done for client in clients))
        service.stop()
        service.program = PROGRAM
        service.start()
        time.sleep(5 if options.quick else 20)  # both programs serve, and work
    over.set()
    for client in clients:
        client.join()
    verdict.say("upgraded in turn", tables=f"{before} to {server.query(version)[0][0]}", jobs_before=of_the_old,
                jobs=sum(client.done for client in clients), requests=sum(client.requests for client in clients),
                retries=sum(client.retries for client in clients),
                longest_request_s=round(max(client.longest for client in clients), 2))
    failures = [failure for client in clients for failure in client.failures]
    verdict.ask("no client that retries sees a failure", not failures, failures[:3])
    verdict.ask("each service gives every job's manifest as it was", all(serves(service, client)
                                                                       for service in services for client in clients))
    left = server.query("SELECT state, count(*) FROM farhorizon.jobs WHERE state <> 'successful' GROUP BY state")
    verdict.ask("every job has succeeded", not left, left)
    if before != server.query(version)[0][0]:
        services[0].stop()
        services[0].program = older
        said = ""
        try:
            services[0].start()
        except RuntimeError as refusal:
            said = str(refusal)
        verdict.ask("the older program refuses the newer tables, and says so", "newer farhorizon" in said, said[-300:])
    for service in services:
        service.stop()
    server.remove()
