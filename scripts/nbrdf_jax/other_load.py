"""How much of the machine other programs take while something is measured."""

import os
import resource
import time
from pathlib import Path
from types import TracebackType

STAT = Path("/proc/stat")  # Linux; elsewhere nothing is known


class OtherLoad:
    """`with OtherLoad() as other:` around programs that are run and waited for; then `other.cores` and `other.before`."""

    cores: float | None = None  # that others kept busy meanwhile, on average; none where it cannot be told

    def __enter__(self) -> "OtherLoad":
        self.before = os.getloadavg()[0]  # processes that wanted to run in the minute before
        self._begin = time.perf_counter(), _busy(), _own()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        clock, busy, own = self._begin
        now = _busy()
        if busy is not None and now is not None:
            self.cores = max(now - busy - (_own() - own), 0.0) / max(time.perf_counter() - clock, 1e-3)


def _busy() -> float | None:
    """Seconds for which cores did anything, all together, also for other guests of the same host."""
    try:
        user, nice, system, _idle, _waiting, *rest = map(int, STAT.read_text().split("\n", 1)[0].split()[1:9])
    except (OSError, ValueError):
        return None
    return (user + nice + system + sum(rest)) / os.sysconf("SC_CLK_TCK")


def _own() -> float:
    """Seconds of this process and of those that it has waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(part.ru_utime + part.ru_stime for part in used)
