"""Tire property files (`.tir`, of the Magic Formula and MF-Swift): read, and turned into scene keys."""
