"""Measures Halfstep beside Pinocchio and MuJoCo, on the same robot, in one run: `python3 tools/peers/peers.py`.

Makes an environment of its own (`--environment`), compiles `pinocchio_bench.cpp` against the Pinocchio wheel there, and lets
all take turns: the least of the rounds counts. Prints one table of ratios. Needs g++ and a package registry; nothing else of
the project needs this.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import accuracy

TOP = Path(__file__).resolve().parents[2]
LOCK = Path(__file__).with_name("requirements.lock")
SOURCE = Path(__file__).with_name("pinocchio_bench.cpp")
# As Pinocchio's own CMake targets ask for.
DEFINITIONS = [
    "BOOST_MPL_LIMIT_LIST_SIZE=30",
    "BOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "BOOST_FUSION_INVOKE_MAX_ARITY=12",
    "PINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION",
]
LIBRARIES = ["pinocchio_default", "boost_serialization", "boost_filesystem"]

# What is compared: our row, the peer's, and the ratio that is asked for.
RATIOS = [
    ("Newton–Euler and ZMP, one configuration", "rnea", 0.35),
    ("Newton–Euler and ZMP, of eight at once", "rnea", 0.05),
    ("ZMP Jacobian by the joints", "rnea_derivatives", 0.25),
    ("ZMP for another speed, from the table's split", "rnea", 0.02),
    ("forward dynamics, floating base", "aba", 0.5),
    ("controller tick, walking", "rnea", 2.0),
    ("plant, a control period on both soles", "mujoco_step", 0.5),
    ("plant, a control period of walking", "mujoco_walk", 0.5),
]

# One simulated second of standing on both soles, in C.
MUJOCO = """
import json, sys, time
import mujoco, numpy as np
model = mujoco.MjModel.from_xml_string(open(sys.argv[1]).read())
model.opt.timestep = 0.001
model.actuator_biastype[:] = mujoco.mjtBias.mjBIAS_AFFINE
model.actuator_biasprm[:, 1], model.actuator_biasprm[:, 2] = -5000, -150
data = mujoco.MjData(model)
mujoco.mj_step(model, data, nstep=500)
least = float("inf")
for _ in range(5):
    begin = time.perf_counter()
    mujoco.mj_step(model, data, nstep=1000)
    least = min(least, time.perf_counter() - begin)
assert data.ncon >= 8 and data.qpos[2] > -0.01, "the robot does not stand"
print(json.dumps({"mujoco_step": least / 1000 * 1e9}))
"""


def main():
    """Prepares, lets all take turns, prints."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--environment", type=Path, default=cache())
    arguments.add_argument("--rounds", type=int, default=5)
    options = arguments.parse_args()

    python = environment(options.environment)
    peer = pinocchio(options.environment, python)
    run(["cargo", "build", "--release", "-q", "-p", "halfstep", "-p", "halfstep-survey"], cwd=TOP)
    halfstep = target() / "release/halfstep"
    mjcf = options.environment / "robot.xml"
    run([halfstep, "export", "mjcf", "--out", mjcf], cwd=TOP)
    robots = [options.environment / name for name in ("fixed.txt", "floating.txt")]
    write_robots(*robots)
    print("walking in both engines", file=sys.stderr)
    played = options.environment / "played.json"
    errors = accuracy.measure(halfstep.with_name("survey"), TOP, played)

    least = {}
    for number in range(options.rounds):
        print(f"round {number + 1} of {options.rounds}", file=sys.stderr)
        for name, nanoseconds in [*ours(halfstep), *lines(run([peer, *robots])), *theirs(python, mjcf, played)]:
            least[name] = min(nanoseconds, least.get(name, float("inf")))

    print(f"{'':46} {'ns':>10}   {'beside':>16} {'ns':>10} {'ratio':>7} {'asked':>7}")
    for mine, beside, asked in RATIOS:
        if mine in least:
            ratio = least[mine] / least[beside]
            print(f"{mine:46} {least[mine]:10.0f}   {beside:>16} {least[beside]:10.0f} {ratio:7.3f} {asked:7.2f}")
    print()
    for line in accuracy.table(errors, TOP):
        print(line)


def run(command, **options):
    """What a program prints."""
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def cache():
    """A folder of the user's own, another one for other packages or another source."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    name = hashlib.sha256(LOCK.read_bytes() + SOURCE.read_bytes()).hexdigest()[:16]
    return base / "halfstep" / f"peers-{name}"


def environment(folder):
    """A Python with the peers in it. What lies in the folder is executed: it must belong to this user."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    if folder.stat().st_uid != os.getuid() or folder.stat().st_mode & 0o022:
        sys.exit(f"{folder} belongs to another user, or others may write to it: remove it, or choose another --environment")
    python, ready = folder / "bin/python", folder / "ready"
    if not (ready.exists() and python.exists()):
        run([sys.executable, "-I", "-m", "venv", "--clear", folder])
        pip = [python, "-I", "-m", "pip", "install", "-q", "--isolated", "--no-input", "--no-deps"]
        run([*pip, "--require-hashes", "--only-binary=:all:", "-r", LOCK])
        ready.write_text(LOCK.read_text())
    return python


def pinocchio(folder, python):
    """The compiled bench."""
    binary = folder / "pinocchio_bench"
    if not binary.exists():
        print("compiling against Pinocchio, some minutes", file=sys.stderr)
        prefix = Path(run([python, "-c", "import cmeel, pathlib; print(pathlib.Path(cmeel.__file__).parents[1])"]).strip())
        prefix /= "cmeel.prefix"
        include = [f"-I{prefix}/include", f"-I{prefix}/include/eigen3"]
        link = [f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib", *(f"-l{name}" for name in LIBRARIES)]
        flags = ["-std=c++17", "-O3", "-DNDEBUG", *(f"-D{each}" for each in DEFINITIONS)]
        run(["g++", *flags, *include, SOURCE, *link, "-o", binary])
    return binary


def write_robots(fixed, floating):
    """The mechanism as `pinocchio_bench.cpp` reads it: on the floor by joints 1 and 2, and in the air."""
    joints = tomllib.loads((TOP / "config/mechanism.toml").read_text())["joint"]
    names = sorted(joints, key=lambda name: joints[name]["number"])

    def text(names, base):
        place = {name: index for index, name in enumerate(names)}
        for name in names:
            joint = joints[name]
            parent = -1 if name == base else place.get(joint["parent"], -1)
            axis = [0, 0, 0] if name == base else joint["axis"]
            body = [joint.get("mass_kg", 0), *joint.get("com_m", [0] * 3), *joint.get("inertia_kg_m2", [0] * 3)]
            yield " ".join(map(str, [parent, *axis, *joint["origin_m"], *body]))

    fixed.write_text("\n".join(text(names, None)) + "\n")
    floating.write_text("\n".join(text(names[1:], names[1])) + "\n")


def target():
    """Where Cargo puts what it builds."""
    return Path(json.loads(run(["cargo", "metadata", "--format-version", "1", "--no-deps"], cwd=TOP))["target_directory"])


def ours(halfstep):
    """The least means of `halfstep bench compute`."""
    found = json.loads(run([halfstep, "bench", "compute", "--rounds", "1", "--slice", "200ms", "--json"], cwd=TOP))
    return [(series["name"], series["p50_ns"]) for series in found["series"]]


def lines(text):
    """`name number` in each."""
    return [(name, float(number)) for name, number in (line.split() for line in text.splitlines())]


def theirs(python, mjcf, played):
    """MuJoCo's step, standing and walking."""
    walk = Path(__file__).with_name("mujoco_walk.py")
    told = [run([python, *arguments]) for arguments in (["-c", MUJOCO, mjcf], [walk, played])]
    return [pair for each in told for pair in json.loads(each).items()]


if __name__ == "__main__":
    main()
