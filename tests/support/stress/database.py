"""A PostgreSQL server of one's own, on a socket in a folder; Debian's postgresql-15."""
import os
import pwd
import shutil
import signal
import subprocess
import tempfile

PROGRAMS = "/usr/lib/postgresql/15/bin"


def is_installed() -> bool:
    return os.access(f"{PROGRAMS}/initdb", os.X_OK)


class Database:
    """Durable only as far as the server's processes may end, not the machine."""

    def __init__(self) -> None:
        # No folder of the tests': the server's user may go into none of them.
        self.folder = tempfile.mkdtemp(prefix="farhorizon-database-")
        if os.geteuid() == 0:  # which PostgreSQL refuses to run as
            os.chown(self.folder, pwd.getpwnam("postgres").pw_uid, -1)
        self.run("initdb", "--auth=trust", "--no-sync", "--username=farhorizon", "--encoding=UTF8", "--locale=C", "-D",
                 f"{self.folder}/cluster")
        self.start()
        self.run("createdb", "-h", self.folder, "-U", "farhorizon", "farhorizon")
        self.url = f"postgresql:///farhorizon?user=farhorizon&host={self.folder}"

    def run(self, program: str, *words: str) -> str:
        command = (["runuser", "-u", "postgres", "--"] if os.geteuid() == 0 else []) + [f"{PROGRAMS}/{program}", *words]
        with open(f"{self.folder}/out", "w+", encoding="utf-8") as out:
            # A file, not a pipe: the server that pg_ctl leaves keeps it open.
            subprocess.run(command, check=True, cwd="/", stdin=subprocess.DEVNULL, stdout=out,
                           stderr=subprocess.STDOUT)
            out.seek(0)
            return out.read()

    def start(self) -> None:
        self.run("pg_ctl", "-D", f"{self.folder}/cluster", "-w", "-l", f"{self.folder}/server.log", "-o",
                 f"-k {self.folder} -c listen_addresses= -c fsync=off -c max_connections=300", "start")

    def stop(self, mode: str = "fast") -> None:
        """fast: connections are ended; immediate: as if it were killed."""
        self.run("pg_ctl", "-D", f"{self.folder}/cluster", "-w", "-m", mode, "stop")

    def remove(self) -> None:
        self.stop("immediate")
        shutil.rmtree(self.folder, ignore_errors=True)

    def processes(self) -> list[int]:
        """The server's first, then those that it has started."""
        with open(f"{self.folder}/cluster/postmaster.pid", encoding="ascii") as file:
            server = int(file.readline())
        with open(f"/proc/{server}/task/{server}/children", encoding="ascii") as children:
            return [server, *map(int, children.read().split())]

    def signal_all(self, number: int) -> None:
        for process in self.processes():
            try:
                os.kill(process, number)
            except ProcessLookupError:
                pass

    def freeze(self) -> None:
        self.signal_all(signal.SIGSTOP)

    def thaw(self) -> None:
        self.signal_all(signal.SIGCONT)

    def query(self, statement: str) -> list[list[str]]:
        rows = self.run("psql", "-h", self.folder, "-U", "farhorizon", "-XAt", "-F", "\t", "-c", statement, "farhorizon")
        return [row.split("\t") for row in rows.splitlines()]
