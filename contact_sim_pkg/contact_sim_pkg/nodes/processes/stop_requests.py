"""Requests of the user to end a supervised run, handed on to its processes. Without ROS."""

from __future__ import annotations

from contact_sim_pkg.nodes.processes.children import GRACE_SECONDS, Children

NODES_SECONDS = 0.9  # after the first request, for the simulator to end the run; then every process gets a request
STOP_SECONDS = 1.7  # after the first request, for all processes to end; then they are killed
LEAST_GRACE = 0.1  # from SIGTERM to SIGKILL


class StopRequests:
    """Counts the requests; a run under way is first ended by its simulator, so that the bag is
    whole.
    """

    def __init__(self) -> None:
        """No request."""
        self._count, self._handed_on, self._first_at = 0, 0, float("inf")

    def add(self) -> None:
        """One more request; may be called from a signal handler."""
        self._count += 1

    @property
    def any(self) -> bool:
        """Whether a request was handed on."""
        return self._handed_on > 0

    def hand_on(self, children: Children, now: float, *, under_way: bool) -> None:
        """Request the simulator of a run `under_way` to end, or else every process; `now`: steady
        clock, [s].
        """
        if self._handed_on == 1 and now > self._first_at + NODES_SECONDS:
            self._count += 1
        if self._count > self._handed_on:
            self._handed_on, self._first_at = self._count, min(self._first_at, now)
            children.request_end(*(("contact_simulator",) if under_way and self._handed_on == 1 else ()))

    def expired(self, now: float) -> bool:
        """Whether the time for the processes to end by themselves is over; `now`: steady clock,
        [s].
        """
        return now > self._first_at + STOP_SECONDS

    def grace(self, now: float) -> float:
        """Time in [s] from SIGTERM to SIGKILL of the processes left; `now`: steady clock,
        [s].
        """
        return max(LEAST_GRACE, min(GRACE_SECONDS, self._first_at + STOP_SECONDS - now))
