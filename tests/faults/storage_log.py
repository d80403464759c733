"""What a service did to the files below its data folder, from strace, and what a power cut may leave of it.

The model is POSIX without the favours of any file system: what a file holds is certain as far as a sync of that file
has ended, an entry of a folder as far as a sync of that folder has. Of all else any part may be there, in sectors of
512 bytes, and a rename from one folder to another is two entries. Files that are mapped are not seen (the index of
the write-ahead log, which SQLite makes anew).
"""
import os
import re
from dataclasses import dataclass, field
from typing import Callable

CHANGES = ("openat", "open", "creat", "write", "writev", "pwrite64", "pwritev", "pwritev2", "ftruncate", "truncate",
           "fallocate", "fsync", "fdatasync", "rename", "renameat", "renameat2", "link", "linkat", "symlink",
           "symlinkat", "unlink", "unlinkat", "mkdir", "mkdirat", "rmdir", "copy_file_range", "sendfile", "splice")
SECTOR = 512


def strace(log: str) -> tuple[str, ...]:
    """The words before a command that record it into `log`."""
    return ("strace", "-f", "-y", "-ttt", "-xx", "-s", "1000000000", "-o", log, "-e", "trace=" + ",".join(CHANGES))


@dataclass(eq=False)
class Node:
    """A file or a folder. changes: of a file (offset, bytes) or (size, None), of a folder (name, node or None); those
    before `synced` are certain."""
    folder: bool
    mode: int
    changes: list = field(default_factory=list)
    synced: int = 0
    entries: dict = field(default_factory=dict)  # of a folder, as they are
    position: int = 0  # of a file that is written from its begin to its end

    def enter(self, name: str, node: "Node | None") -> None:
        self.changes.append((name, node))
        if node:
            self.entries[name] = node
        else:
            self.entries.pop(name, None)


@dataclass
class Call:
    begun: float
    name: str
    words: list[str]
    result: str


def decoded(text: str) -> bytes:
    return bytes.fromhex(text.replace("\\x", ""))


def calls(log: str):
    """The calls of a log that succeeded, in the order in which they ended."""
    begun: dict[str, tuple[float, str]] = {}
    with open(log, encoding="ascii") as lines:
        for line in lines:
            thread, time, text = line.rstrip("\n").split(maxsplit=2)
            at = float(time)
            if text.endswith("<unfinished ...>"):
                begun[thread] = (at, text[:-len("<unfinished ...>")].rstrip())
                continue
            if resumed := re.match(r"<\.\.\. \w+ resumed>", text):
                at, start = begun.pop(thread)
                text = start + text[resumed.end():]
            if found := re.match(r"(\w+)\((.*)\)\s+= (\d+.*)", text):
                yield Call(at, found[1], found[2].split(", "), found[3])


class Storage:
    """The tree below a data folder, and how it came to be."""

    def __init__(self, data: str):
        self.data = data.encode()
        self.root = Node(folder=True, mode=0o700)

    def inside(self, word: str, at: str | None = None) -> list[str] | None:
        """The names on the way to a path, which may be given with a folder's descriptor; None outside the data."""
        quoted = re.search(r'"([^"]*)"', word)
        opened = re.search(r"<([^>]*)>", word)
        path = decoded(quoted[1] if quoted else opened[1]) if quoted or opened else b""
        if at and not path.startswith(b"/"):
            path = decoded(re.search(r"<([^>]*)>", at)[1]) + b"/" + path
        if not path.startswith(self.data + b"/"):
            return [] if path == self.data else None
        return os.path.normpath(path[len(self.data) + 1:].decode()).split("/")

    def find(self, names: list[str] | None) -> Node | None:
        node = None if names is None else self.root
        for name in names or ():
            node = node.entries.get(name) if node else None
        return node

    def make(self, names: list[str] | None, node: Node) -> None:
        if names and not self.find(names) and (parent := self.find(names[:-1])):
            parent.enter(names[-1], node)

    def drop(self, names: list[str] | None) -> None:
        if names and self.find(names):
            self.find(names[:-1]).enter(names[-1], None)

    def apply(self, call: Call) -> bool:
        """Whether the call has changed anything below the data folder, or made a change certain."""
        words = call.words
        if call.name in ("openat", "open"):
            return self.open(call)
        if call.name in ("mkdir", "rmdir", "unlink"):
            names = self.inside(words[0])
        elif call.name in ("unlinkat", "mkdirat"):
            names = self.inside(words[1], words[0])
        elif call.name in ("rename", "link"):
            return self.move(self.inside(words[0]), self.inside(words[1]), call.name == "rename")
        else:
            return self.write(call, self.find(self.inside(words[0])))
        if names is None:
            return False
        if call.name.startswith("mkdir"):
            self.make(names, Node(folder=True, mode=0o700))
        else:
            self.drop(names)
        return True

    def open(self, call: Call) -> bool:
        flags = call.words[2 if call.name == "openat" else 1]
        names = self.inside(call.result)
        if not names or not re.search("O_WRONLY|O_RDWR", flags):
            return False
        node = self.find(names)
        if not node and "O_CREAT" in flags:
            node = Node(folder=False, mode=int(call.words[-1], 8))
            self.make(names, node)
        elif node and "O_TRUNC" in flags:
            node.changes.append((0, None))
        if node:
            node.position = 0
        return node is not None

    def move(self, source: list[str] | None, target: list[str] | None, away: bool) -> bool:
        node = self.find(source)
        if not node or not target:
            return False
        self.find(target[:-1]).enter(target[-1], node)
        if away:
            self.drop(source)
        return True

    def write(self, call: Call, node: Node | None) -> bool:
        if node is None:
            return False
        words = call.words
        if call.name in ("fsync", "fdatasync"):
            node.synced = len(node.changes)
        elif call.name in ("write", "pwrite64"):
            data = decoded(re.search(r'"([^"]*)"', words[1])[1])[:int(call.result)]
            offset = int(words[3]) if call.name == "pwrite64" else node.position
            node.changes.append((offset, data))
            node.position = offset + len(data)
        elif call.name == "ftruncate":
            node.changes.append((int(words[1]), None))
        elif call.name == "fallocate":
            node.changes.append((int(words[2]) + int(words[3]) - 1, b"\0"))
        else:
            raise RuntimeError(f"a file is changed by {call.name}, which the record of storage does not follow")
        return True


def rebuild(root: Node, folder: str, stays: Callable[[Node], bool]) -> None:
    """Writes what a power cut leaves below `root` into `folder`. stays: whether a change of a node that is not certain
    is there; asked for each sector of what is written to a file, and for each entry of a folder."""
    made: dict[Node, str] = {}  # links of one file
    pending = [(root, folder)]
    while pending:
        node, path = pending.pop()
        if not node.folder:
            if node in made:
                os.link(made[node], path)
            else:
                made[node] = path
                with open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, node.mode & 0o700), "wb") as file:
                    file.write(contents(node, stays))
            continue
        os.mkdir(path, 0o700)
        entries: dict[str, Node] = {}
        for number, (name, entry) in enumerate(node.changes):
            if number >= node.synced and not stays(node):
                continue
            if entry:
                entries[name] = entry
            else:
                entries.pop(name, None)
        pending += [(entry, os.path.join(path, name)) for name, entry in entries.items()]


def contents(node: Node, stays: Callable[[Node], bool]) -> bytes:
    held = bytearray()
    for number, (offset, data) in enumerate(node.changes):
        certain = number < node.synced
        if data is None:
            if certain or stays(node):
                held = held[:offset] + bytes(max(0, offset - len(held)))
            continue
        while data:
            piece = data[:SECTOR - offset % SECTOR]
            if certain or stays(node):
                held += bytes(max(0, offset + len(piece) - len(held)))
                held[offset:offset + len(piece)] = piece
            offset += len(piece)
            data = data[len(piece):]
    return bytes(held)
