"""Makes the environment and builds the workspace: what `make setup` runs. Standard library only."""
