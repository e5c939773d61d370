"""Pressure field of a foam cushion of finite thickness, and the force law that is its integral."""
