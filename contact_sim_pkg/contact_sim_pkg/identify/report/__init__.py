"""Tables and pictures of `bench identify`."""
