"""The `bench` command: one sub-command a file, loaded when it is called."""
