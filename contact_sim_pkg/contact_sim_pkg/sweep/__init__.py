"""Many cases of a scene: what varies, the pool that runs them, the table of what they gave. Never imports ROS."""

from contact_sim_pkg.public import let_call

let_call(__name__, "contact_sim_pkg.library:sweep")
