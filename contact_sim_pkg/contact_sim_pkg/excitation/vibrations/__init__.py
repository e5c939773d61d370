"""The vibrations of a scene, a module each: its name is the kind, its `KIND` the class of the section."""
