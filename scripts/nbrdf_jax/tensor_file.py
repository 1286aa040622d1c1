"""The tensor files of the RGL material database (Dupuy and Jakob 2018): named arrays after a header of names, types, shapes."""

import math
import struct
from pathlib import Path

import numpy as np

from .invalid import InvalidFile

MAGIC = b"tensor_file\0"
KINDS = {1: np.uint8, 2: np.int8, 3: np.uint16, 4: np.int16, 5: np.uint32, 6: np.int32, 7: np.uint64, 8: np.int64, 9: np.float16, 10: np.float32, 11: np.float64}


def read(path: Path | str) -> dict[str, np.ndarray]:
    """All fields by name."""
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError as error:
        raise InvalidFile(path, "a tensor file", "no such file") from error
    if content[: len(MAGIC)] != MAGIC or content[12:14] != b"\x01\0":
        raise InvalidFile(path, "a tensor file of version 1.0", repr(content[:14]))
    fields, place = {}, 18
    try:
        for _ in range(struct.unpack_from("<I", content, 14)[0]):
            (length,) = struct.unpack_from("<H", content, place)
            name = content[place + 2 : place + 2 + length].decode()
            place += 2 + length
            dimensions, kind, start = struct.unpack_from("<HBQ", content, place)
            shape = struct.unpack_from(f"<{dimensions}Q", content, place + 11)
            place += 11 + 8 * dimensions
            fields[name] = np.frombuffer(content, KINDS[kind], math.prod(shape), start).reshape(shape)
    except (struct.error, ValueError, KeyError, UnicodeDecodeError) as error:
        raise InvalidFile(path, "a whole tensor file", str(error)) from error
    return fields
