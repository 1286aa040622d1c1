import json
import struct

import numpy as np
import pytest

from nbrdf_jax import data, library, merl, rgl, sources, tensor_file
from nbrdf_jax.coordinates import vectors_from_angles
from nbrdf_jax.invalid import InvalidFile

GOLDEN = data.REPOSITORY / "tests" / "golden"
MIDDLES = [(np.arange(count) + 0.5) / count for count in merl.CELLS]


def cells() -> tuple[np.ndarray, np.ndarray]:
    half, difference, turn = (grid.ravel() for grid in np.meshgrid(MIDDLES[0] ** 2 * np.pi / 2, MIDDLES[1] * np.pi / 2, MIDDLES[2] * np.pi, indexing="ij"))
    return vectors_from_angles(half, np.zeros_like(half), difference, turn)


def test_measured_tables_are_read_as_mitsuba_reads_them():
    if not (folder := data.folder() / "rgl_measured").is_dir():
        pytest.skip("PUBLISHED DATA MISSING: rgl_measured")
    golden = json.loads((GOLDEN / "rgl.json").read_text())
    light, view = np.array(golden["light"]), np.array(golden["view"])
    names = [name for name in golden["f"] if name != "brushed"]
    assert len(names) == 4
    for name in names:
        found = rgl.read(folder / f"{name}_rgb.bsdf")(light, view)
        assert np.allclose(found, golden["f"][name], rtol=1e-4, atol=1e-6), name


def test_a_material_that_changes_when_turned_is_refused():
    with pytest.raises(InvalidFile, match="isotropic"):
        rgl.read(GOLDEN / "brushed.bsdf")
    assert tensor_file.read(GOLDEN / "brushed.bsdf")["phi_i"].shape == (9,)


def test_broken_tensor_files_are_named(tmp_path):
    path = tmp_path / "x.bsdf"
    with pytest.raises(InvalidFile, match="no such file"):
        tensor_file.read(path)
    whole = (GOLDEN / "brushed.bsdf").read_bytes()
    for content in (b"", b"something else", whole[:40], whole[:5000]):
        path.write_bytes(content)
        with pytest.raises(InvalidFile, match="tensor file"):
            tensor_file.read(path)


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """A table that is smooth in all angles, with a gap."""
    light, view = cells()
    f = (0.2 + 0.1 * light[:, 2:] * view[:, 2:] + np.array([0.0, 0.1, 0.2])).reshape(*merl.CELLS, 3)
    stored = np.moveaxis(f / merl.SCALES, -1, 0).copy()
    stored[:, 40:43, 10, 5] = -1
    path = tmp_path_factory.mktemp("merl") / "paint.binary"
    path.write_bytes(struct.pack("<3i", *merl.CELLS) + stored.astype("<f8").tobytes())
    return path, f


def test_a_merl_table_gives_its_cells_back_and_fills_gaps(table):
    path, f = table
    read = merl.read(path)
    chosen = np.random.default_rng(4).integers(0, np.prod(merl.CELLS), 300)
    light, view = (vectors[chosen] for vectors in cells())
    assert np.allclose(read(light, view), f.reshape(-1, 3)[chosen], rtol=2e-3)
    assert (read.f > 0).all() and np.allclose(read.f[41, 10, 5], f[39, 10, 5])
    # Light and view exchanged are half a turn away, which the table does not tell apart.
    assert np.allclose(read(view, light), read(light, view), rtol=1e-9)


def test_what_is_no_merl_table_is_named(table, tmp_path):
    whole = table[0].read_bytes()
    path = tmp_path / "x.binary"
    for content, says in ((whole[:-8], "bytes"), (struct.pack("<3i", 90, 90, 181) + whole[12:], "cells"), (whole[:12] + np.full((len(whole) - 12) // 8, -1.0).tobytes(), "measured")):
        path.write_bytes(content)
        with pytest.raises(InvalidFile, match=says):
            merl.read(path)


def test_sources_have_the_names_that_the_library_gives_them(table, module_networks):
    assert [(source.name, source.file) for source in sources.of_file(table[0], "a/paint.binary")] == [("paint", "a/paint.binary")]
    assert [source.name for source in sources.of_file(module_networks, "n")] == [f"m{i}" for i in range(8)]
    with pytest.raises(InvalidFile, match="library"):
        sources.of_file(table[0].with_suffix(".txt"), "t")
    with pytest.raises(InvalidFile, match="no such file"):
        sources.file_of(table[0].with_suffix(".txt"))
    twice = sources.of_file(table[0], "p") * 2
    with pytest.raises(InvalidFile, match="once"):
        sources.checked(twice)
    assert sources.made_up(3, 0) == sources.made_up(3, 0) != sources.made_up(4, 0)


def test_the_shared_start_is_no_material(tmp_path):
    from safetensors.numpy import save_file

    path = tmp_path / "library.safetensors"
    save_file({"a": np.zeros(675, np.float32), "@shared_start": np.ones(675, np.float32)}, path)
    assert list(library.read(path)) == ["a"] and library.shared_start(path).sum() == 675
    save_file({"a": np.zeros(675, np.float32)}, path)
    with pytest.raises(InvalidFile, match="shared_start"):
        library.shared_start(path)
