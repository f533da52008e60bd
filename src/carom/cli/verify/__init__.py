"""`carom verify`: contact laws and DEM codes against the exact impact."""

from carom.cli.once import Commands
from carom.cli.verify.engines import COMMANDS, engine_command
from carom.cli.verify.laws import laws_command
from carom.cli.verify.pack import pack_command
from carom.cli.verify.score import score_command
from carom.cli.verify.tune import tune_command

app = Commands(
    name="verify",
    help="Put contact laws and DEM codes to the test against the exact impact.\n\n"
    "Example: carom verify laws",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.command("laws")(laws_command)
for name, words in COMMANDS.items():
    app.command(name, help=words)(engine_command)
app.command("pack")(pack_command)
app.command("score")(score_command)
app.command("tune")(tune_command)
