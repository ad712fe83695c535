//! What physics says of any motion: kinematics, Newton–Euler, articulated body, mass matrix, ZMP, support polygon, time scaling.
