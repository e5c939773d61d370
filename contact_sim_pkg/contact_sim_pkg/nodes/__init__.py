"""The ROS nodes and the supervisor of a run. Only this package and `launch/` know ROS;
`docs/nodes.md` describes the protocol.
"""

import sys

from contact_sim_pkg.python_process import disregard_current_folder
from contact_sim_pkg.requirements import end_with_sentence

if sys.argv[:1] == ["-m"]:  # `python -m contact_sim_pkg.nodes.NODE`, which is imported after its package
    sys.excepthook = end_with_sentence
    disregard_current_folder()
