"""Materials from measured impacts: reading, each impact, repeated impacts, master curve."""
