"""The one error of bad excitation input."""

from contact_sim_pkg.files import RefusedError


class ExcitationError(RefusedError, ValueError):
    """A road, a signal or a speed programme that cannot be used.

    The text is one sentence that says what is wrong, where (file and line or byte), the value, what
    is allowed and the cure.
    """
