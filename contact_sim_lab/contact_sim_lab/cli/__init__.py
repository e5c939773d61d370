"""Commands of `bench` that the laboratory brings."""
