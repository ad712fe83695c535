"""The MuJoCo plant's process: `python tools/mujoco_plant`, as `halfstep plant --engine mujoco` starts it."""

from plant.serve import serve

serve()
