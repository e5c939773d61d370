"""A pseudo-terminal that keeps what is drawn on it."""

import os
import threading
from contextlib import suppress


class Terminal:
    """Write to `stream`; at the end `drawn` holds the text, control sequences included."""

    def __enter__(self) -> "Terminal":
        self._reading, writing = os.openpty()
        self.stream = open(writing, "w")
        self._pieces: list[bytes] = []
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        return self

    def _read(self) -> None:
        with suppress(OSError):  # the other end is closed
            while True:
                self._pieces.append(os.read(self._reading, 65536))

    def __exit__(self, *_: object) -> None:
        self.stream.close()
        self._reader.join()
        os.close(self._reading)
        self.drawn = b"".join(self._pieces).decode()
