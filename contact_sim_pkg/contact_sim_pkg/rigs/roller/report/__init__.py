"""Section of the report on the roller."""
