"""Cases of the force laws."""
