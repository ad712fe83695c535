"""A complete plant without physics: every joint is at its setpoint at once, and one foot carries everything.

`halfstep controller --lockstep --for 5s` in one terminal, this in another, both in the root folder of the repository.
"""

import csv
import sys

from halfstep import Measurement, Plant

MECHANISM = 0x4C79F1ADF91719FD  # `halfstep check` prints it
WEIGHT = 73.031 * 9.80665

plant = Plant(MECHANISM, *sys.argv[1:], lockstep=True)
# The controller begins where the robot is: here, at the beginning of the nominal half-step.
with open("config/nominal_half_step.csv") as file:
    row = next(csv.DictReader(line for line in file if not line.startswith("#")))
angles = tuple(float(row[f"joint_{number:02}_angle_rad"]) for number in range(1, 21))
first = Measurement(angles=angles, imu_orientation=(1, 0, 0, 0), wrench_right=(0, 0, WEIGHT, 0, 0, 0))
for setpoint, measurement in plant.lockstep(first, ticks=5000):
    measurement.angles[2:] = setpoint.angles[2:]
    measurement.rates[2:] = setpoint.rates[2:]
    bears = (measurement.wrench_right, measurement.wrench_left)
    foot = int(measurement.tick // 600 % 2)
    bears[foot][2], bears[1 - foot][2] = WEIGHT, 0.0
print("knee", list(measurement.angles)[4], "after", measurement.tick, "ticks")
