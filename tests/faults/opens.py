"""What the service and its children open and connect to while uploads and parameters name files of others.

strace writes every open, connect and exec down. After the start nothing may be opened but the data folder and what
the system's libraries, GDAL and PROJ read from their own folders; what a hostile upload names may not even be tried.
"""
import os
import re
import struct
import urllib.parse

from service import Service, small_dem
from verdict import Verdict

CALLS = "open,openat,openat2,creat,connect,execve,execveat,stat,lstat,newfstatat,statx,access,faccessat,faccessat2"
ALLOWED = ("/usr/lib", "/lib", "/usr/share/proj", "/usr/share/gdal", "/usr/share/zoneinfo", "/etc/ld.so.cache",
           "/etc/localtime", "/dev/", "/proc/", "/sys/",
           "/usr/etc/ld.so.cache", "/usr/dev/")  # of a child's own root while it is made


def tiff(items: list[tuple[str, str, str]]) -> bytes:
    """A grid of 12 x 12 heights on WGS 84 with (domain, name, value) in GDAL's metadata."""
    side = 12
    text = "".join(f'<Item name="{name}" domain="{domain}">{value}</Item>' for domain, name, value in items)
    blobs = {
        273: struct.pack(f"<{side * side}f", *(100 + 7 * i % 31 for i in range(side * side))),
        33550: struct.pack("<3d", .001, .001, 0),
        33922: struct.pack("<6d", 0, 0, 0, 10, 46, 0),
        34735: struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326),
        42112: f"<GDALMetadata>{text}</GDALMetadata>".encode() + b"\0",
    }
    short, long, double, ascii_ = 3, 4, 12, 2
    fields = [(256, short, 1, side), (257, short, 1, side), (258, short, 1, 32), (259, short, 1, 1),
              (262, short, 1, 1), (273, long, 1, None), (277, short, 1, 1), (278, short, 1, side),
              (279, long, 1, 4 * side * side), (339, short, 1, 3), (33550, double, 3, None),
              (33922, double, 6, None), (34735, short, 16, None), (42112, ascii_, len(blobs[42112]), None)]
    at = 8 + 2 + 12 * len(fields) + 4
    directory, data = b"", b""
    for tag, kind, count, value in fields:
        if value is None:
            value = at + len(data)
            data += blobs[tag] + bytes(len(blobs[tag]) % 2)
        directory += struct.pack("<HHII", tag, kind, count, value)
    return b"II*\0" + struct.pack("<IH", 8, len(fields)) + directory + bytes(4) + data


def uploads(named: str) -> dict[str, bytes]:
    """Files that ask for `named` to be opened."""
    vrt = (f'<VRTDataset rasterXSize="9" rasterYSize="9"><VRTRasterBand dataType="Byte" band="1" '
           f'subClass="VRTRawRasterBand"><SourceFilename relativeToVRT="0">{named}</SourceFilename>'
           '</VRTRasterBand></VRTDataset>')
    return {
        "a VRT": vrt.encode(),
        "overviews elsewhere": tiff([("OVERVIEWS", "OVERVIEW_FILE", named)]),
        "overviews in an archive": tiff([("OVERVIEWS", "OVERVIEW_FILE", f"/vsizip/{named}/x.tif")]),
        "overviews in a VRT": tiff([("OVERVIEWS", "OVERVIEW_FILE", vrt.replace("<", "&lt;"))]),
        "overviews on the network": tiff([("OVERVIEWS", "OVERVIEW_FILE", "/vsicurl/http://127.0.0.1:9/x.tif")]),
        "overviews in memory": tiff([("OVERVIEWS", "OVERVIEW_FILE", "MEM:::DATAPOINTER=1,PIXELS=9,LINES=9")]),
        "a geolocation elsewhere": tiff([("GEOLOCATION", "X_DATASET", named), ("GEOLOCATION", "Y_DATASET", named),
                                         ("GEOLOCATION", "X_BAND", "1"), ("GEOLOCATION", "Y_BAND", "1")]),
        "a mask elsewhere": tiff([("", "INTERNAL_MASK_FLAGS_1", "2"), ("xml:VRT", "SourceFilename", named)]),
    }


def parameters(named: str) -> list[str]:
    return [f"crs={value}" for value in
            (urllib.parse.quote(text, safe="") for text in
             (named, "file://" + named, "http://127.0.0.1:9/crs", f"+proj=longlat +nadgrids={named}",
              f"+proj=longlat +nadgrids=@{named}", f"+init={named}:1", f"+proj=longlat +geoidgrids={named}",
              f"+proj=pipeline +step +proj=hgridshift +grids={named}"))] + [
                  "crs=EPSG:4326&verticalDatum=" + urllib.parse.quote(f"+geoidgrids={named}", safe=""),
                  "crs=EPSG:4326&datumOperation=" + urllib.parse.quote(named, safe="")]


def offences(log: str, begin: int, data: str, named: str) -> list[str]:
    """The calls after `begin` bytes of the log that no upload should bring about."""
    found = []
    with open(log, encoding="utf-8", errors="replace") as lines:
        lines.seek(begin)
        for line in lines:
            call = re.search(r"(\w+)\(", line)
            if not call:
                continue
            if named in line or "AF_INET" in line or "/tmp/proj" in line or "exec" in call[1]:
                found.append(line.strip())
            opened = re.search(r"= \d+<([^>]*)>", line)
            if opened and not opened[1].startswith((data, *ALLOWED)) and opened[1].startswith("/"):
                found.append(line.strip())
        return found


def run(folder: str, verdict: Verdict, options) -> None:
    named = os.path.join(folder, "of-another-user.tif")
    with open(named, "wb") as file:
        file.write(tiff([]))
    home = os.path.join(folder, "home")
    os.makedirs(home + "/.local/share/proj")
    log = os.path.join(folder, "opened")
    service = Service(os.path.join(folder, "traced"), workers=1,
                      wrap=("strace", "-f", "-y", "-s", "4096", "-o", log, "-e", "trace=" + CALLS),
                      environment={"HOME": home, "XDG_DATA_HOME": home, "PROJ_DATA": folder, "GDAL_DATA": folder})
    service.start(60)
    # A first job loads what is loaded once.
    service.wait(service.submit(small_dem(1))[1]["jobID"])
    warm = os.path.getsize(log)
    for what, body in uploads(named).items():
        begin = os.path.getsize(log)
        status, document = service.submit(body, "?levels=1&filename=dem.tif&verticalDatum=ellipsoid&heightUnit=m")
        ended = service.wait(document["jobID"])["status"] if status == 201 else document.get("code")
        wrong = offences(log, begin, service.data, named)
        with open(log, encoding="utf-8", errors="replace") as lines:
            lines.seek(begin)
            if status == 201 and "/in/dem.tif" not in lines.read():
                wrong.append("the upload itself is not in the record")
        verdict.ask(f"{what}: nothing else is opened", not wrong and (status == 201) == (what != "a VRT"),
                    wrong[:2] or f"{status} {ended}")
    refused, wrong = 0, []
    for query in parameters(named):
        begin = os.path.getsize(log)
        status, _ = service.submit(small_dem(1), f"?levels=1&filename=dem.asc&{query}")
        refused += status in (400, 422)
        wrong += offences(log, begin, service.data, named)
    asked = len(parameters(named))
    verdict.ask(f"{asked} parameters that name files: refused, none opened", refused == asked and not wrong,
                wrong[:2] or f"{refused} refused")
    with open(log, encoding="utf-8", errors="replace") as lines:
        lines.seek(warm)
        # Of those who open it, only SQLite follows no link; PROJ looks whether it is there.
        again = [line.strip() for line in lines if re.search(r"proj\.db.*O_NOFOLLOW", line)]
    verdict.ask("no child opens the database of reference systems anew", not again, again[:2] or "")
    service.stop()
