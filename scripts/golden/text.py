"""Golden numbers as text: JSON with a header that says how it was made."""

import json
import re
from typing import Any

import numpy as np

DIGITS = 12  # printed; fewer than float64 has, so that another libm prints the same bytes


def document(name: str, about: str, content: dict[str, Any]) -> bytes:
    """Same content, same bytes."""
    header = {"schema": 1, "command": f"python scripts/make_golden.py {name}", "about": about}
    text = json.dumps(header | rounded(content), indent=1)
    flat = re.sub(r"[\[{][^\[\]{}]*[\]}]", lambda match: re.sub(r"\s+", " ", match[0]), text)  # innermost on one line
    return (flat + "\n").encode()


def rounded(value: Any) -> Any:
    """Floats to 12 significant digits, arrays to lists; −0 becomes 0."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | list | tuple):
        return [rounded(item) for item in value]
    return float(f"{value:.{DIGITS}g}") + 0.0 if isinstance(value, float) else value


def printed(values: np.ndarray) -> np.ndarray:
    """Rounded to what is printed, so that whoever reads the file starts from the same numbers."""
    return np.round(values, 9)
