//! What others compute and read with Python: MuJoCo, and PyPI's `mcap`.

mod mujoco_agrees;
mod python_reads_recordings;
mod walks_in_mujoco;
