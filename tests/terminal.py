"""A pseudo-terminal that keeps what is drawn on it."""

import os
import threading

END = b"\x00"


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
        while not b"".join(self._pieces[-2:]).endswith(END):
            self._pieces.append(os.read(self._reading, 65536))

    def __exit__(self, *_: object) -> None:
        # what is still on its way is lost where the other end closes
        self.stream.write(END.decode())
        self.stream.flush()
        self._reader.join()
        self.stream.close()
        os.close(self._reading)
        self.drawn = b"".join(self._pieces).decode().removesuffix(END.decode())
