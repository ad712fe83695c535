"""A complete plant without physics: every joint is at its setpoint at once, and one foot carries everything.

`halfstep controller --lockstep --for 5s` in one terminal, this in another, both in the root folder of the repository.
"""

import csv
import math
import sys

from halfstep import Measurement, Plant, SensorGroup

MECHANISM = 0x4C79F1ADF91719FD  # `halfstep check` prints it
WEIGHT = 73.031 * 9.80665
PERIOD = 0.001
AXES = "xyxyyyzxxzyyyxyx"  # of joints 1 to 16 in config/mechanism.toml: feet, legs, waist


def times(a, b):
    """The product of two quaternions w, x, y, z."""
    (aw, ax, ay, az), (bw, bx, by, bz) = a, b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def trunk(angles, foot):
    """Orientation of the trunk while the right (0) or the left foot (1) lies flat on the ground."""
    # From the right foot up; from the left foot up, the joints of the left leg in reverse and backward.
    leg = [(joint, 1) for joint in range(3, 9)] if foot == 0 else [(joint, -1) for joint in range(14, 8, -1)]
    orientation = (1, 0, 0, 0)
    for joint, sign in [*leg, (15, 1), (16, 1)]:
        half = sign * angles[joint - 1] / 2
        turn = [math.cos(half), 0, 0, 0]
        turn["xyz".index(AXES[joint - 1]) + 1] = math.sin(half)
        orientation = times(orientation, turn)
    return orientation


plant = Plant(MECHANISM, *sys.argv[1:], lockstep=True)
# The controller begins where the robot is: here, at the beginning of the nominal half-step.
with open("config/nominal_half_step.csv") as file:
    row = next(csv.DictReader(line for line in file if not line.startswith("#")))
angles = tuple(float(row[f"joint_{number:02}_angle_rad"]) for number in range(1, 21))
first = Measurement(
    angles=angles,
    imu_orientation=trunk(angles, 0),
    wrench_right=(0, 0, WEIGHT, 0, 0, 0),
    missing=SensorGroup.SPECIFIC_FORCE,  # it has no accelerometer
)
for setpoint, measurement in plant.lockstep(first, ticks=5000):
    measurement.angles[2:] = setpoint.angles[2:]
    measurement.rates[2:] = setpoint.rates[2:]
    bears = (measurement.wrench_right, measurement.wrench_left)
    foot = int(measurement.tick // 600 % 2)
    bears[foot][2], bears[1 - foot][2] = WEIGHT, 0.0
    before, now = tuple(measurement.imu_orientation), trunk(measurement.angles, foot)
    turned = times((before[0], *(-part for part in before[1:])), now)
    measurement.imu_orientation[:] = now
    measurement.imu_rate[:] = [2 * part / PERIOD for part in turned[1:]]
print("knee", list(measurement.angles)[4], "after", measurement.tick, "ticks")
