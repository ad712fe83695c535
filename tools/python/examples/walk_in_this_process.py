"""A robot walks a minute within this process: sideways, pushed on the way, and its zero-moment point drawn.

pip install matplotlib, then:   python walk_in_this_process.py [ROBOT] [PICTURE]
"""

import sys

import matplotlib

from halfstep import Walk

matplotlib.use("Agg")
import matplotlib.pyplot as plt

robot, picture = (*sys.argv[1:], *["g1", "zmp.png"][len(sys.argv) - 1 :])
walk = Walk(robot, seed=3)
print(walk.ask(vx=0.2, vy=0.05).text)
before = walk.run(seconds=30)
walk.push([0, 3, 0], lasts=0.1)
after = walk.run(seconds=30)
print(f"fell: {walk.state.fallen}, came to {walk.state.estimated_pose}, least margin {after.margin.min():.4f} m")

for part in (before, after):
    plt.plot(part.zmp[:, 0], part.zmp[:, 1], linewidth=0.3)
plt.axis("equal")
plt.xlabel("x [m]")
plt.ylabel("y [m]")
plt.savefig(picture, dpi=150)
