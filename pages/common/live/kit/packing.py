"""Records as bytes for the browser: [uint32 n][JSON, n bytes][float32 blocks one after another]. See table.js."""

import json
import math
import struct
from collections.abc import Mapping

import numpy as np


def pack(header: Mapping, blocks: Mapping[str, np.ndarray]) -> bytes:
    """header: what JSON can hold; blocks: arrays of shape (n,) or (rows, n)."""
    tables = {name: np.atleast_2d(block).astype("<f4") for name, block in blocks.items()}
    shapes = [[name, *table.shape] for name, table in tables.items()]
    text = json.dumps({**header, "blocks": shapes}, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return b"".join([struct.pack("<I", len(text)), text, *(table.tobytes() for table in tables.values())])


def figures(values: Mapping[str, float]) -> dict[str, float | str | None]:
    """Numbers for JSON, which has neither infinity nor nan: "inf" and None."""
    return {name: _figure(value) for name, value in values.items()}


def _figure(value: float) -> float | str | None:
    if math.isnan(value):
        return None
    return "inf" if math.isinf(value) else float(value)
