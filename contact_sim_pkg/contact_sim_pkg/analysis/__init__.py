"""Reading recorded runs: series, metrics, summary numbers and the HTML report. Never imports ROS."""
