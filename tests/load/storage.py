"""Tiles a minute by one, two and three worker processes on one database and one bucket, beside a folder."""
import os
import time

import bucket
import database
from service import QUERY, Service, small_dem
from verdict import Verdict

PROCESSES = ("worker-1", "worker-2", "worker-3")


def rate(folder: str, count: int, tiles: int, verdict: Verdict, in_bucket: bool) -> float:
    """Tiles a minute of `count` worker processes, one job at a time each, from the first POST to the last end."""
    os.makedirs(folder)
    server = database.Database()
    place = os.path.join(folder, "objects")
    objects = bucket.Bucket(place) if in_bucket else None
    config = {"store": {"jobs": server.url, "objects": objects.url if objects else place}}
    environment = objects.environment if objects else {}
    # What takes the jobs works, too; its one worker is the first of them.
    processes = [Service(os.path.join(folder, name), 1, config, environment=environment,
                         role="serve" if name == PROCESSES[0] else "work") for name in PROCESSES[:count]]
    for process in processes:
        process.start()
    door = processes[0]
    dems = [small_dem(seed, 90, 70) for seed in range(tiles)]
    begun = time.monotonic()
    jobs = [door.submit(dem, QUERY.replace("levels=1", "levels=5"))[1]["jobID"] for dem in dems]
    ends = [door.wait(job, 600)["status"] for job in jobs]
    took = time.monotonic() - begun
    verdict.ask(f"{tiles} tiles by {count} in a {'bucket' if objects else 'folder'}", set(ends) == {"successful"}, set(ends))
    for process in processes:
        process.stop()
    if objects:
        verdict.say("requests a tile", **{method: round(number / tiles, 1)
                                          for method, number in objects.requests().items()})
        objects.kill()
    server.remove()
    return 60 * tiles / took


def run(folder: str, verdict: Verdict, options) -> None:
    if not database.is_installed():
        verdict.say("storage: left out, for postgresql-15 is not installed")
        return
    tiles = 6 if options.quick else 30
    for count in range(1, 1 + len(PROCESSES)):
        rates = {kind: round(rate(os.path.join(folder, f"{kind}-{count}"), count, tiles, verdict, kind == "bucket"), 1)
                 for kind in ("folder", "bucket")}
        verdict.say(f"tiles a minute, {count} processes", **rates)
