"""One run as a loop over numbered blocks, without ROS. Called, it runs a scene: `library.run`."""

from contact_sim_pkg.public import let_call

let_call(__name__, "contact_sim_pkg.library:run")
