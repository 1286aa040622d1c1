"""Fixtures: published networks when they are there, and a small made-up autoencoder when they are not needed."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

from nbrdf_jax import data, library, program

FEATURES, HIDDEN, SHARED, CHANNEL = 12, 10, 5, 2
TRUNK, HEAD = 609, 22


def published(database: str) -> library.Library:
    """The published networks, or a loud skip; with NBRDF_REQUIRE_DATA=1 a failure."""
    path = data.archive(database)
    if not path.is_file():
        message = f"PUBLISHED DATA MISSING: {path.name} not found; set NBRDF_DATA to its folder"
        pytest.fail(message) if os.environ.get("NBRDF_REQUIRE_DATA") == "1" else pytest.skip(message)
    return library.read(path)


@pytest.fixture(scope="session")
def merl() -> library.Library:
    return published("merl")


@pytest.fixture(scope="session")
def rgl() -> library.Library:
    return published("rgl")


@pytest.fixture(scope="session")
def exported(tmp_path_factory) -> Path:
    """Chrome as .npz and as .h5."""
    if not program.BUILT.is_file():
        pytest.skip(f"PROGRAM MISSING: {program.BUILT}: cargo build --release")
    folder = tmp_path_factory.mktemp("exported")
    for form in ("npz", "keras"):
        subprocess.run([program.BUILT, "export", "chrome", "--to", form, "-o", folder / "chrome", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture(scope="module")
def module_networks(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A library of eight made-up materials; m2 and m7 are held out."""
    random = np.random.default_rng(1)
    path = tmp_path_factory.mktemp("networks") / "networks.safetensors"
    # Small weights: bright ones would be clipped to white, and every picture would look the same.
    save_file({f"m{i}": random.normal(0, 0.2, 675).astype(np.float32) for i in range(8)}, path)
    return path


@pytest.fixture
def tensors() -> dict[str, np.ndarray]:
    """A small checkpoint with random weights."""
    return made_up()


@pytest.fixture(scope="module")
def module_checkpoint(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("checkpoint") / "znbrdf.safetensors"
    save_file(made_up(), path, metadata={"model": "znbrdf"})
    return path


def made_up() -> dict[str, np.ndarray]:
    """Tensors of sizes unlike the real one so that nothing can be hard-coded."""
    random = np.random.default_rng(2)
    linear = {
        "encoder.body.0": (8, 3 * FEATURES), "encoder.body.1": (7, 8), "encoder.body.2": (HIDDEN, 7),
        "encoder.shared": (SHARED, HIDDEN), "encoder.channel": (CHANNEL, 2 * HIDDEN),
        "decoder.trunk.0": (9, SHARED + CHANNEL), "decoder.trunk.1": (8, 9), "decoder.trunk.2": (TRUNK, 8),
        "decoder.head.0": (9, SHARED + 2 * CHANNEL), "decoder.head.1": (8, 9), "decoder.head.2": (HEAD, 8),
    }  # fmt: skip
    made = {"probes": random.uniform(0, 1, (FEATURES, 6)), "probe_cosine": random.uniform(0.1, 1, FEATURES)}
    start = random.normal(0, 0.2, 675)
    start[609:672] = np.repeat(start[609:630], 3)  # the start treats the channels alike, as training leaves it
    start[672:] = start[672]
    made |= {"start": start, "spread": np.full(675, 0.1)}
    for name, (rows, columns) in linear.items():
        made |= {f"{name}.weight": random.normal(0, columns**-0.5, (rows, columns)), f"{name}.bias": random.normal(0, 0.1, rows)}
    return {name: np.ascontiguousarray(tensor, dtype=np.float32) for name, tensor in made.items()}


@pytest.fixture
def checkpoint(tensors: dict[str, np.ndarray], tmp_path: Path) -> Path:
    path = tmp_path / "znbrdf.safetensors"
    save_file(tensors, path, metadata={"model": "znbrdf"})
    return path
