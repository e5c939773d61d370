"""Two runs of a scene beside each other: what an effect changes, what accuracy was delivered. Called, it compares
bags: `library.compare`.
"""

from contact_sim_pkg.public import let_call

let_call(__name__, "contact_sim_pkg.library:compare")
