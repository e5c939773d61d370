"""The pressure of a contact on a grid: influence by FFT, solver, sequence of a rolling contact."""
