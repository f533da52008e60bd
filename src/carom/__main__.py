"""The commands, as `python -m carom`."""

from carom.cli import run

if __name__ == "__main__":
    run()
