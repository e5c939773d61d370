"""Tables of a bag as Markdown: `bench export BAG --format md`."""

from typing import IO

from contact_sim_pkg.report.export.table import TopicTable


def export(table: TopicTable, stream: IO[bytes]) -> None:
    """A line of headers, and a line a row."""
    rows = [[column.header for column in table.columns], ["---"] * len(table.columns)]
    rows += zip(*(column.values for column in table.columns), strict=True)
    stream.writelines(f"| {' | '.join(map(str, row))} |\n".encode() for row in rows)
