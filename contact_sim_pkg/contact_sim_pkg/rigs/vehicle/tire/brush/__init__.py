"""Brush friction of the rolling tire: bristles that stick and slip, one a cell of the field."""
