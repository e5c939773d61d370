"""One run as a loop over numbered blocks, without ROS."""
