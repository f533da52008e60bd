"""Table of oblique elastic impacts to 30 digits: `python -m tests.oracles.generate_impacts` writes
it, `--check` computes it anew.

The doubles nearest to psi_1 and chi are the exact input. Times in units of d_max/V_1.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

from mpmath import mp, mpf

from tests.oracles.impact_solver import Accuracy, Impact, Solver

TABLE = Path(__file__).parents[1] / "high_precision" / "impacts.csv"
CHECK = Accuracy(digits=66, order=60, truncation="1e-56")
CASES = (  # psi_1, chi, and a feature that the run must meet
    ("0.5", "0.05", "stick from the start"),
    ("0.95", "0.05", "front reaches the centre (slip) loading"),
    ("0.5", "0.2", "front reaches the centre (slip) unloading"),
    ("0.7", "0.45", "stick from the start"),
    ("1.0", "0.45", "gross slip from the start"),
    ("0.5", "0.55", "stick from the start"),
    ("0.01", "1.44", "stick from the start"),
    ("0.1", "1.44", "stick from the start"),
    ("0.5", "1.44", "stick from the start"),
    ("-0.5", "1.44", "stick from the start"),
    ("0.9", "1.44", "stick from the start"),
    ("1.0", "1.44", "stick from the start"),
    ("1.000000001", "1.44", "all sticks (gross slip) loading"),
    ("1.2", "1.44", "front crosses opposite slip unloading"),
    ("-1.5", "1.44", "front crosses opposite slip unloading"),
    ("2.5", "1.44", "all sticks (gross slip) loading"),
    ("2.879999", "1.44", "all sticks (gross slip) loading"),
    ("2.880001", "1.44", "slip reverses (gross slip) unloading"),
    ("4", "1.44", "slip reverses (gross slip) unloading"),
    ("4.759999", "1.44", "slip reverses (gross slip) unloading"),
    ("5", "1.44", "gross slip throughout"),
    ("-6", "1.44", "gross slip throughout"),
    ("0.001", "1.5", "front reaches the centre (slip) unloading"),
    ("0.001", "1.51", "ring closes (slip) unloading"),
    ("0.7", "1.75", "ring closes (slip) unloading"),
    ("0.3", "1.75", "ring closes (slip) unloading"),
    ("0.8", "2", "ring closes (slip) unloading"),
    ("1.167", "2", "ring closes on own slip: gross slip at once"),
    ("0.1", "3", "ring closes (slip) unloading"),
    ("0.3", "4.3", "ring closes (slip) unloading"),
    ("0.9525", "4.3", "all sticks (slip) loading"),
    ("0.001", "6", "ring closes (slip) unloading"),
    ("0.75740566306", "6", "all sticks (slip) loading"),
    ("3", "6", "slip reverses (slip) unloading"),
    ("0.7", "8", "ring closes (slip) unloading"),
    ("4", "10", "slip reverses (slip) unloading"),
    ("0.2", "10.833333333333334", "stick from the start"),
    ("28.7386", "14", "front jumps across own slip unloading"),
    ("0.77454404366", "20", "slip reverses (slip) unloading"),
    ("0.77454404466", "20", "all sticks (slip) loading"),
    ("34", "20", "front jumps across own slip unloading"),
    ("0.9729", "20", "front jumps as its slip starts"),
    ("0.9669", "40", "all sticks (slip) loading"),
    ("62.7339", "40", "slip reverses (gross slip) unloading"),
    ("0.9", "60", "slip reverses (slip) unloading"),
    ("5", "60", "front jumps across own slip unloading"),
    ("114.932", "60", "slip reverses (gross slip) unloading"),
)


def solved(psi_1: str, chi: str, accuracy: Accuracy) -> Impact:
    """The impact for the doubles nearest to the given decimals."""
    mp.dps = accuracy.digits
    return Solver(mpf(float(psi_1)), mpf(float(chi)), accuracy).solve()


def phase_text(impact: Impact) -> str:
    """The phases as kind:sign:start:end:cause, times with 20 digits."""
    return ";".join(
        f"{p.kind}:{p.sign}:{mp.nstr(p.start, 20)}:{mp.nstr(p.end, 20)}:{p.cause}"
        for p in impact.phases
    )


def row(psi_1: str, chi: str, feature: str) -> dict[str, str | int]:
    """One line of the table; the feature that the case is there for must have occurred, and stands
    first.
    """
    impact = solved(psi_1, chi, Accuracy())
    if feature not in impact.features:
        raise ValueError(
            f"psi_1 = {psi_1}, chi = {chi}: no '{feature}' among {sorted(impact.features)}"
        )
    features = [feature, *sorted(impact.features - {feature})]
    return {
        "psi_1": psi_1,
        "chi": chi,
        "psi_out": mp.nstr(impact.psi_out, 30, strip_zeros=False),
        "n_phases": len(impact.phases),
        "phases": phase_text(impact),
        "features": "; ".join(features),
    }


def write_table() -> None:
    """Compute all cases and write the table."""
    rows = [row(*case) for case in CASES]
    with TABLE.open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def correct_digits(stored: mpf, anew: mpf) -> float:
    """Decimal digits that two values share, relative to the larger of the value and 0.001."""
    return float(-mp.log10(abs(stored - anew) / max(abs(anew), mpf("1e-3")) + mp.eps))


def check_row(line: dict[str, str]) -> tuple[float, float]:
    """Digits of psi_2 and of the times that a computation with other precision, order and steps
    confirms.
    """
    anew = solved(line["psi_1"], line["chi"], CHECK)
    phases = [text.split(":") for text in line["phases"].split(";")]
    if [(p.kind, str(p.sign), p.cause) for p in anew.phases] != [
        (p[0], p[1], p[4]) for p in phases
    ]:
        raise ValueError(f"psi_1 = {line['psi_1']}, chi = {line['chi']}: other phases")
    times = min(correct_digits(mpf(p[3]), q.end) for p, q in zip(phases, anew.phases, strict=True))
    return correct_digits(mpf(line["psi_out"]), anew.psi_out), times


def check_table(first: int | None = None, digits: float = 25) -> None:
    """Compute every line of the table anew and confirm psi_2 to the given digits and the times to
    19.
    """
    with TABLE.open(newline="") as file:
        lines = list(csv.DictReader(file))[:first]
    for line in lines:
        psi, times = check_row(line)
        print(
            f"psi_1 {line['psi_1']:>22} chi {line['chi']:>6}  "
            f"psi_2 to {psi:.1f} digits, times to {times:.1f}"
        )
        if psi < digits or times < 19:
            raise SystemExit("the table is not confirmed")
    print(f"{len(lines)} impacts confirmed")


def main() -> None:
    """Write the table or check it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--check",
        action="store_true",
        help="compute the table anew, with other precision and order",
    )
    parser.add_argument("--first", type=int, metavar="N", help="check the first N lines only")
    arguments = parser.parse_args()
    if arguments.check:
        check_table(arguments.first)
    else:
        write_table()


if __name__ == "__main__":
    main()
