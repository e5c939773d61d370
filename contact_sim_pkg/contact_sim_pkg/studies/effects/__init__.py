"""`bench effects`: cost and action of each effect."""
