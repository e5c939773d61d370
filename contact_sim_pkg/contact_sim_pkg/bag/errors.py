"""Errors of messages and bags; the text of each error is one sentence for a person."""

from contact_sim_pkg.files import RefusedError


class BagError(RefusedError):
    """A bag, or something in it, is refused."""


class MessageError(BagError):
    """Bytes that are not the expected message, or values that do not fit it."""


class UnreadableTypeError(BagError):
    """Messages of a type that the bag does not define, or in an encoding that is not read."""


class BagWriteError(BagError):
    """The operating system refused a write; what was written before stays readable."""


class RecordingStoppedError(BagError):
    """The recording was closed properly because the disk has less free space than its reserve."""


class CorruptChunkError(BagError):
    """A chunk fails its checksum or cannot be unpacked; `start` and `end` are its log times in
    [ns].
    """

    def __init__(self, sentence: str, start: int, end: int) -> None:
        """Keep the time range beside the sentence."""
        super().__init__(sentence)
        self.start, self.end = start, end
