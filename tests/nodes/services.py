"""Services of the nodes, asked by a client of the tests."""

import time


def connect(spin_until, client, harmless) -> None:
    """Until a service answers this client.

    A server drops its answer where it has not discovered the client's reader within 0.1 s, and a busy machine takes longer.
    So a request that changes nothing, `harmless`, is asked again until one of them is answered.
    """
    spin_until(client.service_is_ready)
    answers, next_at = [], 0.0

    def is_answered() -> bool:
        nonlocal next_at
        if time.monotonic() > next_at:
            answers.append(client.call_async(harmless))
            next_at = time.monotonic() + 1.0
        return any(answer.done() for answer in answers)

    spin_until(is_answered)
