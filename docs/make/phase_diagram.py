"""Write docs/phases.md: the diagram of phases, drawn from the table that the solver follows."""

from pathlib import Path

from carom.dimensionless.elastic.phases import OPPOSITE, SAME, TRANSITIONS, Cause, Kind
from carom.dimensionless.solution import CAUSE_NAMES
from carom.dimensionless.states import KIND_NAMES

PAGE = Path(__file__).parents[1] / "phases.md"
HALVES = {False: "loading", True: "unloading"}
SIGNS = {SAME: ", same sign", OPPOSITE: ", opposite sign"}
HEAD = """\
# Diagram of the phases

Drawn by `python docs/make/phase_diagram.py` from `TRANSITIONS` in
`src/carom/dimensionless/elastic/phases.py`, the one place that decides it. Any phase may also end
by separation; gross slip and slip end so, stick only where the load retraces its path.
"""


def name(kind: Kind) -> str:
    """Return a kind as an identifier of the diagram."""
    return KIND_NAMES[kind].replace(" ", "_")


def page() -> str:
    """Return the whole page."""
    arrows = ["    [*] --> stick: |psi_1| <= 1", "    [*] --> gross_slip: |psi_1| > 1"]
    rows = ["| phase | ends while | because | then |", "|---|---|---|---|"]
    for (kind, cause, unloading), (after, sign) in TRANSITIONS.items():
        half = HALVES[unloading]
        arrows.append(f"    {name(kind)} --> {name(after)}: {CAUSE_NAMES[cause]}, {half}")
        then = KIND_NAMES[after] + SIGNS.get(sign, "")
        rows.append(f"| {KIND_NAMES[kind]} | {half} | {CAUSE_NAMES[cause]} | {then} |")
    arrows += [f"    {name(kind)} --> [*]: {CAUSE_NAMES[Cause.SEPARATION]}" for kind in KIND_NAMES]
    diagram = ["```mermaid", "stateDiagram-v2", *arrows, "```"]
    return "\n".join([HEAD, *diagram, "", *rows]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
