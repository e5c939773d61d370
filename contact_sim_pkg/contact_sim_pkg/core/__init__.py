"""Compiled contact mechanics: numbers and arrays in, numbers and arrays out; no settings, no files of the user, no ROS."""
