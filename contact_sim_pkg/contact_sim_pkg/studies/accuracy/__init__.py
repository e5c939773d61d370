"""`bench accuracy`: error beside time, of a scene and of a rig."""
