"""Error of larger integration steps: our plant and MuJoCo, each against its own walk in steps of 10 µs."""

import json
import subprocess
import tomllib

# Asked for: an error no larger than MuJoCo's at 1 ms.
ASKED = 1.0
QUANTITIES = {"joints_rad": "joints [mrad]", "trunk_m": "place of the trunk [mm]", "trunk_rad": "angle of the trunk [mrad]"}


def measure(survey, top, played):
    """The rows of `survey accuracy`, which also writes what MuJoCo is timed with."""
    command = [survey, "accuracy", "--json", "--played", played]
    # Its exit code is a verdict, which the table gives, too.
    return json.loads(subprocess.run(list(map(str, command)), cwd=top, stdout=subprocess.PIPE, text=True).stdout)


def table(rows, top):
    """Lines that compare our plant, as committed, with MuJoCo at 1 ms."""
    steps = tomllib.loads((top / "config/plant.toml").read_text())["steps_per_period"]
    ours = next(row for row in rows if row["engine"] == "ours" and row["steps_per_period"] == steps)
    theirs = next(row for row in rows if row["engine"] == "MuJoCo" and row["steps_per_period"] == 1)
    yield f"{'walking, error of our plant':46} {f'{1 / steps:g} ms':>10}   {'beside':>16} {'1 ms':>10} {'ratio':>7} {'asked':>7}"
    for key, name in QUANTITIES.items():
        for after, mine, beside in zip(ours["after_periods"], ours[key], theirs[key]):
            label = f"{name} after {after} ms"
            yield f"{label:46} {1e3 * mine:10.4f}   {'MuJoCo':>16} {1e3 * beside:10.4f} {mine / beside:7.3f} {ASKED:7.2f}"
