"""A job by a resumable upload, whatever is killed meanwhile: what a 204 acknowledges stays."""
import http.client
import json
import random
import time

TUS = {"Tus-Resumable": "1.0.0"}
BROKEN = (OSError, http.client.HTTPException)
# As service.QUERY has it.
INPUTS = {"crs": "EPSG:4326", "levels": 1, "filename": "dem.asc"}
BUSY = (429, 503, 507)


def patiently(ask):
    """The first answer of ask() that is not that the service is away, within some minutes."""
    for _ in range(400):
        try:
            answer = ask()
            if answer[0] not in BUSY:
                return answer
        except BROKEN:
            pass
        time.sleep(.05)
    return 0, {}, b""


def upload(service, history, rng: random.Random, dem: bytes) -> str | None:
    """Sends a DEM in pieces; the path of the upload. A broken request may have stored some of its bytes, so after each
    one the offset is asked for, which never is below what was acknowledged."""
    status, fields, _ = patiently(lambda: service.request(
        "POST", "/uploads", None, {**TUS, "Upload-Length": str(len(dem)), "Content-Length": "0"}, 15))
    if status != 201:
        history.violated(f"a POST of an upload was answered {status}")
        return None
    path = "/uploads/" + fields["location"].rsplit("/", 1)[1]
    acknowledged = offset = 0
    while offset < len(dem):
        piece = dem[offset:offset + rng.randint(1, len(dem))]
        headers = {**TUS, "Upload-Offset": str(offset), "Content-Type": "application/offset+octet-stream"}
        try:
            status, fields, _ = service.request("PATCH", path, piece, headers, 15)
            history.count(f"PATCH {status}")
        except BROKEN:
            status = 0
        if status == 204:
            acknowledged = int(fields["upload-offset"])
        elif status not in (0, 409, *BUSY):
            history.violated(f"a PATCH was answered {status}")
            return None
        status, fields, _ = patiently(lambda: service.request("HEAD", path, None, TUS, 15))
        if status != 200 or int(fields["upload-offset"]) < acknowledged:
            history.violated(f"I8: of {acknowledged} acknowledged bytes HEAD says {status} {fields.get('upload-offset')}")
            return None
        offset = int(fields["upload-offset"])
    return path


def submit(service, path: str, key: str | None) -> tuple[int, dict]:
    """(status, document) of a job of the upload. Raises as Service.request."""
    headers = {"Content-Type": "application/json"}
    if key:
        headers["Idempotency-Key"] = f'"{key}"'
    body = json.dumps({"inputs": {"dem": {"href": path}, **INPUTS}}).encode()
    status, _, answer = service.request("POST", "/jobs", body, headers, 15)
    return status, json.loads(answer)
