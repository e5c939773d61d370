"""Section of the report on the ride."""
