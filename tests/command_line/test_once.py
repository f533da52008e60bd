"""Options are given once, whatever the command, but for those that are lists: none is dropped."""

import pytest
import typer.main

from carom.cli import main
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


def given(option, name):
    return [name] if option.is_flag else [name, "1"]


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_no_option_is_given_twice(words, capsys):
    """Every option of every command, by either of its names, but for lists."""
    options = [each for each in COMMANDS[words].params if each.param_type_name == "option"]
    for option in options:
        if option.multiple:
            continue
        last = (option.opts + option.secondary_opts)[-1]
        assert main([*words, *given(option, option.opts[0]), *given(option, last)]) == 2
        line = capsys.readouterr().err
        assert f"{option.opts[0]}" in line
        assert "given 2 times; leave all but one out" in line
        assert line.count("\n") == 1


@pytest.mark.parametrize(("name", "word"), LISTS.items())
def test_lists_are_given_as_often_as_one_likes(name, word):
    (command,) = (each for words, each in COMMANDS.items() if words[-1] == word)
    (option,) = (each for each in command.params if name in each.opts)
    assert option.multiple


def test_a_list_has_all_that_was_given(capsys):
    assert main(["curve", "--chi", "1", "--chi", "2", "--points", "3"]) == 0
    assert "chi = 1" in (out := capsys.readouterr().out)
    assert "chi = 2" in out
