"""A bench that is stepped: one run, block by block, under the control of a program."""
