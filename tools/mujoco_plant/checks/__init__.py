"""Checks of the models that the MuJoCo plant makes of URDFs; `test_urdf_model.py` runs them."""
