"""YAML 1.2 with line marks, within bounds."""
