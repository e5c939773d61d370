"""Work and precision, goals and hard cases of the identification."""
