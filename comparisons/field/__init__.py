"""The pressure field solved by this project and by others, on the same problems, in one run: `make compare-field`."""
