//! What others compute and read with Python: MuJoCo, and PyPI's `mcap`.

mod floors_in_mujoco;
mod imported_robots_walk_in_mujoco;
mod mujoco_agrees;
mod python_reads_recordings;
mod walks_in_mujoco;
