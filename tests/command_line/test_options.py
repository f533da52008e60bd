"""Options of all commands: given once but for lists, and whole numbers are such, within limits."""

import pytest
import typer.main

from carom.cli.commands import app

LISTS = {"--chi": "curve", "--psi": "laws", "--fix": "fit", "--column": "fit"}


def commands(group, *path):
    """Yield every command of a group with the words that call it."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, *path, name)
        else:
            yield (*path, name), command


COMMANDS = dict(commands(typer.main.get_command(app)))


def in_words(option, name):
    return [name] if option.is_flag else [name, "1"]


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_no_option_is_given_twice(words, refusal):
    """Every option of every command, by either of its names, but for lists."""
    options = [each for each in COMMANDS[words].params if each.param_type_name == "option"]
    for option in options:
        if option.multiple:
            continue
        last = (option.opts + option.secondary_opts)[-1]
        line = refusal(*words, *in_words(option, option.opts[0]), *in_words(option, last))
        assert f"{option.opts[0]}" in line
        assert "given 2 times; leave all but one out" in line


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_an_option_without_its_value_is_told_once_with_what_it_wants(words, refusal):
    """At the end of a line, and before another option, which is not taken for its value."""
    options = [each for each in COMMANDS[words].params if each.param_type_name == "option"]
    for option in (each for each in options if not each.is_flag):
        name = option.opts[0]
        for line in ([name], [name, "--json"]):
            told = refusal(*words, *line)
            assert told.count(f"{name}: its value is missing; {option.help.rstrip('.')}") == 1
            assert f" {name.strip('-').replace('-', '_')}: missing" not in told


@pytest.mark.parametrize("text", ["-5 rad/s", "-"])
def test_values_may_begin_with_a_hyphen(text, refusal):
    assert "its value is missing" not in refusal("impact", "--spin", text)


@pytest.mark.parametrize(("name", "word"), LISTS.items())
def test_lists_are_given_as_often_as_one_likes(name, word):
    (command,) = (each for words, each in COMMANDS.items() if words[-1] == word)
    (option,) = (each for each in command.params if name in each.opts)
    assert option.multiple


def test_a_list_has_all_that_was_given(run):
    code, out, _ = run("curve", "--chi", "1", "--chi", "2", "--points", "3")
    assert (code, out.count("chi = 1"), out.count("chi = 2")) == (0, 1, 1)


BALL = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2", "--speed", "1 m/s"]
OPTIONS = {
    "points": ["curve", "--chi", "1.44"],
    "elements": ["impact", *BALL, "--method", "halfspace"],
    "steps": ["impact", *BALL, "--method", "halfspace"],
    "advice": ["fit", "--dataset", "kharaz2001"],
    "seed": ["fit", "--dataset", "kharaz2001"],
    "port": ["explore", "--no-open"],
}


@pytest.mark.parametrize("text", ["1_000", "٣٠", "3.0", "1e3", "many", "", "-5", "9" * 30])
@pytest.mark.parametrize(("name", "words"), [*OPTIONS.items(), ("steps", ["verify", "lammps"])])
def test_what_is_no_count_is_refused(refusal, name, words, text):
    line = refusal(*words, f"--{name}", text)
    assert line.startswith(f"carom: {name}: ")
    assert "must be a whole number" in line


def test_points_of_a_curve_have_a_stated_limit(refusal):
    assert "from 2 to 100000" in refusal("curve", "--chi", "1.44", "--points", "100000000")
