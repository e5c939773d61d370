"""Messages, topics and bags, free of ROS: what is recorded, how it is encoded, written, read and
recovered.
"""
