"""Material constants from measured impacts: `bench material`."""
