"""What `nbrdf render` shows, and what it exports: the other side of `mitsuba_check.py`."""

import json
import subprocess
from pathlib import Path

import mitsuba as mi
import numpy as np

LAMPS = ("point", "studio")
# Under a map: finer than any picture that it is compared with, so that rays through the middles of pixels fill these.
SIZE = 256
HEIGHT = 512


class References:
    """The program in a folder; pictures are kept there. Those under a map have noise of their own: there are several, with so
    many samples each. Names are those of the library, or of the built-in one without."""

    def __init__(self, program: Path, folder: Path, seeds: int, samples: int, library: Path | None) -> None:
        self.program, self.folder, self.seeds, self.samples = program.resolve(), folder, seeds, samples
        self.library = ("--library", str(library.resolve())) if library else ()
        self.environment = folder / "environment.exr"
        write_environment(self.environment)

    def run(self, *arguments: str) -> bytes:
        """What the program says."""
        return subprocess.run([self.program, *arguments, *self.library, "--quiet"], cwd=self.folder, check=True, stdout=subprocess.PIPE).stdout

    def merl(self) -> list[str]:
        """Names of the materials of MERL."""
        return [row["name"] for row in json.loads(self.run("list", "--json"))["materials"] if row["database"] == "merl"]

    def pictures(self, material: str, light: str, size: int) -> np.ndarray:
        """[1, size, size, 3] under lamps, without noise; [seeds, 256, 256, 3] under the map. The material is a name or a file.
        Lamps that a scene draws from light all of a pixel, not its middle: [1, 256, 256, 3]."""
        if light == "studio_drawn":
            return self.pictures(material, "studio", SIZE)
        if light in LAMPS:
            return self.picture(material, size, "--light", light)[np.newaxis]
        how = ("--environment", self.environment.name, "--samples", str(self.samples), "--seed")
        return np.stack([self.picture(material, SIZE, *how, str(seed)) for seed in range(self.seeds)])

    def picture(self, material: str, size: int, *how: str) -> np.ndarray:
        path = self.folder / ("_".join([material.replace("/", "_"), str(size), *how]) + ".exr")
        if not path.exists():
            self.run("render", material, "-o", path.name, "--size", str(size), *how)
        return np.array(mi.Bitmap(str(path)), dtype=np.float64)[..., :3]


def write_environment(path: Path) -> None:
    """A sky that is brighter above, and two soft lights. Large and smooth, since Mitsuba joins pixels by straight lines, the first
    and last row at the poles, where nbrdf has constant ones, half a pixel from them: 0.02 % of a picture's light here."""
    theta, phi = np.meshgrid((np.arange(HEIGHT) + 0.5) / HEIGHT * np.pi, (np.arange(2 * HEIGHT) + 0.5) / HEIGHT * np.pi, indexing="ij")
    sky = np.stack((0.3 + 0.2 * np.cos(theta), 0.35 + 0.2 * np.cos(theta), 0.45 + 0.25 * np.cos(theta)), axis=-1)

    def light(polar: float, azimuth: float, colour: tuple[float, float, float]) -> np.ndarray:
        cosine = np.cos(theta) * np.cos(polar) + np.sin(theta) * np.sin(polar) * np.cos(phi - azimuth)
        return np.exp(6 * (cosine - 1))[..., np.newaxis] * colour

    pixels = sky + light(0.9, 3.9, (3.0, 2.6, 2.2)) + light(1.4, 2.1, (0.7, 0.9, 1.2))
    mi.Bitmap(pixels.astype(np.float32)).write(str(path))
