"""OWSLib against a service: owslib_client.py BASE. Fails on what it does not find."""
import sys

import owslib
from owslib.ogcapi.processes import Processes

service = Processes(sys.argv[1])
api = service.api()
assert api["openapi"].startswith("3.0"), api["openapi"]
assert "/processes/{id}/execution" in api["paths"], sorted(api["paths"])
classes = service.conformance()["conformsTo"]
assert any(name.endswith("/conf/oas30") for name in classes), classes
names = [process["id"] for process in service.processes()["processes"]]
assert names == ["terrain-lod", "echo"], names
terrain = service.process("terrain-lod")
assert "dem" in terrain["inputs"] and "tileset.json" in terrain["outputs"], terrain.keys()
try:
    service.process("none")
except RuntimeError as refused:
    assert "no-such-process" in str(refused), refused
else:
    raise AssertionError("there is a process none")
print(f"OWSLib {owslib.__version__}: {len(api['paths'])} paths, {len(classes)} classes, processes {', '.join(names)}")
