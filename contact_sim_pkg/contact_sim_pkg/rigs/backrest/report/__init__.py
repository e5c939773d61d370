"""Section of the report on the backrest."""
