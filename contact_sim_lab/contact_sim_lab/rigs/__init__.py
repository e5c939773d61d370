"""What is measured of each rig."""
