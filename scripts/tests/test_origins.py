import json
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

from nbrdf_jax import data, origins
from nbrdf_jax.fitted_library import Entry, Provenance, write
from nbrdf_jax.invalid import InvalidFile

FOLDER = data.REPOSITORY / "nbrdf-core" / "assets" / "shared"


def test_files_are_called_by_as_many_folders_as_tell_them_apart():
    called = origins.told_apart([Path("/a/x/l.zip"), Path("/b/x/l.zip"), Path("/b/y/l.zip"), Path("/b/m.zip"), Path("/b/m.zip")])
    assert list(called.values()) == ["a/x/l.zip", "b/x/l.zip", "y/l.zip", "m.zip"]


def test_published_files_are_known_by_their_checksum_as_the_program_knows_them():
    rows = {row["file"]: row for row in json.loads((FOLDER / "manifest.json").read_text())["derived_from"]}
    for row in rows.values():
        assert origins.PUBLISHED[row["sha256"]] == (row["source"], row["terms"])
    files = [path for path in [*map(data.archive, data.ARCHIVES), *(data.folder() / "rgl_measured").glob("*.bsdf")] if path.is_file()]
    if not files:
        pytest.skip("PUBLISHED DATA MISSING: set NBRDF_DATA to its folder")
    for path in files:
        (row,) = origins.derived(path, "called")
        assert row["file"] == "called" and "ask" not in row["terms"] and ("MERL" in row["terms"]) == (path.suffix == ".zip"), path.name


def test_a_library_brings_the_sources_of_its_networks(tmp_path):
    first, *before = origins.derived(FOLDER / "library.safetensors", "start")
    assert first["file"] == "start" and [row["file"] for row in before] == ["merl_nbrdf.zip", "rgl_nbrdf_subset.zip"]
    entry = Entry("a", "a.binary", np.zeros(675), {"log_error": 0.0})
    write(tmp_path, np.zeros(675), [entry], Provenance("Mine", "c", 0, before), [])
    assert origins.derived(tmp_path / "library.safetensors", "mine")[1:] == before
    save_file({"a": np.ones(675, np.float32)}, tmp_path / "library.safetensors")
    with pytest.raises(InvalidFile, match="that of others"):
        origins.derived(tmp_path / "library.safetensors", "mine")
    # A network that lies in the same folder is not of the library.
    save_file({"a": np.ones(675, np.float32)}, tmp_path / "a.safetensors")
    assert [row["terms"] for row in origins.derived(tmp_path / "a.safetensors", "a")] == ["ask who made it"]


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"derived_from": [{}]}'])
def test_a_manifest_that_is_none_is_named(text, tmp_path):
    save_file({"a": np.ones(675, np.float32)}, tmp_path / "library.safetensors")
    (tmp_path / "manifest.json").write_text(text)
    with pytest.raises(InvalidFile, match="manifest.json"):
        origins.derived(tmp_path / "library.safetensors", "mine")


def test_of_anything_else_one_has_to_ask_and_a_tensor_file_says_what_it_is(tmp_path):
    (tmp_path / "a.binary").write_bytes(b"a")
    (row,) = origins.derived(tmp_path / "a.binary", "a")
    assert (row["source"], row["terms"]) == ("not known to this program", "ask who made it")
    assert row["sha256"] == "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb"
    (row,) = origins.derived(data.REPOSITORY / "tests" / "golden" / "brushed.bsdf", "b")
    assert row["source"].startswith("not known to this program; the file says of itself: ") and row["terms"] == "ask who made it"
