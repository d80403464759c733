"""A farhorizon service of one's own, on loopback, and the requests that tests/faults and tests/load send it."""
import http.client
import json
import math
import os
import random
import re
import signal
import subprocess
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
PROGRAM = os.path.join(ROOT, "build/release/farhorizon")
TERMINAL = ("successful", "failed", "dismissed")
# The DEMs are text grids in degrees: their parameters say so.
QUERY = "?crs=EPSG:4326&levels=1&filename=dem.asc"


def small_dem(seed: int, columns: int = 20, rows: int = 16) -> bytes:
    """An Arc/Info grid of hills; the same for the same seed."""
    rng = random.Random(seed)
    waves = [(rng.uniform(5, 40), rng.uniform(.1, .9), rng.uniform(.1, .9), rng.uniform(0, 6)) for _ in range(4)]
    head = f"ncols {columns}\nnrows {rows}\nxllcorner 10\nyllcorner 46\ncellsize 0.001\n"
    lines = []
    for y in range(rows):
        heights = (500 + sum(a * math.sin(u * x + v * y + p) for a, u, v, p in waves) for x in range(columns))
        lines.append(" ".join(str(round(h)) for h in heights))
    return (head + "\n".join(lines) + "\n").encode()


class Service:
    """A service with a data folder below `folder`; it may be killed and started again, on another port each time."""

    def __init__(self, folder: str, workers: int = 2, config: dict | None = None, wrap: tuple[str, ...] = (),
                 environment: dict | None = None, role: str = "serve", program: str = PROGRAM):
        self.folder, self.workers, self.wrap, self.role = folder, workers, list(wrap), role
        self.program = program
        self.environment = {**os.environ, **(environment or {})}
        self.data = os.path.join(folder, "data")
        self.log = os.path.join(folder, "log")
        self.port = 0
        self.process: subprocess.Popen | None = None
        os.makedirs(folder, exist_ok=True)
        self.config = os.path.join(folder, "config.json")
        with open(self.config, "w", encoding="utf-8") as file:
            json.dump(config or {}, file)

    def start(self, seconds: float = 20) -> float:
        """Starts it and waits until it listens; the seconds that took."""
        begun = time.monotonic()
        command = self.wrap + [self.program, self.role, "--config", self.config, "--listen", "127.0.0.1:0", "--data",
                               self.data, "--workers", str(self.workers)]
        with open(self.log, "ab") as log:
            said = log.tell()
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                            env=self.environment, start_new_session=True)
        while time.monotonic() - begun < seconds:
            with open(self.log, "rb") as log:
                log.seek(said)
                found = re.search(rb'"msg":"serving".*?127\.0\.0\.1:(\d+)', log.read())
            if found:
                self.port = int(found[1])
                return time.monotonic() - begun
            if self.process.poll() is not None:
                raise RuntimeError(f"the service ended with {self.process.returncode}: {self.last_words()}")
            time.sleep(.01)
        raise RuntimeError("the service does not listen: " + self.last_words())

    def last_words(self, lines: int = 3) -> str:
        with open(self.log, encoding="utf-8", errors="replace") as log:
            return "".join(log.readlines()[-lines:])

    def pid(self) -> int:
        """The service's own process, below a wrapper."""
        assert self.process
        pid = self.process.pid
        while os.path.realpath(f"/proc/{pid}/exe") != os.path.realpath(self.program):
            with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as children:
                pid = int(children.read().split()[0])
        return pid

    def kill(self) -> None:
        assert self.process
        os.kill(self.pid(), signal.SIGKILL)
        self.process.wait()

    def stop(self, seconds: float = 30) -> float:
        """Asks it to end; the seconds that took."""
        begun = time.monotonic()
        if self.process and self.process.poll() is None:
            os.kill(self.pid(), signal.SIGTERM)
            try:
                self.process.wait(seconds)
            except subprocess.TimeoutExpired:
                self.kill()
        return time.monotonic() - begun

    def __enter__(self) -> "Service":
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop(15)

    def request(self, method: str, path: str, body: bytes | None = None, headers: dict | None = None,
                timeout: float = 30, source: str = "127.0.0.1") -> tuple[int, dict, bytes]:
        """(status, fields by lower-case name, body). source: the address to come from. Raises OSError,
        http.client.HTTPException."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout, source_address=(source, 0))
        try:
            connection.request(method, path, body=body, headers=headers or {})
            response = connection.getresponse()
            fields = {name.lower(): value for name, value in response.getheaders()}
            return response.status, fields, response.read()
        finally:
            connection.close()

    def json(self, path: str) -> dict:
        return json.loads(self.request("GET", path)[2])

    def submit(self, dem: bytes, query: str = QUERY, key: str | None = None, timeout: float = 60,
               source: str = "127.0.0.1") -> tuple[int, dict]:
        """(status, document)"""
        headers = {"Content-Type": "application/octet-stream"}
        if key:
            headers["Idempotency-Key"] = f'"{key}"'
        status, _, body = self.request("POST", "/jobs" + query, dem, headers, timeout, source)
        try:
            return status, json.loads(body)
        except ValueError:
            return status, {"body": body[:200].decode("latin-1")}

    def wait(self, job: str, seconds: float = 120) -> dict:
        """The job's status once it has ended, or after so many seconds."""
        end = time.monotonic() + seconds
        while True:
            info = self.json(f"/jobs/{job}")
            if info.get("status") in TERMINAL or time.monotonic() > end:
                return info
            time.sleep(.05)

    def figure(self, field: str) -> int:
        """A number of /proc/PID/status: VmRSS and VmHWM in KiB, Threads."""
        with open(f"/proc/{self.pid()}/status", encoding="ascii", errors="replace") as file:
            return int(next(line.split()[1] for line in file if line.startswith(field + ":")))

    def descriptors(self) -> int:
        return len(os.listdir(f"/proc/{self.pid()}/fd"))
