"""`make measures`: the shape of the package beside what is wanted. With a name of `LISTS`: what one measure counts."""

import sys

from tests.house.measures import LISTS, measure
from tests.house.source import circles, imports, modules

if len(sys.argv) > 1:
    if sys.argv[1] == "circles":
        sys.stdout.writelines(f"{' '.join(group)}\n" for group in circles(imports(modules())))
    elif sys.argv[1] in LISTS:
        sys.stdout.writelines(f"{line}\n" for line in LISTS[sys.argv[1]](list(modules().values())))
    else:
        sys.exit(f"make measures: {sys.argv[1]} is no measure; there are circles, {', '.join(LISTS)}")
else:
    rows = [("measure", "before", "today", "wanted"), *measure()]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    for row in rows:
        sys.stdout.write("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() + "\n")
