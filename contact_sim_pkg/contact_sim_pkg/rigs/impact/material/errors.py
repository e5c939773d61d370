"""The one error of measurements that cannot be used."""

from contact_sim_pkg.files import RefusedError


class MaterialError(RefusedError, ValueError):
    """A file of impacts or an option that cannot be used: what is wrong, where, the value, what is
    allowed, the cure.
    """
