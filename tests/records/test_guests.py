"""Code of others while it is imported: what would end the process, or never end, is an error with a phrase."""

import signal
import sys
import threading
import time

import pytest

from contact_sim_pkg.records.guests import GuestError, guest

pytestmark = pytest.mark.fault("G14")


def interrupt():
    raise KeyboardInterrupt


def spin():
    while True:
        pass


def insist():
    try:
        time.sleep(LONG)
    except BaseException:  # noqa: BLE001 - as hostile code may
        time.sleep(LONG)


LONG = 100.0
ENDING = [(interrupt, "KeyboardInterrupt"), (lambda: sys.exit(3), "SystemExit: 3"), (lambda: quit(), "SystemExit")]
ENDLESS = [spin, insist, lambda: time.sleep(LONG), lambda: threading.Event().wait()]


@pytest.mark.parametrize(("act", "phrase"), ENDING)
def test_what_would_end_the_process_is_an_error(act, phrase):
    with pytest.raises(GuestError, match=phrase), guest():
        act()


@pytest.mark.parametrize("act", ENDLESS)
def test_what_never_ends_is_broken_off_and_the_signals_are_as_before(monkeypatch, act):
    monkeypatch.setattr("contact_sim_pkg.records.guests._AGAIN", 0.05)
    before = [signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGINT)]
    with pytest.raises(GuestError, match=r"it did not end within 0\.05 s"), guest(0.05):
        act()
    assert [signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGINT)] == before
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_the_interrupt_of_the_user_stays_one(request):
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # tests in the background ignore it
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    with pytest.raises(KeyboardInterrupt), guest(LONG):
        signal.raise_signal(signal.SIGINT)


def test_an_ordinary_error_stays_what_it_is():
    with pytest.raises(LookupError, match="of its own"), guest(LONG):
        raise LookupError("of its own")


def test_what_is_printed_is_kept_from_standard_output(capsys):
    with guest() as printed:
        print("hello")  # noqa: T201
    assert (printed.getvalue(), capsys.readouterr().out) == ("hello\n", "")


def test_in_another_thread_there_is_no_limit_and_the_rest_holds():
    found = []

    def act():
        try:
            with guest(0.01):
                time.sleep(0.05)
                interrupt()
        except GuestError as error:
            found.append(str(error))

    thread = threading.Thread(target=act)
    thread.start()
    thread.join()
    assert found == ["KeyboardInterrupt"]
