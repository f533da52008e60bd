"""All commands, and what they answer to arguments that cannot be used."""

from functools import cache
from typing import Any

import typer

import carom
from carom.cli import INTERRUPTED, completion
from carom.cli.curve import curve_command
from carom.cli.explore import explore_command
from carom.cli.fit import fit_command
from carom.cli.impact import impact_command
from carom.cli.materials import materials_command
from carom.cli.options import Commands, Group, Interrupted, option_meant
from carom.cli.programs import lammps_app, liggghts_app
from carom.cli.sweep import sweep_command
from carom.cli.track import track_command
from carom.cli.verify import app as verify_app
from carom.io.paths import reading_standard_input
from carom.io.progress import telling
from carom.io.remedies import SHELL, offering
from carom.quantities.refusals import InputError

INSTALL, SHOW = "--install-completion", "--show-completion"
SHELL_GIVEN = "carom.shell"  # in `meta` of the context


class Program(Group):
    """All commands; the name of a shell may follow the options for completion."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Keep the name of a shell, which is no command."""
        named = len(args) == 2 and args[0] in (INSTALL, SHOW)
        ctx.meta[SHELL_GIVEN] = args[1] if named else ""
        return super().parse_args(ctx, args[:1] if named else args)


app = Commands(
    "carom",
    "Carom computes how an elastic sphere leaves an oblique impact, and what happens inside "
    "the contact.\n\n"
    "Begin with carom impact for one impact, carom sweep for many, carom fit for measured "
    "rebounds, carom verify for contact laws of DEM codes, or carom explore for a page in the "
    "browser. carom COMMAND --help describes a command. In place of a FILE that is read, - is the "
    "standard input. The exit code is 0, 2 for input that "
    "cannot be used, 1 for a failure, or 130 after Ctrl-C.\n\n\b\n"
    'Example: carom impact --radius "5 mm" --material steel --friction 0.2 --speed 2 '
    '--angle "30 deg"',
    Program,
)
app.command("impact")(impact_command)
app.command("curve")(curve_command)
app.command("sweep")(sweep_command)
app.command("fit")(fit_command)
app.command("track")(track_command)
app.command("explore")(explore_command)
app.command("materials")(materials_command)
app.add_typer(verify_app)
app.add_typer(lammps_app)
app.add_typer(liggghts_app)


@app.callback(invoke_without_command=True)
def _common(
    context: typer.Context,
    version: bool = typer.Option(False, "--version", help="Print the version and exit."),
    install: bool = typer.Option(
        False, INSTALL, help="Let your shell complete commands, options and names, and exit."
    ),
    show: bool = typer.Option(False, SHOW, help="Print the script that does it, and exit."),
) -> None:
    if version:
        typer.echo(carom.__version__)
    if install:
        completion.install(completion.shell_of(INSTALL, context.meta[SHELL_GIVEN]))
    if show:
        completion.show(completion.shell_of(SHOW, context.meta[SHELL_GIVEN]))
    if version or install or show:
        raise typer.Exit


@cache
def _built() -> Any:
    """Return all commands with their options, which takes longer than most of them."""
    return typer.main.get_command(app)


def answer(arguments: list[str] | None) -> int:
    """Run a command and return its exit code; raises InputError for bad input."""
    try:
        with offering(SHELL), telling(), reading_standard_input():
            completion.prepare()
            code = int(_built()(arguments, prog_name="carom", standalone_mode=False) or 0)
    except typer.TyperException as error:
        if type(error).__name__ == "NoArgsIsHelpError":  # no command: the message is the help
            typer.echo(error.format_message())
            return error.exit_code
        near, _ = option_meant(error)  # typer's own message has options of its choice, too
        said = (error.message if near else error.format_message()).rstrip(".")
        asked = near or "see carom --help or carom COMMAND --help"
        raise InputError(f"{said}; {asked}") from None
    except (Interrupted, typer.Abort) as error:
        raise KeyboardInterrupt(*error.args) from None
    if code == INTERRUPTED:  # what typer makes of Ctrl-C
        raise KeyboardInterrupt
    return code
