"""Shells complete commands, options, names and files: by the protocol, and in the shells."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import typer.main
from tests.command_line.test_options import COMMANDS

import carom
from carom.cli import main
from carom.cli.commands import app

SHELLS = ("bash", "zsh", "fish")
GROUPS = [
    (),
    *(
        (name,)
        for name, each in typer.main.get_command(app).commands.items()
        if hasattr(each, "commands")
    ),
]
VALUES = {
    ("impact", "--material"): {*carom.materials(), "rigid"},
    ("impact", "--second-material"): {*carom.materials(), "rigid"},
    ("impact", "--against"): {"half-space", "sphere", "cup"},
    ("impact", "--method"): {"exact", "halfspace"},
    ("materials",): {*carom.materials(), "rigid"},
    ("fit", "--dataset"): {*carom.datasets.names()},
    ("curve", "--export"): {"c"},
    ("verify", "tune", "--measure"): {"max", "rms"},
    ("verify", "laws", "--law"): {
        "mindlin",
        "mindlin/force",
        "mindlin_rescale",
        "carom",
        "mindlin_rescale/force",
    },
    ("lammps", "build", "--sizes"): {"smallbig", "bigbig"},
}
FILES = (("impact",), ("sweep",), ("fit",), ("track",), ("impact", "--plot"), ("verify", "score"))


@pytest.fixture
def asked(monkeypatch, capsys):
    """What a shell is answered that asks what the last word may become."""

    def ask(*words, shell="bash"):
        line = ["carom", *words]
        monkeypatch.setenv("_CAROM_COMPLETE", f"complete_{shell}")
        monkeypatch.setenv("COMP_WORDS", "\n".join(line))
        monkeypatch.setenv("COMP_CWORD", str(len(words)))
        monkeypatch.setenv("_TYPER_COMPLETE_ARGS", " ".join(line))
        monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "get-args")
        with pytest.raises(SystemExit) as end:
            main([])
        out, err = capsys.readouterr()
        assert (end.value.code, err) == (0, "")
        return out.split("\n")[:-1] if out.strip() else []

    return ask


@pytest.mark.parametrize("path", GROUPS, ids=" ".join)
def test_commands_are_completed(path, asked):
    group = typer.main.get_command(app)
    for name in path:
        group = group.commands[name]
    assert asked(*path, "") == list(group.commands)
    for name in group.commands:
        assert name in asked(*path, name[:2])


@pytest.mark.parametrize("shell", ["bash", "fish"])
@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_all_options_are_completed(words, shell, asked):
    """And nothing else; help, which would be wrapped into further words, is left out."""
    options = {
        name
        for each in COMMANDS[words].params
        if each.param_type_name == "option"
        for name in (*each.opts, *each.secondary_opts)
    }
    assert {*asked(*words, "--", shell=shell)} == options | {"--help"}


@pytest.mark.parametrize("words", VALUES, ids=" ".join)
def test_names_are_completed(words, asked):
    names = VALUES[words]
    assert {*asked(*words, "")} == names
    first = sorted(names)[0]
    assert {*asked(*words, first[:2])} == {name for name in names if name.startswith(first[:2])}


@pytest.mark.parametrize(
    ("shell", "words", "answer"),
    [
        ("fish", ["--material=sta"], "--material=stainless-steel"),
        ("zsh", ["--material=sta"], """_arguments '*: :(("--material=stainless-steel"))'"""),
        ("bash", ["--material=sta"], "--material=stainless-steel"),
        ("bash", ["--material", "=", "sta"], "stainless-steel"),  # which it makes of it by default
    ],
)
def test_a_value_behind_an_equals_sign_is_completed(shell, words, answer, asked):
    assert asked("impact", *words, shell=shell) == [answer]


@pytest.mark.parametrize("words", FILES, ids=" ".join)
@pytest.mark.parametrize("shell", SHELLS)
def test_files_are_left_to_the_shell(words, shell, asked):
    answer = asked(*words, "ball", shell=shell)
    assert answer == (["_files"] if shell == "zsh" else [])


def test_a_faulty_line_is_completed_as_well(asked):
    line = ("impact", "--colour", "red", "--friction", "-1", "x", "y", "--sp")
    assert {"--speed", "--spin"} <= {*asked(*line)}


@pytest.mark.parametrize("shell", SHELLS)
def test_the_script_is_that_of_the_shell(shell, run):
    code, out, err = run("--show-completion", shell)
    assert (code, err) == (0, "")
    mark = {"bash": "complete -o default", "zsh": "#compdef carom", "fish": "complete --command"}
    assert mark[shell] in out
    assert "_CAROM_COMPLETE" in out


@pytest.mark.parametrize("option", ["--show-completion", "--install-completion"])
def test_a_shell_that_is_not_known_takes_one_line(option, refusal, monkeypatch):
    """None around this process, and none that SHELL names; or one that is not supported."""
    shellingham = pytest.importorskip("shellingham")

    def none():
        raise shellingham.ShellDetectionFailure

    monkeypatch.setattr(shellingham, "detect_shell", none)
    monkeypatch.delenv("SHELL", raising=False)
    words = f"give one, e.g. carom {option} bash, zsh or fish"
    assert refusal(option) == f"carom: {option}: the shell is not known; {words}\n"
    monkeypatch.setenv("SHELL", "/bin/tcsh")
    assert refusal(option) == f"carom: {option}: 'tcsh' is not supported; {words}\n"
    assert refusal(option, "ksh") == f"carom: {option}: 'ksh' is not supported; {words}\n"


@pytest.mark.parametrize("shell", SHELLS)
def test_installing_says_where_the_script_is(shell, run, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    code, out, err = run("--install-completion", shell)
    assert (code, out) == (0, "")
    path = Path(err.removeprefix("Carom has stored ").split(";")[0])
    assert path.is_relative_to(tmp_path)
    assert "_CAROM_COMPLETE" in path.read_text()


def test_a_home_that_is_no_folder_takes_one_line(refusal, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("HOME", str(tmp_path / "file"))
    assert "cannot be written; " in refusal("--install-completion", "bash")


@pytest.fixture
def shell_folder(tmp_path):
    """A folder with a case, a program carom to find, and an environment for a shell there."""
    program = tmp_path / "bin" / "carom"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m carom "$@"\n')
    program.chmod(0o755)
    (tmp_path / "ball.toml").touch()
    path = f"{program.parent}:{os.environ['PATH']}"
    return tmp_path, os.environ | {"PATH": path, "HOME": str(tmp_path)}


BASH = """
source <(carom --show-completion bash)
for line in 'carom im' 'carom impact --sec' 'carom impact --material sta' \
  'carom impact --material = sta' 'carom impact ball'; do
COMP_WORDS=($line); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMPREPLY=(); _carom_completion carom
echo ${COMPREPLY[@]}
done
"""
FISH = """
carom --show-completion fish | source
for line in 'carom im' 'carom impact --sec' 'carom impact --material sta' \
  'carom impact --material=sta' 'carom impact ball'
echo (complete -C $line)
end
"""
ZSH = """
zmodload zsh/zpty
zpty z zsh -i
sleep 2
for line in 'carom im' 'carom impact --sec' 'carom impact --material sta' \
  'carom impact --material=sta' 'carom impact ball'; do
zpty -w -n z "$line"$'\\t'
sleep 4
zpty -w -n z $'\\x15'
done
while zpty -r -t z out; do print -rn -- "$out"; done
zpty -d z
"""
COMPLETED = ["impact", "--second-radius --second-material", "stainless-steel"]


@pytest.mark.slow
@pytest.mark.parametrize(("shell", "script"), [("bash", BASH), ("fish", FISH)])
def test_shells_take_what_the_script_says(shell, script, shell_folder):
    """Bash completes files where nothing is answered, as told by -o default; fish does here."""
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell}")
    folder, environment = shell_folder
    done = subprocess.run([shell, "-c", script], cwd=folder, env=environment, capture_output=True)
    lines = [sorted(line.split()) for line in done.stdout.decode().splitlines()]
    behind = ["--material=stainless-steel" if shell == "fish" else "stainless-steel"]
    assert lines[:4] == [*(sorted(each.split()) for each in COMPLETED), behind]
    assert lines[4] == (["ball.toml"] if shell == "fish" else [])


@pytest.mark.slow
def test_zsh_completes_from_the_first_tab_on(shell_folder):
    """With the script installed, in a shell that is typed into."""
    if shutil.which("zsh") is None:
        pytest.skip("there is no zsh")
    folder, environment = shell_folder
    install = ["carom", "--install-completion", "zsh"]
    subprocess.run(install, env=environment, check=True, capture_output=True)
    done = subprocess.run(["zsh", "-c", ZSH], cwd=folder, env=environment, capture_output=True)
    shown = done.stdout.decode(errors="replace")
    texts = ("carom impact", "--second-", "--material stainless-steel", "impact ball.toml")
    for text in (*texts, "--material=stainless-steel"):
        assert text in shown, shown
