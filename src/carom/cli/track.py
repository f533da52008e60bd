"""`carom track`: the motion before and after an impact from the positions of a video."""

import json
from typing import Any

import typer

import carom
from carom.cli.cases import check_outputs, stored
from carom.cli.options import checking, described, file_argument
from carom.cli.tables import TABLE, store_format, table_format_of

OPTIONS = {
    "data": file_argument(
        "Tracks, one impact a file: CSV, a spreadsheet, an export of Tracker, DeepLabCut or SLEAP."
    ),
    "frame_rate": "Frames per second, where the frames are counted, e.g. '1000 Hz'.",
    "pixels_per_mm": "Scale of positions in pixels.",
    "pixels_per_diameter": "Diameter of the ball in pixels, as their scale, with --radius.",
    "radius": "Radius of the ball, e.g. '5 mm' [m].",
    "plate_angle": "Angle of the plate from the horizontal, counterclockwise in the picture.",
    "gravity": "Acceleration of gravity [m/s^2], or 'fit' to find it from the paths.",
    "y_down": typer.Option(
        "--y-down/--y-up", help="Whether y is counted downwards (default: as the ball flies)."
    ),
    **TABLE,
    "output": "Store the motions as a table for carom fit: .csv or .nc.",
}


@described(OPTIONS)
def track_command(
    data: list[str] | None = None,
    plate_angle: str = "0 deg",
    gravity: str = "9.80665 m/s^2",
    y_down: bool | None = None,
    output: str | None = None,
    as_json: bool = False,
    **given: Any,
) -> None:
    """Find the motion before and after an impact in a video.

    Use this command before carom fit if you have tracked the ball in a video. The columns of a
    track are x and y of the centre, time or frame, and for spins mark_x and mark_y of a mark on the
    ball, or mark_angle. Parabolas are fitted to the frames before and after the impact; standard
    errors follow from the scatter of the positions.

    \b
    Example: carom track ball.csv --frame-rate "1 kHz" --pixels-per-mm 12 --output rebounds.csv
    An export of Tracker in metres: carom track ball.txt --column "x=x [m]" --column "y=y [m]"
    Many impacts: carom track 10deg.csv 20deg.csv 30deg.csv --frame-rate 1000 --pixels-per-mm 12
    """
    with checking() as faults:
        tracks = {f"track {i}": each for i, each in enumerate(data or ())}
        faults.trying(check_outputs, {"output": output}, **tracks)
        table = faults.trying(table_format_of, given, "'ball x=x [px]'")
        options = {name: value for name, value in given.items() if name not in TABLE}
        options |= {"plate_angle": plate_angle, "gravity": gravity, "y_down": y_down}
        how = table._asdict() if table else {}
        motions = faults.trying(carom.track, data or [], **how, **options)
    store_format(table, given["save_columns"])
    if output is not None:
        stored(carom.save(motions, output))
    from carom.lab.fitting.tracks import as_records, as_text

    typer.echo(json.dumps(as_records(motions), indent=2) if as_json else as_text(motions))
