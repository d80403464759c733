#!/usr/bin/env python3
"""A small S3-compatible server, for tests: a bucket is a folder, and an object appears whole, by a rename, as on S3.

    tests/support/s3_server.py FOLDER [PORT]

It writes its port to standard error, and serves until it is killed; what was answered 200 is there after the next start. It verifies
signatures (version 4) against the keys KEY_ID and SECRET, and the sums of bodies, as Amazon's does; knows
If-None-Match: *; and refuses buckets that are no folder of FOLDER. No other keys than of letters, digits and ._-/.

POST /-/faults sets what goes wrong from now on: {"status": 503, "code": "SlowDown", "share": 0.5} and, in place of the
status, "break": "request" or "answer" (the connection ends in the middle of the body), "flip": "request" or "answer" (a
bit of the body changes on its way), "stall": SECONDS (before each answer), "deny": CODE (403). "only": a text that the
method and path have to contain. {} ends the faults. GET /-/count says how many requests there were, by method.
"""
import base64
import collections
import hashlib
import hmac
import http.server
import json
import os
import random
import re
import socketserver
import sys
import threading
import time
import urllib.parse
import uuid
from xml.sax.saxutils import escape

KEY_ID = "test-key-id"
SECRET = "test/secret+of-the-store"
PLAIN = re.compile(r"[A-Za-z0-9._/-]+")


class Refused(Exception):
    """A request that ends with an error."""

    def __init__(self, status: int, code: str):
        super().__init__(code)
        self.status, self.code = status, code


def mac(key: bytes, text: str) -> bytes:
    return hmac.new(key, text.encode(), hashlib.sha256).digest()


def quoted(text: str) -> str:
    return urllib.parse.quote(text, safe="-_.~")


class Store:
    """Buckets below a folder; objects are files in "objects", named by their key with other slashes."""

    def __init__(self, folder: str):
        self.folder = folder
        self.lock = threading.Lock()
        self.faults: dict = {}
        self.count: collections.Counter = collections.Counter()

    def bucket(self, name: str) -> str:
        path = os.path.join(self.folder, name)
        if not PLAIN.fullmatch(name) or not os.path.isdir(path):
            raise Refused(404, "NoSuchBucket")
        for part in ("objects", "uploads", "temp"):
            os.makedirs(os.path.join(path, part), exist_ok=True)
        return path

    def object(self, bucket: str, key: str) -> str:
        if not PLAIN.fullmatch(key):
            raise Refused(400, "InvalidURI")
        return os.path.join(self.bucket(bucket), "objects", key.replace("/", "~"))

    def place(self, bucket: str, path: str, data: bytes, new: bool = False) -> None:
        temp = os.path.join(self.bucket(bucket), "temp", uuid.uuid4().hex)
        with open(temp, "wb") as file:
            file.write(data)
        with self.lock:
            if new and os.path.exists(path):
                os.remove(temp)
                raise Refused(412, "PreconditionFailed")
            os.rename(temp, path)

    def keys(self, bucket: str, prefix: str) -> list[str]:
        names = os.listdir(os.path.join(self.bucket(bucket), "objects"))
        return sorted(key for key in (name.replace("~", "/") for name in names) if key.startswith(prefix))

    def upload(self, bucket: str, key: str, number: str) -> str:
        path = os.path.join(self.bucket(bucket), "uploads", key.replace("/", "~") + "=" + number)
        if not PLAIN.fullmatch(number) or not os.path.isdir(path):
            raise Refused(404, "NoSuchUpload")
        return path


STORE: Store


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True  # else each answer would wait for the one before
    fault: dict = {}

    def log_message(self, *_) -> None:
        pass

    def serve(self) -> None:
        self.path_only, _, query = self.path.partition("?")
        self.query = dict(urllib.parse.parse_qsl(query, keep_blank_values=True))
        try:
            length = int(self.headers.get("Content-Length", "0"))
            if self.path_only.startswith("/-/"):
                return self.control(self.rfile.read(length))
            STORE.count[self.command] += 1
            self.fault = self.draw()
            if self.fault.get("break") == "request":
                self.rfile.read(length // 2)
                return self.cut()
            data = self.rfile.read(length)
            if len(data) < length:
                return self.cut()
            if self.fault.get("flip") == "request" and data:
                data = data[:-1] + bytes([data[-1] ^ 1])
            if "stall" in self.fault:
                time.sleep(self.fault["stall"])
            if "deny" in self.fault:
                raise Refused(403, self.fault["deny"])
            if "status" in self.fault:
                raise Refused(self.fault["status"], self.fault.get("code", "InternalError"))
            self.verify(data)
            _, bucket, key = (self.path_only + "/").split("/", 2)
            getattr(self, "on_" + self.command.lower())(bucket, key.rstrip("/"), data)
        except Refused as refused:
            self.answer(refused.status, f"<Error><Code>{refused.code}</Code><Message>of the test</Message></Error>")
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True

    do_GET = do_PUT = do_POST = do_DELETE = serve

    def draw(self) -> dict:
        fault = STORE.faults
        hit = fault.get("only", "") in f"{self.command} {self.path}" and random.random() < fault.get("share", 1)
        return fault if hit else {}

    def cut(self) -> None:
        self.close_connection = True
        self.connection.shutdown(2)

    def control(self, data: bytes) -> None:
        self.fault = {}
        if self.command == "POST":
            STORE.faults = json.loads(data)
        self.answer(200, json.dumps(STORE.count))

    def answer(self, status: int, body="", etag: str = "") -> None:
        data = body if isinstance(body, bytes) else body.encode()
        self.send_response(status)
        self.send_header("Content-Length", "0" if status == 204 else str(len(data)))
        if etag:
            self.send_header("ETag", f'"{etag}"')
        self.end_headers()
        if self.fault.get("flip") == "answer" and data:
            data = bytes([data[0] ^ 1]) + data[1:]
        if self.fault.get("break") == "answer":
            self.wfile.write(data[:len(data) // 2])
            return self.cut()
        self.wfile.write(data)

    def verify(self, data: bytes) -> None:
        """The signature, and the sums of the body."""
        found = re.fullmatch(r"AWS4-HMAC-SHA256 Credential=([^/]+)/(\d{8})/([^/]+)/s3/aws4_request, *"
                             r"SignedHeaders=([a-z0-9;-]+), *Signature=([0-9a-f]{64})",
                             self.headers.get("Authorization", ""))
        if not found:
            raise Refused(403, "AccessDenied")
        key_id, day, region, signed, signature = found.groups()
        if key_id != KEY_ID:
            raise Refused(403, "InvalidAccessKeyId")
        query = "&".join(sorted(f"{quoted(name)}={quoted(value)}" for name, value in self.query.items()))
        headers = "".join(f"{name}:{' '.join(self.headers.get(name, '').split())}\n" for name in signed.split(";"))
        said = self.headers.get("x-amz-content-sha256", "")
        canonical = "\n".join((self.command, self.path_only, query, headers, signed, said))
        scope = f"{day}/{region}/s3/aws4_request"
        text = "\n".join(("AWS4-HMAC-SHA256", self.headers.get("x-amz-date", ""), scope,
                          hashlib.sha256(canonical.encode()).hexdigest()))
        key = ("AWS4" + SECRET).encode()
        for part in (day, region, "s3", "aws4_request"):
            key = mac(key, part)
        if not hmac.compare_digest(mac(key, text).hex(), signature):
            raise Refused(403, "SignatureDoesNotMatch")
        if "host" not in signed.split(";") or "x-amz-content-sha256" not in signed.split(";"):
            raise Refused(403, "AccessDenied")
        if said != hashlib.sha256(data).hexdigest():
            raise Refused(400, "XAmzContentSHA256Mismatch")
        md5 = self.headers.get("Content-MD5")
        if md5 and base64.b64decode(md5) != hashlib.md5(data).digest():
            raise Refused(400, "BadDigest")

    def on_get(self, bucket: str, key: str, _) -> None:
        if key:
            try:
                with open(STORE.object(bucket, key), "rb") as file:
                    return self.answer(200, file.read())
            except FileNotFoundError as missing:
                raise Refused(404, "NoSuchKey") from missing
        if "uploads" in self.query:
            names = os.listdir(os.path.join(STORE.bucket(bucket), "uploads"))
            entries = "".join("<Upload><Key>{}</Key><UploadId>{}</UploadId></Upload>".format(
                *name.replace("~", "/").split("=")) for name in names)
            return self.answer(200, f"<ListMultipartUploadsResult>{entries}</ListMultipartUploadsResult>")
        keys = [key for key in STORE.keys(bucket, self.query.get("prefix", ""))
                if key > self.query.get("start-after", "")]
        page = keys[:1000]
        entries = "".join(f"<Contents><Key>{escape(key)}</Key></Contents>" for key in page)
        more = "true" if len(keys) > len(page) else "false"
        self.answer(200, f"<ListBucketResult><IsTruncated>{more}</IsTruncated>{entries}</ListBucketResult>")

    def on_put(self, bucket: str, key: str, data: bytes) -> None:
        etag = hashlib.md5(data).hexdigest()
        if "uploadId" in self.query:
            path = os.path.join(STORE.upload(bucket, key, self.query["uploadId"]), self.query["partNumber"])
            STORE.place(bucket, path, data)
            return self.answer(200, "", etag)
        source = self.headers.get("x-amz-copy-source")
        if source:
            try:
                with open(STORE.object(*source.strip("/").split("/", 1)), "rb") as file:
                    data = file.read()
            except FileNotFoundError as missing:
                raise Refused(404, "NoSuchKey") from missing
        STORE.place(bucket, STORE.object(bucket, key), data, self.headers.get("If-None-Match") == "*")
        self.answer(200, "<CopyObjectResult/>" if source else "", etag)

    def on_post(self, bucket: str, key: str, data: bytes) -> None:
        if "delete" in self.query:
            if "Content-MD5" not in self.headers:
                raise Refused(400, "InvalidRequest")
            for name in re.findall(r"<Key>([^<]*)</Key>", data.decode()):
                self.remove(bucket, name)
            return self.answer(200, "<DeleteResult/>")
        if "uploads" in self.query:
            STORE.object(bucket, key)
            number = uuid.uuid4().hex
            os.mkdir(os.path.join(STORE.bucket(bucket), "uploads", key.replace("/", "~") + "=" + number))
            return self.answer(200, "<InitiateMultipartUploadResult>"
                                    f"<UploadId>{number}</UploadId></InitiateMultipartUploadResult>")
        folder = STORE.upload(bucket, key, self.query.get("uploadId", ""))
        parts = re.findall(r"<PartNumber>(\d+)</PartNumber><ETag>\"([0-9a-f]+)\"</ETag>", data.decode())
        whole = []
        for number, etag in parts:
            with open(os.path.join(folder, number), "rb") as file:
                part = file.read()
            if hashlib.md5(part).hexdigest() != etag:
                raise Refused(400, "InvalidPart")
            whole.append(part)
        STORE.place(bucket, STORE.object(bucket, key), b"".join(whole))
        self.end_upload(folder)
        self.answer(200, "<CompleteMultipartUploadResult/>")

    def on_delete(self, bucket: str, key: str, _) -> None:
        if "uploadId" in self.query:
            self.end_upload(STORE.upload(bucket, key, self.query["uploadId"]))
        else:
            self.remove(bucket, key)
        self.answer(204)

    def remove(self, bucket: str, key: str) -> None:
        try:
            os.remove(STORE.object(bucket, key))
        except FileNotFoundError:
            pass

    def end_upload(self, folder: str) -> None:
        for part in os.listdir(folder):
            os.remove(os.path.join(folder, part))
        os.rmdir(folder)


class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = 128


def main() -> None:
    global STORE  # pylint: disable=global-statement
    STORE = Store(sys.argv[1])
    server = Server(("127.0.0.1", int(sys.argv[2]) if len(sys.argv) > 2 else 0), Handler)
    print(server.server_address[1], file=sys.stderr, flush=True)
    server.serve_forever()


if __name__ == "__main__":
    main()
