"""The one error of the set-up: a sentence for the user and the exit status that goes with it."""

MISSING = 2
FAILED = 1


class SetUpError(Exception):
    """Set-up cannot go on; every fault is one sentence that ends in its cure."""

    def __init__(self, *faults: str, status: int = FAILED) -> None:
        super().__init__("\n".join(faults))
        self.faults = faults
        self.status = status
