"""A scene as a co-simulation unit (FMU): what it holds, how it is written, and the process that steps it."""
