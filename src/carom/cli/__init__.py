"""The commands. No physics here: they read, call the library, and print.

Imports inside functions are for what only one command needs, so that `carom --help` is quick; in
the rest of the package, for third-party packages that are heavy or optional.
"""

import logging
import os
import sys
import warnings

import typer

import carom
from carom.cli.curve import curve_command
from carom.cli.explore import explore_command
from carom.cli.fit import fit_command
from carom.cli.impact import impact_command
from carom.cli.lammps import app as lammps_app
from carom.cli.liggghts import app as liggghts_app
from carom.cli.materials import materials_command
from carom.cli.once import Commands
from carom.cli.sweep import sweep_command
from carom.cli.verify import app as verify_app
from carom.quantities.refusals import InputError, nearest
from carom.quantities.symbols import meant, remark

app = Commands(
    name="carom",
    help="Carom computes how an elastic sphere leaves an oblique impact, and what happens inside "
    "the contact.\n\n"
    "Begin with carom impact for one impact, carom sweep for many, carom fit for measured "
    "rebounds, carom verify for contact laws of DEM codes, or carom explore for a page in the "
    "browser. carom COMMAND --help describes a command. The exit code is 0, 2 for input that "
    "cannot be used, or 1 for a failure.\n\n\b\n"
    'Example: carom impact --radius "5 mm" --material steel --friction 0.2 --speed 2 '
    '--angle "30 deg"',
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
app.command("impact")(impact_command)
app.command("curve")(curve_command)
app.command("sweep")(sweep_command)
app.command("fit")(fit_command)
app.command("explore")(explore_command)
app.command("materials")(materials_command)
app.add_typer(verify_app)
app.add_typer(lammps_app)
app.add_typer(liggghts_app)


@app.callback(invoke_without_command=True)
def _common(
    version: bool = typer.Option(False, "--version", help="Print the version and exit."),
) -> None:
    if version:
        typer.echo(carom.__version__)
        raise typer.Exit


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return 0, 2 for bad input (one line on stderr), or 1 for a failure."""
    try:
        return int(app(arguments, standalone_mode=False) or 0)
    except InputError as error:
        return _refuse(str(error))
    except typer.TyperException as error:
        if type(error).__name__ == "NoArgsIsHelpError":  # no command: the message is the help
            typer.echo(error.format_message())
            return error.exit_code
        asked = _option_meant(error) or "see carom --help or carom COMMAND --help"
        return _refuse(f"{error.format_message().rstrip('.')}; {asked}")
    except typer.Abort:
        typer.echo("carom: the command was interrupted", err=True)
        return 1
    except Exception as error:  # the last resort: a line instead of a traceback
        typer.echo(f"carom: the command failed, {type(error).__name__}: {error}", err=True)
        return 1


def _option_meant(error: typer.TyperException) -> str:
    """Return a hint at the option that one stands for which the command does not have."""
    word = str(getattr(error, "option_name", "")).strip("-").replace("-", "_")
    context = getattr(error, "ctx", None)
    if not word or context is None:
        return ""
    options = [name for each in context.command.params for name in each.opts]
    known = {name.strip("-").replace("-", "_"): name for name in options}
    name = meant(word, known)
    if name:
        return f"write {known[name]}{remark(word, name).removeprefix(name)}"
    return nearest(word.replace("_", "-"), [option.strip("-") for option in options])


def _refuse(message: str) -> int:
    typer.echo(f"carom: {' '.join(message.split())}", err=True)
    return 2


def run() -> None:
    """Run a command from the shell, in a process of its own."""
    os.environ["MPLBACKEND"] = "agg"  # for files: no screen, and no backend that is not there
    _quieten()
    sys.exit(main())


def _quieten() -> None:
    """Show the warnings of this package in one line each, and none of the packages it uses."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # of its folders and its fonts
    if sys.warnoptions:  # somebody looks for them
        return
    warnings.filterwarnings("ignore")
    warnings.filterwarnings("default", module=r"carom\.")
    warnings.filterwarnings("ignore", r".* encountered in ", RuntimeWarning)  # by NumPy
    warnings.formatwarning = lambda message, *_, **__: f"carom: {message}\n"
