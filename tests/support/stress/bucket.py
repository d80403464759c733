"""A bucket on a small S3 server of one's own (tests/support/s3_server.py), which can be killed, frozen and made to fail."""
import http.client
import json
import os
import signal
import subprocess
import sys

SERVER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../s3_server.py")
# What goes wrong with a part of the requests; the last one is slow.
FAULTS = ({"status": 500}, {"status": 503, "code": "SlowDown"}, {"break": "request"}, {"break": "answer"},
          {"flip": "request"}, {"flip": "answer"}, {"stall": .5})


class Bucket:
    """What the server has answered is kept, whatever is done to it."""

    url = "s3://objects/faults"

    def __init__(self, folder: str):
        self.folder = folder
        self.port = 0
        self.process: subprocess.Popen | None = None
        for part in ("objects", "uploads", "temp"):
            os.makedirs(os.path.join(folder, "objects", part))
        self.start()
        self.environment = {"AWS_ENDPOINT_URL": f"http://127.0.0.1:{self.port}", "AWS_ACCESS_KEY_ID": "test-key-id",
                            "AWS_SECRET_ACCESS_KEY": "test/secret+of-the-store"}

    def start(self) -> None:
        command = [sys.executable, "-B", SERVER, self.folder, str(self.port)]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
        assert self.process.stderr
        self.port = int(self.process.stderr.readline())

    def kill(self) -> None:
        assert self.process
        self.process.kill()
        self.process.wait()

    def signal(self, number: int) -> None:
        assert self.process
        self.process.send_signal(number)

    def freeze(self) -> None:
        self.signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self.signal(signal.SIGCONT)

    def fail(self, faults: dict) -> None:
        """As the server's own description has it; {}: no more."""
        self.ask("POST", "/-/faults", json.dumps(faults))

    def ask(self, method: str, path: str, body: str | None = None) -> dict:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.request(method, path, body=body)
            return json.loads(connection.getresponse().read())
        finally:
            connection.close()

    def requests(self) -> dict:
        """Their number by method."""
        return self.ask("GET", "/-/count")

    def names(self, kind: str = "objects") -> set[str]:
        """The names below a folder of the keys."""
        start = f"faults~{kind}~"
        return {name[len(start):] for name in os.listdir(os.path.join(self.folder, "objects/objects"))
                if name.startswith(start)}
