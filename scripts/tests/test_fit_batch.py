import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import load_file

import fit_batch
from nbrdf_jax import library, program, sample_sets
from nbrdf_jax.objective import STEP

SCRIPT = Path(fit_batch.__file__)


def fit(folder, *more):
    return fit_batch.main(["--synthetic", "3", "--steps", "200", "--chunk", "2", "-o", str(folder), *more])


def networks(folder) -> dict[str, np.ndarray]:
    return library.read(folder / "library.safetensors")


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fitted")
    assert fit(folder) == 0
    return folder


def test_fits_come_closer_and_are_told_with_their_errors(fitted, tmp_path):
    assert fit(tmp_path, "--steps", "1", "--sets", "2") == 0
    before, after = (json.loads((folder / "manifest.json").read_text())["materials"] for folder in (tmp_path, fitted))
    for first, last in zip(before, after):
        assert last["error"]["log_error"] < 0.5 * first["error"]["log_error"] and not last["held_out"] and last["database"] == "other"
    assert not (fitted / ".fit_batch").exists()


def test_a_stopped_run_goes_on_and_ends_as_if_it_had_not_been_stopped(fitted, tmp_path, monkeypatch):
    whole = fit_batch.fitted
    calls = []

    def stopped(*arguments):
        calls.append(1)
        if len(calls) > 1:
            raise KeyboardInterrupt
        return whole(*arguments)

    monkeypatch.setattr(fit_batch, "fitted", stopped)
    with pytest.raises(KeyboardInterrupt):
        fit(tmp_path)
    assert not (tmp_path / "manifest.json").exists() and (tmp_path / ".fit_batch" / "chunk-00000.safetensors").is_file()
    monkeypatch.setattr(fit_batch, "fitted", lambda *arguments: calls.append(1) or whole(*arguments))
    assert fit(tmp_path) == 0 and len(calls) == 3
    assert (tmp_path / "library.safetensors").read_bytes() == (fitted / "library.safetensors").read_bytes()


def test_parts_of_another_run_are_not_taken_for_ones_own(tmp_path, capsys):
    (tmp_path / ".fit_batch").mkdir()
    (tmp_path / ".fit_batch" / "job.json").write_text("{}")
    assert fit(tmp_path) == 3
    assert "another" in capsys.readouterr().err


def test_three_devices_find_what_one_finds(fitted, tmp_path):
    environment = os.environ | {"XLA_FLAGS": "--xla_force_host_platform_device_count=3"}
    command = [sys.executable, str(SCRIPT), "--synthetic", "3", "--steps", "200", "--chunk", "2", "-o", str(tmp_path), "--json"]
    done = json.loads(subprocess.run(command, env=environment, check=True, capture_output=True).stdout)
    assert done["devices"] == 3
    for name, weights in networks(fitted).items():
        assert np.allclose(weights, networks(tmp_path)[name], atol=2e-2), name


def test_sets_hold_what_a_step_asks_for_above_the_horizon():
    sets = sample_sets.SampleSets.drawn(0, 3)
    assert sets.factor.shape == (3, STEP.directions) and sets.inputs.shape == (3, STEP.directions, 6)
    assert min(sets.light[..., 2].min(), sets.view[..., 2].min()) > 0
    log, relative, pixels = sets.wanted(np.ones((3 * STEP.directions, 3)))
    assert (log.shape, relative.shape, pixels.shape) == ((3, STEP.log, 3), (3, STEP.relative, 3), (3, STEP.pixels, 3))
    assert sample_sets.worth(100) == 7 and sample_sets.worth(10**6) == sample_sets.MOST


@pytest.mark.skipif(not program.BUILT.is_file(), reason="the program is not built: cargo build --release")
def test_the_program_reads_what_was_fitted(fitted):
    listed = json.loads(subprocess.run([program.BUILT, "list", "--library", fitted, "--json"], check=True, capture_output=True).stdout)
    assert [row["name"] for row in listed["materials"]] == list(networks(fitted))
    assert set(load_file(fitted / "library.safetensors")) == {*networks(fitted), "@shared_start"}


@pytest.mark.parametrize("arguments", [["-o", "x"], ["--synthetic", "1", "--steps", "0", "-o", "x"]])
def test_what_makes_no_sense_is_a_usage_error(arguments):
    with pytest.raises(SystemExit) as stopped:
        fit_batch.main(arguments)
    assert stopped.value.code == 2
