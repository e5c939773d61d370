"""Reader of OpenCRG road files."""
