"""How the cost of a run grows, for `bench growth`."""
