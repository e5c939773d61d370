"""`bench goals`: measured figures beside their goals."""
