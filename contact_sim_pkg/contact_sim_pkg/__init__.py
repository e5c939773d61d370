"""Contact forces and pressure fields of simulated rigs, as ROS 2 topics and bags."""

__version__ = "0.1.0"
