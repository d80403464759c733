"""Starts the service and nginx with config/nginx.conf, and talks to both as clients do. See run."""
import http.client
import json
import os
import pathlib
import re
import select
import shutil
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import time

ROOT, FARHORIZON, PORT = pathlib.Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
SERVICE_PORT = PORT + 1
NAME = "dem.example.org"
# More than nginx' own buffers and those of the sockets together, and less than a small disk.
LARGE = 256 << 20

failed = 0


def check(what, holds, said=""):
    global failed
    failed += not holds
    print(f"{'ok    ' if holds else 'FAILED'} {what}{said and ': ' + str(said)}", flush=True)


def nginx_configuration(folder):
    """The example, with nothing changed but its ports and the places of its certificate."""
    text = (ROOT / "config/nginx.conf").read_text()
    for was, becomes in ((r"listen 443 ssl;", f"listen 127.0.0.1:{PORT} ssl;"),
                         (r"/etc/ssl/\w+/dem\.example\.org\.pem", f"{folder}/cert.pem"),
                         (r"/etc/ssl/\w+/dem\.example\.org\.key", f"{folder}/key.pem"),
                         (r"http://127\.0\.0\.1:8080", f"http://127.0.0.1:{SERVICE_PORT}")):
        text, count = re.subn(was, becomes, text)
        assert count >= 1, was
    temporary = "".join(f"{kind}_temp_path {folder}/temp/{kind};\n" for kind in
                        ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
    (folder / "temp").mkdir()
    user = "user root;\n" if os.geteuid() == 0 else ""
    (folder / "nginx.conf").write_text(
        f"{user}daemon off;\npid {folder}/nginx.pid;\nerror_log {folder}/error.log;\n"
        f"events {{}}\nhttp {{\naccess_log off;\n{temporary}{text}\n}}\n")


def wait_for_port(port, process):
    for _ in range(300):
        if process.poll() is not None:
            return False
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return True
        time.sleep(0.05)
    return False


class Proxied:
    """One connection through nginx, which presents a certificate for NAME."""

    def __init__(self, folder, source="127.0.0.1"):
        self.trust = ssl.create_default_context(cafile=folder / "cert.pem")
        raw = socket.create_connection(("127.0.0.1", PORT), 60, (source, 0))
        self.connection = http.client.HTTPConnection(NAME, timeout=60)
        self.connection.sock = self.trust.wrap_socket(raw, server_hostname=NAME)

    def ask(self, method, path, headers=(), body=None):
        self.connection.request(method, path, body, dict(headers))
        answer = self.connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()


def stored_by_nginx(folder):
    return sum(file.stat().st_size for file in (folder / "temp").rglob("*") if file.is_file())


def resident_kib(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1])


def upload_large(folder, key, data, service):
    """Sends LARGE bytes that are no DEM, and looks at what is where on the way."""
    client = Proxied(folder).connection
    before = resident_kib(service)
    client.putrequest("POST", "/jobs?filename=large.tif")
    for name, value in (("Authorization", f"Bearer {key}"), ("Content-Type", "image/tiff"),
                        ("Content-Length", str(LARGE))):
        client.putheader(name, value)
    client.endheaders()
    piece = b"II*\0" + bytes((1 << 20) - 4)
    half = 0
    for i in range(LARGE >> 20):
        client.send(piece)
        if i == (LARGE >> 21):
            time.sleep(0.3)
            half = sum(file.stat().st_size for file in (data / "spool").iterdir())
    answer = client.getresponse()
    code = json.loads(answer.read())["code"]
    return answer.status, code, half, stored_by_nginx(folder), resident_kib(service) - before


def refuse_large(folder):
    """How much of LARGE bytes a client without a key sends before it is told."""
    client = Proxied(folder).connection
    client.putrequest("POST", "/jobs")
    client.putheader("Content-Type", "image/tiff")
    client.putheader("Content-Length", str(LARGE))
    client.endheaders()
    sent = 0
    while sent < LARGE and not select.select([client.sock], [], [], 0)[0]:
        client.sock.sendall(bytes(1 << 16))
        sent += 1 << 16
    return client.getresponse().status, sent


def check_all(folder, data, service):
    make = [FARHORIZON, "keys", "add", "--data", str(data), "--name", "proxy"]
    key = subprocess.run(make, check=True, capture_output=True, text=True).stdout.strip()
    bearer = {"Authorization": f"Bearer {key}"}

    status, head, _ = Proxied(folder).ask("GET", "/jobs")
    check("no key: 401 and its challenge pass through", status == 401
          and head.get("WWW-Authenticate") == 'Bearer realm="farhorizon"', status)
    status, _, body = Proxied(folder).ask("GET", "/jobs", bearer)
    links = json.loads(body).get("links", [{}]) if status == 200 else [{}]
    check("a key: 200, and links begin with the public URL",
          links[0].get("href", "").startswith(f"https://{NAME}/jobs"), links[0].get("href"))
    check("/healthz is for everybody", Proxied(folder).ask("GET", "/healthz")[0] == 200)
    check("/metrics is not for those outside", Proxied(folder).ask("GET", "/metrics", bearer)[0] == 404)

    dem = (ROOT / "tests/data/jacksboro_fault_dem.tif").read_bytes()
    status, head, body = Proxied(folder).ask(
        "POST", "/jobs?levels=1&tileTriangles=0", bearer | {"Content-Type": "image/tiff"}, dem)
    job = json.loads(body).get("jobID", "")
    check("a DEM: 201 and a Location of the public URL",
          status == 201 and head.get("Location") == f"https://{NAME}/jobs/{job}", head.get("Location"))
    for _ in range(600):
        if json.loads(Proxied(folder).ask("GET", f"/jobs/{job}", bearer)[2])["status"] != "running":
            state = json.loads(Proxied(folder).ask("GET", f"/jobs/{job}", bearer)[2])["status"]
            if state != "accepted":
                break
        time.sleep(0.2)
    check("its job ends", state == "successful", state)
    path = f"/jobs/{job}/results/lod0.glb"
    status, head, whole = Proxied(folder).ask("GET", path, bearer)
    part, _, bytes_10_to_19 = Proxied(folder).ask("GET", path, bearer | {"Range": "bytes=10-19"})
    check("a result, and a range of it", (status, part) == (200, 206)
          and whole[:4] == b"glTF" and bytes_10_to_19 == whole[10:20], f"{len(whole)} bytes")
    ticket = json.loads(Proxied(folder).ask("POST", f"/jobs/{job}/ticket", bearer)[2])["ticket"]
    check("a link with a ticket opens without a key",
          Proxied(folder).ask("GET", f"{path}?ticket={ticket}")[0] == 200)

    status, code, half, stored, grown = upload_large(folder, key, data, service)
    check("a large body reaches the service while it is being sent",
          half >= LARGE // 4, f"{half >> 20} MiB of {LARGE >> 20} after half of it")
    check("nginx stores nothing of it, the service holds little in memory",
          stored == 0 and grown < 32 << 10, f"{stored} bytes, {grown} KiB")
    check("and is answered by the service", status in (415, 422), f"{status} {code}")
    told = [refuse_large(folder) for _ in range(5)]
    check("without a key its sender is told long before the end, five times of five",
          all(status == 401 and sent < LARGE // 4 for status, sent in told),
          ", ".join(f"{status} after {sent >> 10} KiB" for status, sent in told))

    for source, headers in (("127.0.0.5", {}), ("127.0.0.6", {"X-Forwarded-For": "198.51.100.7"})):
        mark = f"from-{source}"
        Proxied(folder, source).ask("GET", "/jobs", bearer | headers | {"X-Request-Id": mark})
        direct = http.client.HTTPConnection("127.0.0.1", SERVICE_PORT, 60, (source, 0))
        direct.request("GET", "/jobs", headers=bearer | {"X-Forwarded-For": "198.51.100.7",
                                                        "X-Request-Id": f"direct-{source}"})
        direct.getresponse().read()
    time.sleep(0.5)
    lines = [json.loads(line) for line in (folder / "log").read_text().splitlines()]
    peers = {line.get("request_id"): line.get("peer") for line in lines}
    check("the log has the address of the client behind nginx",
          peers.get("from-127.0.0.5") == "127.0.0.5", peers.get("from-127.0.0.5"))
    check("and not the one that the client claims", peers.get("from-127.0.0.6") == "127.0.0.6",
          peers.get("from-127.0.0.6"))
    check("nobody else names an address", peers.get("direct-127.0.0.5") == "127.0.0.5",
          peers.get("direct-127.0.0.5"))
    check("the log has no key", key[16:] not in (folder / "log").read_text())


def main():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="farhorizon-proxy-"))
    started = []
    try:
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                        "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", f"/CN={NAME}",
                        "-addext", f"subjectAltName=DNS:{NAME}", "-keyout", folder / "key.pem",
                        "-out", folder / "cert.pem"], check=True, capture_output=True)
        nginx_configuration(folder)
        settings = {"FARHORIZON_PUBLIC_URL": f"https://{NAME}",
                    "FARHORIZON_HTTP_TRUSTED_PROXIES": "127.0.0.1", "FARHORIZON_LOG_FORMAT": "json"}
        data = folder / "data"
        with open(folder / "log", "wb") as log:
            service = subprocess.Popen(
                [FARHORIZON, "serve", "--listen", f"127.0.0.1:{SERVICE_PORT}", "--data", data],
                env=os.environ | settings, stderr=log)
        started.append(service)
        nginx = subprocess.Popen(["nginx", "-p", folder, "-c", folder / "nginx.conf"],
                                 stderr=subprocess.PIPE, env=os.environ | {
                                     "PATH": os.environ["PATH"] + ":/usr/sbin"})
        started.append(nginx)
        if wait_for_port(SERVICE_PORT, service) and wait_for_port(PORT, nginx):
            check_all(folder, data, service)
        else:
            check("service and nginx start", False, (folder / "log").read_text()[-500:])
            if nginx.poll() is not None:
                print(nginx.stderr.read().decode())
    finally:
        for process in reversed(started):
            process.send_signal(signal.SIGTERM)
            process.wait(30)
        shutil.rmtree(folder, ignore_errors=True)
    print(f"{failed} failed" if failed else "All passed")
    return 1 if failed else 0


sys.exit(main())
