"""Where the command `bench` begins: it imports nothing before a Ctrl-C is looked after."""


def main() -> int:
    """Run `bench`, see `cli.main`; 0 where it is interrupted while its modules are read."""
    try:
        from contact_sim_pkg.cli.main import main as bench
    except KeyboardInterrupt:
        return 0
    return bench()
