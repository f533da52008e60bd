"""What a program has left, as results for the scorer.

`python -m carom.verify.pack.collect FOLDER`, which the run.sh of packs calls, so it keeps its name:
FOLDER is one of the pack's, e.g. bench/wall/lammps, in which the program has run; its results.csv
has the columns of the template in the folder above.
"""

import sys
from pathlib import Path

from carom.bodies.cases import read_case
from carom.io.paths import replace_whole
from carom.quantities.refusals import InputError, refusal
from carom.verify.engines.experiments import AFTER
from carom.verify.pack.frozen import CASE, INPUTS, DecimalTable, read_table
from carom.verify.pack.writing import PROGRAMS, experiment_of


def collect(folder: str | Path) -> Path:
    """Write results.csv of a folder of the pack in which a program has run, or raise InputError."""
    place = Path(folder).resolve()
    if place.name not in PROGRAMS:
        raise refusal("folder", str(folder), f"must be one of {', '.join(PROGRAMS)} in a set")
    program, _ = PROGRAMS[place.name]
    template = place.parent / INPUTS
    try:
        inputs = read_table(template.read_text(encoding="utf-8"))
        experiment = experiment_of(place.name, read_case(place.parent / CASE), inputs)
    except (OSError, KeyError, ValueError) as error:
        raise refusal("folder", str(folder), f"its set is not whole; {error}") from None
    try:
        outcomes = program.outcomes(place, experiment)
    except (OSError, ValueError, IndexError) as error:
        reason = f"{program.name} has left no results ({error}); run it first"
        raise refusal("folder", str(folder), reason) from None
    before = {name: cells for name, cells in inputs.columns.items() if name not in AFTER}
    after = {
        name: [repr(float(value)) for value in values]
        for name, values in zip(AFTER, outcomes, strict=True)
    }
    text = DecimalTable((f"code: {program.name}",), before | after).as_csv()
    return replace_whole(place / INPUTS, lambda file: file.write_text(text, encoding="utf-8"))


if __name__ == "__main__":
    try:
        print(collect(sys.argv[1] if len(sys.argv) > 1 else "."))
    except InputError as error:
        sys.exit(f"carom: {error}")
