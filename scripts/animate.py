"""An animation of the pictures in a folder, in the order of their names."""

import argparse
from pathlib import Path

from PIL import Image

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("folder", type=Path)
parser.add_argument("-o", "--output", type=Path, required=True)
parser.add_argument("--milliseconds", type=int, default=80, help="of each picture")
parser.add_argument("--width", type=int, default=880, help="in pixels")
arguments = parser.parse_args()

pictures = [Image.open(file).convert("RGB") for file in sorted(arguments.folder.glob("*.png"))]
if not pictures:
    parser.error(f"{arguments.folder}: no .png in it")
size = (arguments.width, round(pictures[0].height * arguments.width / pictures[0].width))
first, *others = (picture.resize(size, Image.Resampling.LANCZOS) for picture in pictures)
first.save(
    arguments.output, save_all=True, append_images=others, duration=arguments.milliseconds, loop=0, quality=80, method=6
)
