"""The ROS nodes and the supervisor of a run. Only this package and `launch/` know ROS;
`docs/nodes.md` describes the protocol.
"""
