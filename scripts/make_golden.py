"""Golden numbers for the tests of every implementation. Same inputs, same bytes.

    python scripts/make_golden.py [WHICH ...]      (default: all)

`forward` and `rgl` need the published data (NBRDF_DATA); their files hold directions and results, never a published weight
or table. `metrics`, `rgl` and `brushed` need other programs: pip install -e 'scripts[golden]'. How every file was made stands
in tests/golden/README.md, which is written too.
Exit codes: 0 done, 2 usage, 3 a file or a program is missing; then nothing is written.
"""

import argparse
import importlib
import sys
from dataclasses import dataclass
from pathlib import Path

from nbrdf_jax.fitted_library import whole
from nbrdf_jax.invalid import InvalidFile

FOLDER = Path(__file__).resolve().parents[1] / "tests" / "golden"


@dataclass(frozen=True)
class File:
    """A golden file: its name, module and function that make it, by what, and what it holds."""

    name: str
    module: str
    function: str
    by: str
    about: str

    def make(self) -> bytes:
        """The file's content."""
        try:
            module = importlib.import_module(f"golden.{self.module}")
        except ModuleNotFoundError as error:
            raise InvalidFile(f"golden/{self.module}.py", f"the package {error.name}", "none of that name", "pip install -e 'scripts[golden]'") from error
        return getattr(module, self.function)()


NUMPY, JAX = "NumPy, float64", "JAX, float64, rounded to float32"
FILES = {
    "forward": File("forward.safetensors", "networks", "forward", "NumPy, float64, rounded to float32", "f_r of every published network at 1000 pairs of directions stored beside them"),
    "coordinates": File("coordinates.json", "directions", "coordinates", NUMPY, "angles beside light, view, half and difference vectors"),
    "merl": File("merl.json", "directions", "merl", NUMPY, "answers of a MERL table that a formula fills"),
    "sphere": File("sphere.json", "pictures", "sphere", NUMPY, "pixels of spheres of known materials"),
    "gradient": File("gradient.safetensors", "networks", "gradient", JAX, "loss between two made-up networks and its gradient by reverse mode"),
    "judged": File("judged.json", "pictures", "judged", NUMPY, "metrics between known materials"),
    "lobes": File("lobes.json", "lobes", "lobe_values", NUMPY, "values of analytic lobes"),
    "charting": File("charting.json", "linear", "charting", NUMPY, "the connection of local charts of a bent sheet"),
    "least_squares": File("least_squares.json", "linear", "least_squares", "LAPACK by NumPy", "systems from well posed to nearly singular"),
    "rank": File("rank.json", "linear", "rank", "LAPACK by NumPy", "singular values of tables"),
    "parametric": File("parametric.json", "parametric", "parametric", NUMPY, "values of the shading models of glTF, OpenPBR and Blender, from their specifications"),
    "metrics": File("metrics.json", "metrics", "metric_values", "scikit-image, flip-evaluator, colour-science", "figures of merit of pairs of pictures and materials; versions stand in the file"),
    "brushed": File("brushed.bsdf", "rgl", "brushed", "NumPy, rounded to float32", "a brushed metal in the form of the RGL database (tensor file, version 1.0)"),
    "rgl": File("rgl.json", "rgl", "rgl", "Mitsuba 3, plugin measured", "values of measured files; the version stands in the file"),
}
# What our own program wrote, for other programs to read in tests.
WRITTEN = ["car_paint.mtlx", "car_paint.py"]


def readme() -> bytes:
    """How every file is made, for those whose form has no place for it."""
    rows = [f"| `{file.name}` | `make_golden.py {which}` | {file.by} | {file.about} |" for which, file in FILES.items()]
    head = """# Golden numbers

Made by `scripts/make_golden.py`, which writes this page too: the same inputs give the same bytes, and the tests of Python
make every file but those of other programs anew. Of `rgl.json`, which another program makes in single precision, the last
digit differs between processors. `.json` files and `.safetensors` (in their metadata) also say it themselves.

| file | command | by | what |
| --- | --- | --- | --- |
"""
    tail = f"""
{" and ".join(f"`{name}`" for name in WRITTEN)} are no oracles: `nbrdf-core` must write exactly these, and MaterialX and Python
read them in `scripts/tests/test_parametric.py`.
"""
    return (head + "\n".join(rows) + "\n" + tail).encode()


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="*", metavar="WHICH", help=f"of {', '.join(FILES)} (default: all)")
    parser.add_argument("-o", "--output", type=Path, default=FOLDER, help="folder (default: tests/golden)")
    arguments = parser.parse_args(argv)
    unknown = set(arguments.which) - set(FILES)
    if unknown:
        parser.error(f"no golden file is called {', '.join(sorted(unknown))}; there are {', '.join(FILES)}")
    try:
        made = {FILES[which].name: FILES[which].make() for which in arguments.which or FILES} | {"README.md": readme()}
        for name, content in made.items():
            whole(arguments.output / name, content)
            print(arguments.output / name)
    except InvalidFile as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
