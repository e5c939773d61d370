"""The blocks of one topic come from one publisher: what another one sends is told apart before it
counts. Without ROS.
"""

from __future__ import annotations


class SingleSource:
    """Tells the messages of a run's publisher from those of another one.

    A publisher numbers its own messages 1, 2, 3, …, whatever they hold, and reliable delivery keeps
    their order. So the messages of one publisher rise by one each. Those of a second one repeat
    numbers, fall behind, or leap; a leap is also what lost messages look like, and then the graph
    decides: it knows a publisher before its first message is delivered.
    """

    def __init__(self) -> None:
        """Nothing heard."""
        self._last = 0

    def accept(self, number: int | None, publishers: int) -> bool:
        """Whether a message is of the run's publisher.

        Args:
            number: the publisher's own number of the message; None where the middleware does not
            tell it. publishers: publishers of the topic that the graph shows now (0: the publisher
            has left meanwhile).
        """
        alone = publishers <= 1
        if number is None:
            return alone
        follows = self._last > 0 and number == self._last + 1
        if not follows and not (alone and number > self._last):
            return False
        self._last = number
        return True
