"""Rigs of one mass in which a single law can be measured: impact, slap, stick-slip."""
