"""Section of the report on impacts."""
