"""What can be wrong with the input of an identification; the text is one sentence for a person."""


class IdentificationError(ValueError):
    """States, geometry, wrench or noise that nothing can be identified from."""
