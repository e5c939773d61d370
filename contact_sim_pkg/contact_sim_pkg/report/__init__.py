"""Report of a recorded run: reading, series, figures, the HTML page. Never imports ROS."""
