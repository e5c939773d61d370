"""The scene as a schema: keys with type, unit, range, default and meaning, and the rules between
them.
"""
