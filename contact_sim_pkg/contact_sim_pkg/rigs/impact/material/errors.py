"""The one error of measurements that cannot be used."""


class MaterialError(ValueError):
    """A file of impacts or an option that cannot be used: what is wrong, where, the value, what is
    allowed, the cure.
    """
