"""Effects that act as elements between the masses of a vehicle: the keys of each, and its kernels beside them."""
