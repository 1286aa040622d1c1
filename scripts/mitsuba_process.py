"""Mitsuba in processes of its own, and the LLVM that its vectorized variants need."""

import json
import os
import re
import subprocess
import sys
from glob import glob
from pathlib import Path

import numpy as np

LLVM = "import mitsuba as mi; mi.set_variant('llvm_ad_rgb'); import drjit as dr; assert dr.sum(dr.arange(mi.Float, 8) + 1)[0] == 36"


def run_job(job: dict, library: str | None) -> dict[str, np.ndarray]:
    """The pictures that `mitsuba_render.py` makes of a job; its files lie beside the job's output."""
    path = Path(job["output"]).with_suffix(".json")
    path.write_text(json.dumps(job))
    environment = os.environ | ({"DRJIT_LIBLLVM_PATH": library} if library else {})
    subprocess.run([sys.executable, str(Path(__file__).with_name("mitsuba_render.py")), str(path)], check=True, env=environment)
    with np.load(job["output"]) as pictures:
        return {name: pictures[name] for name in pictures.files}


def find_llvm() -> str | None:
    """The first LLVM that renders, the newest first; each is tried in a process of its own."""
    found = {str(Path(path).resolve()) for pattern in ("/usr/lib/*/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*", "/opt/homebrew/opt/llvm/lib/libLLVM*.dylib") for path in glob(pattern)}
    version = lambda path: max((int(number) for number in re.findall(r"\d+", Path(path).name)), default=0)  # noqa: E731
    candidates = [os.environ["DRJIT_LIBLLVM_PATH"]] if "DRJIT_LIBLLVM_PATH" in os.environ else sorted(found, key=version, reverse=True)
    for library in candidates:
        tried = subprocess.run([sys.executable, "-c", LLVM], env=os.environ | {"DRJIT_LIBLLVM_PATH": library}, capture_output=True)
        if tried.returncode == 0:
            return library
    return None
