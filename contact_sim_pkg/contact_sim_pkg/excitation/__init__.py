"""Excitation: roads as heights over position, vibration as acceleration over time, both cut into
numbered blocks.
"""
