"""How far long work is, as a terminal, a pipe or a dumb terminal gets it, byte by byte."""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from textwrap import indent

import pytest
from tests.checks import refused

from carom.io import progress
from carom.io.progress import Place, advancing, place

LONG = """
import sys, time, rich.progress
import carom.io.progress
from carom.io.progress import advancing
carom.io.progress.PATIENCE = dict.fromkeys(carom.io.progress.Place, {patience})
with advancing("impacts", 30, unit="steps") as advance:
    for step in range(30):
        advance(1)
        time.sleep(0.01)
        {more}
print("done", file=sys.stderr)
"""
OWN_TERMINAL = """
import fcntl, signal, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
signal.signal(signal.SIGINT, signal.default_int_handler)  # which a background job would ignore
"""
CONTROL = re.compile(r"\x1b\[([?\d;]*)([A-Za-z])")


def on_terminal(code, *, columns=100, typed=None, **environment):
    """Run a script with a terminal as stderr; return what it got, what stdout got, the status."""
    own, theirs = pty.openpty()
    fcntl.ioctl(own, termios.TIOCSWINSZ, struct.pack("HHHH", 30, columns, 0, 0))
    usual = {name: os.environ[name] for name in os.environ if name not in ("COLUMNS", "LINES")}
    process = subprocess.Popen(
        [sys.executable, "-c", OWN_TERMINAL + code],
        stdin=theirs,
        stdout=subprocess.PIPE,
        stderr=theirs,
        env=usual | {"TERM": "xterm-256color"} | environment,
        start_new_session=True,
    )
    os.close(theirs)
    got = b""
    while True:
        try:
            data = os.read(own, 65536)
        except OSError:  # the other end is closed
            break
        got += data
        if typed and b"left" in got:
            os.write(own, typed)
            typed = None
    os.close(own)
    stdout, _ = process.communicate(timeout=20)
    return got.decode(), stdout.decode(), process.returncode


def screen(text, columns=100):
    """Return the lines a terminal shows in the end, and whether it shows the cursor."""
    lines, row, column, cursor = [""], 0, 0, True
    place = 0
    while place < len(text):
        control = CONTROL.match(text, place)
        if control:
            argument, letter = control.groups()
            if letter == "K":
                assert argument == "2"
                lines[row] = ""
            elif letter == "A":
                row -= int(argument or 1)
            elif argument == "?25":
                cursor = letter == "h"
            else:
                assert letter == "m", control.group()
            place = control.end()
            continue
        letter = text[place]
        place += 1
        if letter == "\r":
            column = 0
        elif letter == "\n":
            row += 1
            lines += [""] * (row == len(lines))
        else:
            lines[row] = lines[row][:column].ljust(column) + letter + lines[row][column + 1 :]
            column += 1
            assert column <= columns, "a line that wraps cannot be erased"
    return [line.rstrip() for line in lines], cursor


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("count", "columns"), [("30", 100), ("None", 100), ("30", 40)], ids=["", "unknown", "narrow"]
)
def test_a_bar_comes_and_goes(count, columns):
    """It shows what is done and what is left of it, if that is known, and leaves a clean line and
    the cursor."""
    code = LONG.format(patience=0.1, more="").replace("30, unit", f"{count}, unit")
    got, _, status = on_terminal(code, columns=columns)
    assert status == 0
    assert screen(got, columns) == (["done", ""], True)
    assert "impacts" in got
    if count == "None":
        assert re.search(r"impacts 30 steps", CONTROL.sub("", got))
    elif columns == 100:
        lines = got.replace("\r", "\n")
        shown = [int(done) for done in re.findall(r"impacts .* (\d+)/30 steps", lines)]
        assert shown[0] > 5, "it takes its time to appear"
        assert shown == sorted(shown)
        assert shown[-1] == 30
        assert re.search(r"0:00:0\d.* left", got)


def test_short_work_shows_nothing():
    got, _, _ = on_terminal(LONG.format(patience=20.0, more=""))
    assert got == "done\r\n"


def test_an_interrupt_leaves_the_terminal_as_it_was():
    long = LONG.replace("30", "1000")  # still at it when the key is pressed
    got, _, status = on_terminal(long.format(patience=0.1, more=""), typed=b"\x03")
    lines, cursor = screen(got)
    assert status != 0
    assert cursor
    assert lines[0].removeprefix("^C") == "Traceback (most recent call last):"
    assert "KeyboardInterrupt" in lines
    assert not [line for line in lines if "steps" in line]


def test_an_error_leaves_the_terminal_as_it_was():
    more = "if step == 15: raise RuntimeError('no')"
    got, _, status = on_terminal(LONG.format(patience=0.05, more=more))
    lines, cursor = screen(got)
    assert status == 1
    assert "16/30" in got
    assert lines[0] == "Traceback (most recent call last):"
    assert (lines[-2], cursor) == ("RuntimeError: no", True)


def test_a_killed_process_leaves_the_cursor():
    code = LONG.format(patience=0.1, more="if step == 20: os.kill(os.getpid(), 9)")
    got, _, status = on_terminal("import os\n" + code)
    assert status == -9
    assert screen(got)[1]


def test_redirected_output_gets_all_and_only_what_is_printed():
    """As with `carom ... --json > file`, while stderr is the terminal."""
    more = "print(step)"
    got, stdout, _ = on_terminal(LONG.format(patience=0.05, more=more))
    assert stdout.split() == [str(step) for step in range(30)]
    assert "30/30" in got


def test_a_dumb_terminal_gets_no_control_sequences():
    got, _, _ = on_terminal(LONG.format(patience=0.1, more=""), TERM="dumb")
    assert "30/30" in got
    assert "\x1b" not in got


def test_work_within_work_has_no_bar_of_its_own():
    """And a bar does not wait for the end of the first step."""
    code = "import time, carom.io.progress as p\np.PATIENCE = dict.fromkeys(p.Place, 0.1)\n"
    code += "with p.advancing('outer', 2):\n    with p.advancing('inner', 3) as advance:\n"
    code += "        advance(1); time.sleep(0.3); advance(2)\n"
    code += "with p.advancing('after', 2):\n    time.sleep(0.3)"
    got, _, _ = on_terminal(code)
    assert "outer" in got
    assert "inner" not in got
    assert re.search("after.*0/2", got)


LINE = re.compile(r"impacts: \d+/30 steps, \d:\d\d:\d\d (left|passed)")


def test_a_pipe_gets_nothing_unless_asked():
    """Of a call; what it gets then, and what commands write, are plain lines."""
    work = LONG.format(patience=0.05, more="")
    asked = (work.replace("30, unit", f"30, {progress}, unit") for progress in (None, False, True))
    told = f"from carom.io.progress import telling\nwith telling():\n{indent(work, '    ')}"
    env = {**os.environ, "FORCE_COLOR": "1"}
    line = [sys.executable, "-c", "".join([*asked, told])]
    run = subprocess.run(line, capture_output=True, text=True, env=env)
    by_default, unwanted, wanted, of_command, end = run.stderr.split("done\n")
    assert by_default == unwanted == end == run.stdout == ""
    for lines in (wanted.splitlines(), of_command.splitlines()):
        assert all(map(LINE.fullmatch, lines)), lines
        assert lines[-1] == "impacts: 30/30 steps, 0:00:00 left"
        assert int(lines[0].split()[1].split("/")[0]) > 3, "it takes its time to appear"


def test_lines_come_every_ten_seconds(monkeypatch, capsys):
    """By a clock of the test; the time left is that of the steps so far."""
    clock = iter([10.0, 20.0, 25.0])
    waits = []

    class Over:
        def wait(self, seconds):
            waits.append(seconds)
            return len(waits) == 3

    monkeypatch.setattr("carom.io.progress.monotonic", lambda: next(clock))
    work = progress._Work("impacts", "points", 1000, 400, 0.0)
    advances = iter([100, 100, 400])
    line = work.line
    monkeypatch.setattr(work, "line", lambda: (work.advance(next(advances)), line())[1])
    progress._paint(Place.TEXT, work, Over())
    assert waits == [10.0, 10.0, 10.0]
    assert capsys.readouterr().err.splitlines() == [
        "impacts: 500/1,000 points, 0:00:50 left",
        "impacts: 600/1,000 points, 0:00:40 left",
        "impacts: 1,000/1,000 points, 0:00:00 left",
    ]


@pytest.mark.slow
def test_a_command_shows_how_far_it_is():
    """`carom verify laws` prints its table to a file, and its bar on the terminal."""
    code = "import carom.io.progress as p, sys\np.PATIENCE = dict.fromkeys(p.Place, 0.0)\n"
    code += "from carom.cli import main\nsys.exit(main(['verify', 'laws', '--psi', '1', '--json']))"
    got, stdout, status = on_terminal(code)
    laws = len(json.loads(stdout)["laws"])
    assert f"{laws}/{laws} laws" in got
    assert status == 0
    assert screen(got)[1]


def test_a_callable_is_told():
    calls = []
    with advancing("impacts", 5, lambda *said: calls.append(said), done=1) as advance:
        advance(2)
        advance(2)
    assert calls == [(3, 5), (5, 5)]


def test_what_is_no_answer_is_refused():
    words = "^progress: 'yes' cannot be used; must be True, False"
    refused(words, advancing, "impacts", 5, "yes")


def test_without_stderr_nothing_is_shown(monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)
    assert place(None) is Place.NOWHERE
