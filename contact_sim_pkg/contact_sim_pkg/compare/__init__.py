"""Two runs of a scene beside each other: what an effect changes, what accuracy was delivered."""
