"""Named networks: published zips of Keras .h5 files, and our .safetensors libraries (one F32 [675] per material).

Names are as published: `chrome`; materials of the second database carry its name: `rgl/paper_white`.
"""

import io
import zipfile
from pathlib import Path

import h5py
import numpy as np
from safetensors import SafetensorError
from safetensors.numpy import load_file

from .invalid import InvalidFile
from .network import WIDTHS, size

SHARED_START = "@shared_start"  # no material, but what networks of a library were fitted from
Library = dict[str, np.ndarray]  # name → weights [675] float64, sorted by name


def read(path: Path | str) -> Library:
    """A library of any form, by its extension."""
    path = Path(path)
    if not path.is_file():
        raise InvalidFile(path, "a library of networks", "no such file", "set NBRDF_DATA, or give --networks PATH")
    library = _published(path) if path.suffix == ".zip" else _safetensors(path)
    if not library:
        raise InvalidFile(path, "at least one network", "none")
    return {name: library[name] for name in sorted(library)}


def database(name: str) -> str:
    """Which database a material's name belongs to."""
    return name.split("/")[0] if "/" in name else "merl"


def shared_start(path: Path | str) -> np.ndarray:
    """The network [675] that all of a .safetensors library were fitted from."""
    tensors = _tensors(Path(path))
    if SHARED_START not in tensors:
        raise InvalidFile(path, f"a tensor {SHARED_START}", "none", "the library of shared start")
    return tensors[SHARED_START].astype(np.float64)


def _safetensors(path: Path) -> Library:
    return {name: tensor.astype(np.float64) for name, tensor in _tensors(path).items() if name != SHARED_START}


def _tensors(path: Path) -> dict[str, np.ndarray]:
    if not path.is_file():
        raise InvalidFile(path, "a library of networks", "no such file")
    try:
        tensors = load_file(path)
    except (SafetensorError, OSError, KeyError) as error:
        raise InvalidFile(path, "a .safetensors library", str(error)) from error
    for name, tensor in tensors.items():
        if tensor.shape != (size(),) or tensor.dtype != np.float32:
            raise InvalidFile(path, f"F32 [{size()}] for {name}", f"{tensor.dtype} {list(tensor.shape)}")
    return tensors


def _published(path: Path) -> Library:
    library = {}
    try:
        with zipfile.ZipFile(path) as archive:
            for entry in archive.namelist():
                # The .json beside each .h5 holds marshalled bytecode: skipped, never read.
                if entry.endswith(".h5") and not Path(entry).name.startswith("."):
                    library[name_of(Path(entry).stem)] = _keras(archive.read(entry), f"{path}:{entry}")
    except zipfile.BadZipFile as error:
        raise InvalidFile(path, "a zip of .h5 networks", str(error)) from error
    return library


def name_of(stem: str) -> str:
    """The stem of a published file → a material's name: `chrome` → `chrome`, `paper_white_rgb` → `rgl/paper_white`."""
    return f"rgl/{stem.removesuffix('_rgb')}" if stem.endswith("_rgb") else stem


def _keras(content: bytes, label: str) -> np.ndarray:
    """Bytes of a Keras .h5 → weights [675] float64. Group numbers vary (dense_1, dense_4, ...): only their order counts."""
    found: dict[int, dict[str, np.ndarray]] = {}

    def collect(name: str, item: h5py.Group | h5py.Dataset) -> None:
        if isinstance(item, h5py.Dataset):
            *_, group, leaf = ["", *name.split("/")]
            number = int("0" + "".join(filter(str.isdigit, group)))
            found.setdefault(number, {})[leaf.split(":")[0]] = item[()]

    try:
        with h5py.File(io.BytesIO(content)) as file:
            file.visititems(collect)
    except OSError as error:
        raise InvalidFile(label, "a Keras HDF5 file", str(error)) from error
    parts = [found[layer].get(kind, np.zeros(0)) for layer in sorted(found) for kind in ("kernel", "bias")]
    expected = [shape for rows, columns in zip(WIDTHS, WIDTHS[1:]) for shape in ((rows, columns), (columns,))]
    shapes = [part.shape for part in parts]
    if shapes != expected:
        raise InvalidFile(label, f"dense layers of shapes {expected}", str(shapes))
    return np.concatenate([part.astype(np.float64).ravel() for part in parts])
