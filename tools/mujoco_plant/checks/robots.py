"""The robots that are checked: what their URDFs call the mechanism's joints."""

from plant import SIDES

LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")


def legs(**patterns):
    """A table from the mechanism's joints to a URDF's, with a side's letters in braces."""
    table = {}
    for side in SIDES:
        words = {"side": side, "Side": side.capitalize(), "s": side[0], "S": side[0].upper()}
        table |= {f"{side}_{joint}": pattern.format(**words) for joint, pattern in patterns.items()}
    return table


UNITREE = legs(**{joint: f"{{side}}_{joint}_joint" for joint in LEG}, shoulder="{side}_shoulder_pitch_joint")
UNITREE |= legs(elbow="{side}_elbow_joint")
WAIST = {"waist_roll": "waist_roll_joint", "waist_pitch": "waist_pitch_joint"}
# Joints, trunk, and whether the legs hang on the waist, so that it turns the other way.
ROBOTS = {
    "g1": (UNITREE | WAIST, "torso_link", False),
    "h1_2": (UNITREE, "torso_link", False),
    "limx": (UNITREE | WAIST, "waist_pitch_link", False),
    "gr1t1": (
        UNITREE | WAIST | legs(knee="{side}_knee_pitch_joint", elbow="{side}_elbow_pitch_joint"),
        *("torso_link", False),
    ),
    "jvrc1": (
        legs(hip_pitch="{S}_HIP_P", hip_roll="{S}_HIP_R", hip_yaw="{S}_HIP_Y", knee="{S}_KNEE")
        | legs(ankle_pitch="{S}_ANKLE_P", ankle_roll="{S}_ANKLE_R", shoulder="{S}_SHOULDER_P", elbow="{S}_ELBOW_P")
        | {"waist_pitch": "WAIST_P", "waist_roll": "WAIST_R"},
        *("WAIST_R_S", False),
    ),
    "op3": (
        legs(**{joint: f"{{s}}_{joint.replace('ankle', 'ank')}" for joint in LEG}, shoulder="{s}_sho_pitch"),
        *("body_link", False),
    ),
    "qinglong": (
        legs(hip_roll="J_hip_{s}_roll", hip_yaw="J_hip_{s}_yaw", hip_pitch="J_hip_{s}_pitch", shoulder="J_arm_{s}_01")
        | legs(knee="J_knee_{s}_pitch", ankle_pitch="J_ankel_{s}_pitch", ankle_roll="J_ankel_{s}_roll")
        | {"left_hip_roll": "J_hipl_l_roll", "waist_pitch": "J_waist_pitch", "waist_roll": "J_waist_roll"},
        *("link_base", True),
    ),
    "t1": (
        legs(**{joint: f"{{Side}}_{joint.title()}" for joint in LEG if joint != "knee"}, knee="{Side}_Knee_Pitch")
        | legs(shoulder="{Side}_Shoulder_Pitch"),
        *("Trunk", True),
    ),
    "talos": (
        legs(hip_yaw="leg_{side}_1_joint", hip_roll="leg_{side}_2_joint", hip_pitch="leg_{side}_3_joint")
        | legs(knee="leg_{side}_4_joint", ankle_pitch="leg_{side}_5_joint", ankle_roll="leg_{side}_6_joint")
        | legs(elbow="arm_{side}_4_joint")
        | {"waist_pitch": "torso_2_joint"},
        *("torso_2_link", False),
    ),
}
# Ranges that contradict the other leg's.
RANGES = {"qinglong": {"J_knee_l_pitch": [-0.08727, 2.3562], "J_hip_r_pitch": [-1.8326, 0.7854]}}
