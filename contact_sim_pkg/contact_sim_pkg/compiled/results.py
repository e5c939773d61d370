"""Status codes of the kernels, each with its sentence."""

from __future__ import annotations

DONE = 0
NOT_FINITE = 1
STEP_TOO_SMALL = 2
TOO_MANY_EVENTS = 3

SENTENCES = {
    DONE: "the interval was integrated to the requested tolerance",
    NOT_FINITE: "the state is not finite or beyond 1e10: the parameters or the excitation are outside the model",
    STEP_TOO_SMALL: "the time step that the requested tolerance needs is below the resolution of the clock; request less accuracy",
    TOO_MANY_EVENTS: "contact opened and closed more than 10000 times in one interval; it is too stiff for this excitation",
}
