"""The rigs of the bench, a folder each: physics, scene keys, outputs, report, studies."""
