import subprocess
import sys

import pytest

from nbrdf_jax import other_load
from nbrdf_jax.other_load import OtherLoad


@pytest.fixture
def busy(tmp_path, monkeypatch):
    """Sets what the system says of its cores: hundredths of seconds of user time and of a host's other guests."""
    monkeypatch.setattr(other_load, "STAT", tmp_path / "stat")
    return lambda user, steal: (tmp_path / "stat").write_text(f"cpu  {user} 0 0 900 50 0 0 {steal} 0 0\ncpu0 1 2 3\n")


def test_what_others_and_the_host_take_counts_and_what_one_runs_oneself_does_not(busy, monkeypatch):
    clock = iter([10.0, 20.0])
    monkeypatch.setattr(other_load.time, "perf_counter", lambda: next(clock))
    monkeypatch.setattr(other_load.os, "sysconf", lambda name: 100)
    spent = iter([1.0, 5.0])
    monkeypatch.setattr(other_load, "_own", lambda: next(spent))
    busy(1000, 100)
    with OtherLoad() as other:
        busy(1600, 200)
    # 7 seconds in 10, 4 of them one's own.
    assert other.cores == pytest.approx(0.3)


def test_programs_that_are_waited_for_are_ones_own(busy):
    before = other_load._own()
    subprocess.run([sys.executable, "-c", "sum(i * i for i in range(10**6))"], check=True)
    assert other_load._own() > before + 0.01


def test_where_the_system_says_nothing_nothing_is_known(tmp_path, monkeypatch):
    monkeypatch.setattr(other_load, "STAT", tmp_path / "none")
    with OtherLoad() as other:
        pass
    assert other.cores is None and other.before >= 0
