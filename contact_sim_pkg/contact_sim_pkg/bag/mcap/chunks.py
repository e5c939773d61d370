"""The content of one chunk: unpacked within limits, and the sentence where it is damaged."""

from dataclasses import replace

import lz4.frame  # type: ignore[import-untyped]
import zstandard
from mcap.records import Chunk

from contact_sim_pkg.bag.errors import CorruptChunkError

LARGEST_RECORD = 256 << 20  # [bytes] of one record, packed or unpacked; our chunks are closed at 4 MiB


def decompressed(chunk: Chunk) -> Chunk:
    """The chunk with its content unpacked; ValueError where that is damaged or larger than stated
    or allowed.
    """
    if chunk.uncompressed_size > LARGEST_RECORD:
        raise ValueError(f"it claims {chunk.uncompressed_size} bytes, limit {LARGEST_RECORD}")
    content = _unpack(chunk.compression, chunk.data, chunk.uncompressed_size)
    if len(content) != chunk.uncompressed_size:
        raise ValueError(f"it unpacks to {len(content)} bytes, not to {chunk.uncompressed_size}")
    return replace(chunk, compression="", data=content)


def _unpack(compression: str, data: bytes, size: int) -> bytes:
    if compression == "":
        return data
    try:
        if compression == "zstd":
            return zstandard.ZstdDecompressor().stream_reader(data).read(size + 1)
        if compression == "lz4":
            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=size + 1))
    except (zstandard.ZstdError, RuntimeError, EOFError) as error:
        raise ValueError(str(error)) from None
    raise ValueError(f"its compression {compression!r} is unknown; zstd, lz4 and none are known")


def damaged(name: str, offset: int, start: int, end: int, error: Exception) -> CorruptChunkError:
    """The error of a damaged chunk: its place, the time that it covers, the reason."""
    reason = str(error) or type(error).__name__
    return CorruptChunkError(
        f"{name}: the chunk at byte {offset}, messages of {start / 1e9:.3f} s to {end / 1e9:.3f} s, is damaged "
        f"({reason}); reading stops there unless bad chunks are skipped",
        start,
        end,
    )
