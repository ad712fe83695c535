"""Checks the models that the plant makes of URDFs: `python test_urdf_model.py ROBOTS [NAME …]`.

ROBOTS is a folder of folders, each with a `robot.urdf` and a `sole.toml`; with names, only those are checked. Each of
them stands, meets its torque limits, and is compared with what the URDF itself says. The first of them is then given
peculiarities that other URDFs have. Prints a table with a line per robot, and stops at the first thing that is wrong.
"""

import sys
import time
from pathlib import Path

import numpy as np

import plant
from checks.motion import check_limits, check_push, check_standing
from checks.peculiar import check_peculiar, check_root
from checks.pipes import check_pipes
from checks.places import (
    check_kinematics,
    check_mass,
    check_mass_error,
    check_payload,
    check_round_trip,
    check_soles,
)
from checks.robots import ROBOTS
from checks.told import first_message


def check_robot(folder, name):
    """All checks of one robot. Returns a line of the table."""
    told, reader = first_message(folder, name)
    began = time.perf_counter()
    robot = plant.UrdfRobot(told)
    load = time.perf_counter() - began
    check_mass(name, robot, reader)
    check_soles(name, robot, told)
    shifted = told["urdf_setup"] | {"sole": told["urdf_setup"]["sole"] | {"inside": 0.02, "outside": 0.05}}
    check_soles(name, plant.UrdfRobot(told | {"urdf_setup": shifted}), told | {"urdf_setup": shifted})
    check_kinematics(name, told, reader)
    check_round_trip(name, told)
    check_payload(name, told, reader)
    check_mass_error(name, told, reader)
    check_push(name, told, reader)
    check_limits(name, told)
    sag, tilt, taken, torque, robot = check_standing(name, told, reader)
    contact = robot.model.geom("floor").solref[0]
    return (
        f"{name:9} {reader.mass:6.2f} {robot.model.nv - 6:6} {robot.model.nbody:6} {1e3 * contact:8.2f} {sag:6.3f} "
        f"{tilt:6.3f} {torque:8.2f} {load:6.2f} {taken:8.3f}"
    )


def main():
    """Checks the robots that the command line names, or all."""
    folder = Path(sys.argv[1])
    print("robot         kg joints bodies  contact    sag   tilt   torque   load     wall")
    print("                                     ms    deg    deg      N m      s      s/s")
    names = sys.argv[2:] or list(ROBOTS)
    for name in names:
        print(check_robot(folder, name), flush=True)
    told, _ = first_message(folder, names[0])
    check_pipes(names[0], told)
    check_root(told, np.array([0.3, -0.2, 0.1]), 0)
    check_root(told, np.zeros(3), 200)
    check_peculiar(told)


if __name__ == "__main__":
    main()
