"""What `halfstep` and this process tell each other, through stdin and stdout.

1. `halfstep` writes one line of JSON (see `Robot.__init__`), this process answers with one (`hello`).
2. Then, per control period, `halfstep` writes a setpoint and this process answers with a state: little-endian doubles,
   laid out as in `SETPOINT` and `STATE`. Where the robot's world has changed, the setpoint is followed by a JSON object:
   `"floor"` is there if the robot has come to other ground, `"pushes"` are new ones, both in the form of the first
   message's. When stdin ends, so does this process.

The robot comes in one of two forms. `"mjcf"` is a complete model of the twenty-joint mechanism. `"urdf"`, with
`"urdf_setup"`, is a vendor's URDF. README.md lists what `"urdf_setup"` contains.

`"floor"` is a list of convex bodies, each with a place `at`, `vertices` from there (m) and `friction`; empty for a plane,
which then is part of the model.
"""

PROTOCOL = 5
JOINTS = 20
# angles, rates, feed-forward torques; control periods since the plant's start; number of bytes of a change that follows
SETPOINT = 3 * JOINTS + 2
# right sole: place, quaternion w x y z, angular rate, velocity; angles, rates; ground's force and moment on the right
# and on the left foot, about the right sole's origin; motor torques. All but the joints' in world axes.
STATE = 3 + 4 + 3 + 3 + 2 * JOINTS + 2 * 6 + JOINTS
# The joints with motors, the last of the twenty, in the order of setpoints and states.
POWERED = (
    *("right_ankle_roll", "right_ankle_pitch", "right_knee", "right_hip_pitch", "right_hip_yaw", "right_hip_roll"),
    *("left_hip_roll", "left_hip_yaw", "left_hip_pitch", "left_knee", "left_ankle_pitch", "left_ankle_roll"),
    *("waist_pitch", "waist_roll", "right_shoulder", "right_elbow", "left_shoulder", "left_elbow"),
)
SIDES = ("right", "left")
