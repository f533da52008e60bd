"""Results of every kind, small and fast to make, from which the schema is read."""

import json
from collections.abc import Iterator
from contextlib import chdir, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from typer.main import get_command

import carom
from carom.cli import main
from carom.cli.commands import app

EXAMPLES = Path(__file__).parents[2] / "examples"
SETUP = """\
import carom

steel = carom.material("steel")
ball = carom.Sphere(radius="5 mm", material=steel)
pair = carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)
hit = carom.impact(pair, speed="2 m/s", angle="30 deg")
coarse = carom.BoundaryElements(elements=10, steps=30)
full = carom.impact(pair, speed="2 m/s", angle="30 deg", method=coarse)
path = carom.load_path(pair, normal_force="10 N", tangential_force=[0.0, 1.2, -1.2])
case = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "1 m/s"}
axes = {"angle": ["10 deg", "40 deg"], "friction": [0.1, 0.2, 0.3]}
results = {"psi_1": [0.5, 1.0, 2.0, 4.0], "psi_2": [0.05, -0.06, -0.84, -1.51]}
"""
DATASETS = {
    "History of an impact": "hit.history(50)",
    "History by boundary elements": "full.history(50)",
    "Spectra of the forces of an impact": "hit.spectrum(n=50)",
    "Fields over the contact": "hit.fields(0.6 * hit.duration)",
    "Fields by boundary elements": "full.fields(0.6 * full.duration)",
    "Fields along the radius": "hit.radial(0.6 * hit.duration)",
    "Stress below the surface": "hit.stress(0.6 * hit.duration)",
    "Largest stresses of an impact": "hit.peaks()",
    "Speeds that bodies bear": "carom.bearable_speeds(pair, angle=[0.3, 0.8])",
    "Wear by one impact": 'hit.wear(coefficient="1e-13 m^2/N")',
    "Wear by many impacts": "carom.wear_of_many(pair, speed=2.0, angle=[0.3, 0.8])",
    "Load path": "path.to_dataset()",
    "Curve": "carom.curve([1.0, 1.44], [0.5, 1.0, 2.0, 6.0])",
    "Map of regimes": "carom.regime_map([0.5, 2.0, 6.0], [1.0, 1.44])",
    "Sweep": "carom.sweep(case, carom.Grid(axes))",
    "Measured rebounds": 'carom.datasets.load("kharaz2001")',
    "Fit": 'carom.fit(carom.datasets.load("kharaz2001")).to_dataset()',
    "Score": "carom.verify.score(results, chi=1.44).to_dataset()",
    "Ranking of contact laws": "carom.verify.rank().to_dataset()",
    "Error of a contact law": "carom.verify.error_map(carom.dem.LinearSpring(), [1, 6], [1.44])",
}
SCORED = "psi_1,psi_2\n0.5,0.05\n1.0,-0.06\n2.0,-0.84\n4.0,-1.51\n"  # results.csv
COMMANDS = (
    "carom impact steel_ball.toml",
    "carom curve --chi 1.44 --points 3",
    "carom sweep sweep.toml",
    "carom fit kharaz2001.csv",
    "carom track track_deeplabcut.csv --frame-rate 1000 --pixels-per-mm 10",
    "carom materials",
    "carom verify laws --case steel_ball.toml",
    "carom verify tune steel_ball.toml",
    "carom verify score results.csv --chi 1.44",
    "carom verify pack bench",
    "carom lammps examples inputs",
)
SHOWN = 2  # entries of a list


def datasets() -> dict[str, Any]:
    """Return a dataset of every kind by its title."""
    names: dict[str, Any] = {}
    exec(SETUP, names)
    return {title: eval(line, names) for title, line in DATASETS.items()}


def printed(command: str) -> Any:
    """Return what a command prints with --json, lists and tables cut."""
    measured = carom.datasets.path("kharaz2001")
    with TemporaryDirectory() as folder, chdir(folder), redirect_stdout(StringIO()) as said:
        tracked = EXAMPLES / "data" / "track_deeplabcut.csv"
        for file in (EXAMPLES / "steel_ball.toml", EXAMPLES / "sweep.toml", measured, tracked):
            Path(file.name).write_bytes(file.read_bytes())
        Path("results.csv").write_text(SCORED, encoding="utf-8")
        with redirect_stderr(StringIO()):
            code = main([*command.split()[1:], "--json"])
    if code not in (0, 1) or not said.getvalue():  # 1: a score that fails
        raise RuntimeError(f"{command}: exit code {code}")
    return cut(json.loads(said.getvalue()))


def cut(value: Any) -> Any:
    """Return what JSON holds with the first entries of every list.

    >>> cut({"time": [1, 2, 3, 4]})
    {'time': [1, 2]}
    """
    if isinstance(value, dict):
        return {key: cut(entry) for key, entry in value.items()}
    return [cut(entry) for entry in value[:SHOWN]] if isinstance(value, list) else value


def commands(group: Any = None, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the words of every command, groups first."""
    group = group or get_command(app)
    yield path
    for name, command in getattr(group, "commands", {}).items():
        yield from commands(command, (*path, name))


def help_of(words: tuple[str, ...]) -> str:
    """Return what a command prints with --help."""
    with redirect_stdout(StringIO()) as said:
        get_command(app).main([*words, "--help"], prog_name="carom", standalone_mode=False)
    return said.getvalue().strip()
