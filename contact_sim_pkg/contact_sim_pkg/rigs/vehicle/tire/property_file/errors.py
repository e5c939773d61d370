"""The one error of a tire property file that cannot be used."""

from contact_sim_pkg.files import RefusedError


class PropertyFileError(RefusedError, ValueError):
    """A file, or a tire in it, that cannot be used: what is wrong, where, the value, what is allowed."""
