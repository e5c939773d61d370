"""Slow twins: bodies that fall and strike."""
