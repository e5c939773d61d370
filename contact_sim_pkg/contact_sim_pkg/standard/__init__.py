"""The bench's messages as standard messages of ROS, for RViz, Foxglove, PlotJuggler and rqt. Without ROS."""
