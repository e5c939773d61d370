"""Records of the laboratory: a study, a goal, a hard case, a published figure."""
