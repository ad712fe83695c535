"""Draws a run, of either plant, as MuJoCo sees it: PNG frames, without a screen.

    halfstep export mjcf --out robot.xml
    halfstep plot runs/0001 --csv
    MUJOCO_GL=egl python tools/mujoco_plant/render.py runs/0001 robot.xml frames --every 0.1

`MUJOCO_GL` is `egl`, or `osmesa` where that library is. The camera goes along at the robot's side.
"""

import argparse
import csv
import os
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

try:
    import mujoco
except (AttributeError, ImportError, OSError) as cause:
    graphics = os.environ.get("MUJOCO_GL", "")
    sys.exit(f"MUJOCO_GL={graphics}: MuJoCo cannot draw with it here ({cause}); try MUJOCO_GL=egl")


def main():
    """Reads the run's table and writes one PNG per frame."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("run", type=Path, help="folder with a run's plant.csv")
    options.add_argument("mjcf", type=Path, help="the robot, as `halfstep export mjcf` writes it")
    options.add_argument("out", type=Path, help="folder for the frames")
    options.add_argument("--every", type=float, default=0.1, metavar="S", help="time between frames")
    options.add_argument("--start", type=float, default=0.0, metavar="S", help="first frame")
    options.add_argument("--end", type=float, default=float("inf"), metavar="S", help="last frame")
    options.add_argument("--size", type=int, nargs=2, default=(960, 540), metavar=("WIDTH", "HEIGHT"))
    options.add_argument("--azimuth", type=float, default=125.0, metavar="DEG", help="where the camera looks to")
    told = options.parse_args()

    model = mujoco.MjModel.from_xml_path(str(told.mjcf))
    data = mujoco.MjData(model)
    renderer = mujoco.Renderer(model, told.size[1], told.size[0])
    camera = mujoco.MjvCamera()
    camera.distance, camera.azimuth, camera.elevation = 3.2, told.azimuth, -12
    told.out.mkdir(parents=True, exist_ok=True)
    due = told.start
    for row in csv.DictReader((told.run / "plant.csv").open()):
        time = float(row["t_s"])
        if time < due - 1e-9 or time > told.end:
            continue
        due += told.every
        data.qpos[:3] = [float(row[f"right_sole_{axis}_m"]) for axis in "xyz"]
        data.qpos[3:7] = [float(row[f"right_sole_q{axis}"]) for axis in "wxyz"]
        data.qpos[7:] = [float(row[f"joint_{number:02}_angle_rad"]) for number in range(3, 21)]
        mujoco.mj_forward(model, data)
        camera.lookat = [*data.subtree_com[0][:2], 0.85]
        renderer.update_scene(data, camera)
        (told.out / f"{round(1000 * time):07}ms.png").write_bytes(png(renderer.render()))


def png(pixels):
    """An image as a PNG file."""

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    height, width, _ = pixels.shape
    # Each line begins with a byte that says: not filtered.
    lines = np.hstack([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)])
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines.tobytes())) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


if __name__ == "__main__":
    main()
