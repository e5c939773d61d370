"""Commands on the numbers of bags."""
