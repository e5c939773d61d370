"""The live page: the newest second of a bag or of running nodes in a browser on this machine. Without ROS."""
