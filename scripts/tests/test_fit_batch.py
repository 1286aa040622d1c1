import json
import os
import subprocess
import sys

import numpy as np
import pytest
from safetensors.numpy import load_file, save_file

import fit_batch
from nbrdf_jax import fitted_library, library, program, sample_sets, sources
from nbrdf_jax.fitted_library import networks_metadata
from nbrdf_jax.objective import STEP
from nbrdf_jax.places import walked

COMMAND = ["--synthetic", "4", "--steps", "60", "--chunk", "2"]
needs_program = pytest.mark.skipif(not program.BUILT.is_file(), reason="the program is not built: cargo build --release")


def fit(folder, *more):
    return fit_batch.main([*COMMAND, "-o", str(folder), *more])


def networks(folder) -> dict[str, np.ndarray]:
    return library.read(folder / "library.safetensors")


def manifest(folder) -> dict:
    return json.loads((folder / "manifest.json").read_text())


def told(folder, *arguments) -> dict:
    """What the program says of a library."""
    return json.loads(subprocess.run([program.BUILT, *arguments, "--library", folder, "--json"], check=True, capture_output=True).stdout)


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fitted")
    assert fit(folder) == 0
    return folder


def test_fits_come_closer_than_their_start_and_are_told_with_their_errors(fitted):
    start = library.shared_start(fitted / "library.safetensors")
    for row, source in zip(manifest(fitted)["materials"], sources.synthetic(4, 0)):
        before = fit_batch.judged(source.load(), start, walked(True))
        assert row["error"]["log_error"] < 0.5 * before["log_error"] and not row["held_out"] and row["database"] == "other"
        assert row["error"] == pytest.approx(fit_batch.judged(source.load(), networks(fitted)[row["name"]], walked(True)), rel=1e-6)
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
    for name in ("library.safetensors", "manifest.json"):
        assert (tmp_path / name).read_bytes() == (fitted / name).read_bytes()


def test_parts_of_another_run_are_not_taken_for_ones_own(tmp_path, capsys):
    (tmp_path / ".fit_batch").mkdir()
    (tmp_path / ".fit_batch" / "job.json").write_text("{}")
    assert fit(tmp_path) == 3
    assert "another" in capsys.readouterr().err


def test_three_devices_find_what_one_finds(fitted, tmp_path):
    # Errors are another test's.
    code = f"import fit_batch; fit_batch.judged = lambda *pair: {{'log_error': 0.0}}; fit_batch.main({[*COMMAND, '-o', str(tmp_path), '--json']})"
    environment = os.environ | {"XLA_FLAGS": "--xla_force_host_platform_device_count=3", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = json.loads(subprocess.run([sys.executable, "-c", code], env=environment, check=True, capture_output=True).stdout)
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


@needs_program
def test_the_program_reads_what_was_fitted(fitted):
    listed = told(fitted, "list")
    assert [row["name"] for row in listed["materials"]] == list(networks(fitted))
    for row, written in zip(listed["materials"], manifest(fitted)["materials"]):
        assert row["error"] == pytest.approx(written["error"])
    assert set(load_file(fitted / "library.safetensors")) == {*networks(fitted), "@shared_start"}
    assert told(fitted, "info", "ggx-000001")["name"] == "ggx-000001"


@pytest.fixture
def two_libraries(tmp_path):
    """Files of one name in two folders, and another start."""
    random = np.random.default_rng(4)
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        save_file({folder: random.normal(0, 0.2, 675).astype(np.float32)}, tmp_path / folder / "library.safetensors", metadata=networks_metadata())
    start = {"@shared_start": random.normal(0, 0.2, 675).astype(np.float32)}
    save_file(start, tmp_path / "start.safetensors", metadata=networks_metadata())
    return tmp_path


def test_files_of_one_name_are_told_apart_and_the_command_has_all_that_changed_the_result(two_libraries, tmp_path, monkeypatch):
    monkeypatch.setattr(fit_batch, "judged", lambda *pair: {"log_error": 0.0})
    out, start = tmp_path / "out", tmp_path / "start.safetensors"
    arguments = [str(tmp_path / "one"), str(tmp_path / "two" / "library.safetensors"), "--start", str(start), "--steps", "2", "--sets", "3", "--seed", "5"]
    assert fit_batch.main([*arguments, "-o", str(out)]) == 0
    written = manifest(out)
    assert written["command"] == "scripts/fit_batch.py one/library.safetensors two/library.safetensors --start start.safetensors --steps 2 --sets 3 --chunk 128 --seed 5"
    assert [row["file"] for row in written["derived_from"]] == ["one/library.safetensors", "two/library.safetensors", "start.safetensors"]
    assert len({row["sha256"] for row in written["derived_from"]}) == 3
    assert [(row["name"], row["source_file"]) for row in written["materials"]] == [("one", "one/library.safetensors"), ("two", "two/library.safetensors")]
    assert str(tmp_path) not in (out / "manifest.json").read_text()
    if program.BUILT.is_file():
        assert [row["source_file"] for row in told(out, "list")["materials"]] == ["one/library.safetensors", "two/library.safetensors"]


def test_another_file_of_the_same_name_is_another_run(two_libraries, tmp_path, monkeypatch, capsys):
    def stopped(*arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(fit_batch, "fitted", stopped)
    command = [str(tmp_path / "one"), "--steps", "2", "-o", str(tmp_path / "out")]
    with pytest.raises(KeyboardInterrupt):
        fit_batch.main(command)
    (tmp_path / "one" / "library.safetensors").write_bytes((tmp_path / "two" / "library.safetensors").read_bytes())
    assert fit_batch.main(command) == 3 and "another" in capsys.readouterr().err


def test_what_no_library_could_hold_is_refused_before_anything_is_fitted(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(fitted_library, "MOST", 2)
    assert fit(tmp_path / "out") == 3 and "at most 2" in capsys.readouterr().err
    assert fit_batch.main([str(tmp_path / "none.binary"), "-o", str(tmp_path)]) == 3 and "none.binary" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["-o", "x"], ["--synthetic", "1", "--steps", "0", "-o", "x"]])
def test_what_makes_no_sense_is_a_usage_error(arguments):
    with pytest.raises(SystemExit) as stopped:
        fit_batch.main(arguments)
    assert stopped.value.code == 2
