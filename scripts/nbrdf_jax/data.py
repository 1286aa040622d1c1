"""Where the published files are: the folder in NBRDF_DATA, else ../shared/data beside the repository."""

import os
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
ARCHIVES = {"merl": "merl_nbrdf.zip", "rgl": "rgl_nbrdf_subset.zip"}


def folder() -> Path:
    """The folder with the published data; it need not exist."""
    given = os.environ.get("NBRDF_DATA")
    return Path(given) if given else REPOSITORY.parent / "shared" / "data"


def archive(database: str) -> Path:
    """Path of the zip with the published networks of "merl" or "rgl"."""
    return folder() / ARCHIVES[database]
