"""Signal processing of recorded series."""
