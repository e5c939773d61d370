"""Section of the report on the tire."""
