"""Makes each message definition be parsed once: the nine generators of a build share the trees in the folder IDL_TREES.

Every Python that the build starts imports this module first; it acts in the generators of rosidl alone, which spend nine
tenths of their time in the parser.
"""

import sys

if any("/rosidl_" in word for word in sys.orig_argv):
    import hashlib
    import os
    import pickle
    from pathlib import Path
    from typing import Any

    from rosidl_parser import parser

    parse = parser.get_ast_from_idl_string

    def parsed_once(text: str) -> Any:
        """The syntax tree of a definition, from the folder where another generator has parsed it."""
        tree = Path(os.environ["IDL_TREES"], hashlib.sha256(text.encode()).hexdigest())
        if not tree.exists():
            new = tree.with_suffix(f".{os.getpid()}")
            new.write_bytes(pickle.dumps(parse(text)))
            new.replace(tree)
        return pickle.loads(tree.read_bytes())  # noqa: S301  # written above, by the same build

    parser.get_ast_from_idl_string = parsed_once
