"""Roller on a rotating shaft: rolling vibro-impact, tilt and yaw, damage, corrugation."""
