"""`carom verify`: contact laws and DEM codes against the exact impact."""

from carom.cli.options import Commands
from carom.cli.verify.engines import COMMANDS, engine_command, pack_command
from carom.cli.verify.laws import laws_command
from carom.cli.verify.score import score_command
from carom.cli.verify.tune import tune_command

app = Commands(
    "verify",
    "Test contact laws and DEM codes against the exact impact.\n\n"
    "Begin with carom verify laws, which ranks the contact laws in use. carom verify score judges "
    "your own results, and carom verify tune finds the least wrong stiffness of a law.\n\n\b\n"
    "Example: carom verify laws",
)
app.command("laws")(laws_command)
for name, words in COMMANDS.items():
    app.command(name, help=words)(engine_command)
app.command("pack")(pack_command)
app.command("score")(score_command)
app.command("tune")(tune_command)
