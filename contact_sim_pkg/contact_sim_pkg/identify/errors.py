"""What can be wrong with the input of an identification; the text is one sentence for a person."""

from contact_sim_pkg.files import RefusedError


class IdentificationError(RefusedError, ValueError):
    """States, geometry, wrench or noise that nothing can be identified from."""
