"""Section of the report on the rigid body."""
