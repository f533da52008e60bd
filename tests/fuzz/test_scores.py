"""`verify.score` with results as people have them: a whole score, or one line that says why.

Rebound curves, velocities and histories of forces, with few, equal, wrong and odd rows.
"""

import json
import warnings

import numpy as np
from tests.checks import is_stored, one_line

import carom

STEEL = carom.material("steel")
BALL = carom.Sphere(radius="5 mm", material=STEEL)
PAIRS = {
    "floor": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2),
    "balls": carom.Pair(BALL, carom.Sphere(radius="8 mm", material=STEEL), friction=0.4),
    "cup": carom.Pair(BALL, carom.Cup(radius="20 mm", material="soda-lime-glass"), friction=0.05),
    "shell": carom.Pair(
        carom.Sphere(radius="20 mm", material=STEEL, inner_radius="19 mm"),
        carom.HalfSpace(material="rigid"),
        friction=1.0,
    ),
    "smooth": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.0),
}
COLUMNS = ("normal_force", "tangential_force", "contact_velocity")
ODD = (np.nan, np.inf, 1e300, -1e300, 1e12, 1e-300, "-", "", "x", None, True)


def psis(rng, rows):
    """Return psi_1 as people choose them."""
    most = float(rng.choice([0.5, 3.0, 8.0, 1e3, 1e8]))
    return {
        "range": np.linspace(0.0, most, rows),
        "random": rng.uniform(-most, most, rows),
        "equal": np.full(rows, rng.uniform(0.0, most)),
        "zeros": np.zeros(rows),
        "borders": rng.choice([0.0, 1.0, -1.0, 4.0 * 1.44, 4.0 * 1.44 - 1.0], rows),
        "tiny": rng.uniform(0.0, 1e-12, rows),
    }[rng.choice(["range", "random", "equal", "zeros", "borders", "tiny"])]


def scattered(rng, values):
    """Return values with the errors of a code, or of another one."""
    noise = rng.choice([0.0, 0.0, 1e-6, 0.01, 0.5])
    factor = rng.choice([1.0, 1.0, 1.0, 1.0, -1.0, 0.0, 2.0, 60.0 / (2.0 * np.pi), 1e-3])
    return factor * values + noise * rng.normal(size=len(values)) * np.abs(values).max(initial=0.0)


def curve(rng):
    """Return a table of psi, and the arguments that go with it."""
    rows = int(rng.choice([1, 3, 4, 5, 10, 60]))
    chi = float(rng.choice([0.1, 0.5, 1.0, 1.4412, 5.0, 50.0]))
    psi = psis(rng, rows)
    table = {"psi_1": psi, "psi_2": scattered(rng, carom.rebound(psi, chi))}
    way = rng.choice(["column", "chi", "pair", "none", "many"])
    if way == "column":
        table["chi"] = np.full(rows, chi)
    if way == "many":
        table["chi"] = rng.choice([0.3, 0.5, 1.0, 1.4412, 2.0, 4.0, 7.0, -1.0], rows)
    inputs = {"chi": {"chi": chi}, "pair": {"case": PAIRS["floor"]}}
    return table, inputs.get(way, {})


def velocities(rng):
    """Return a table of velocities and spins, and the bodies."""
    rows = int(rng.choice([2, 3, 4, 5, 10, 40]))
    pair = PAIRS[rng.choice(list(PAIRS))]
    angle = rng.uniform(-1.5, 1.5, rows) if rng.random() < 0.7 else np.full(rows, 0.5)
    speed = np.full(rows, float(rng.choice([1e-6, 1.0, 100.0])))
    spin = rng.normal(size=rows) * rng.choice([0.0, 0.0, 1.0]) * speed / pair.first.radius
    normal, along = speed * np.cos(angle), speed * np.sin(angle) * rng.choice([0.0, 1.0, 1.0])
    impulse = np.zeros(rows)
    if pair.friction:
        psi = pair.psi(along + pair.first.radius * spin, normal)
        unit = pair.scales(normal).tangential_speed * pair.tangential_mass
        impulse = unit * (psi - carom.rebound(psi, pair.chi))
    ball = pair.first
    turned = impulse / (ball.mass * ball.gyration_ratio * ball.radius)
    table = {"normal_speed": normal, "tangential_speed": along, "spin": spin}
    if rng.random() < 0.4:
        table = {"speed": np.hypot(normal, along), "angle": np.arctan2(along, normal), "spin": spin}
    table["tangential_speed_out"] = scattered(rng, along - impulse / pair.normal_mass)
    table["spin_out"] = scattered(rng, spin - turned)
    if rng.random() < 0.6:
        table["normal_speed_out"] = normal * rng.choice([1.0, 1.0, 1.0, 0.5, 1.1, 0.0])
    if rng.random() < 0.2:
        table["spin2_out"] = np.zeros(rows)
    return table, {"case": pair}


def history(rng):
    """Return a history of forces, and the impact."""
    rows = int(rng.choice([1, 5, 19, 22, 23, 60, 150, 300]))
    pair = PAIRS[rng.choice(list(PAIRS))]
    angle = float(rng.choice([0.0, 0.1, -0.5, 0.8, 1.5]))
    hit = carom.impact(pair, speed=float(rng.choice([0.01, 1.0])), angle=angle)
    start, end = rng.choice([0.0, -0.1, 0.02, 0.3]), rng.choice([1.0, 1.2, 0.98, 0.5])
    time = np.linspace(start, end, rows) * hit.duration
    inside = (time >= 0.0) & (time <= hit.duration)
    exact = hit.to_dataset()
    at = {name: np.interp(time, exact.time, exact[name]) for name in COLUMNS}
    table = {"time": time}
    for name in ("normal_force", "tangential_force"):
        table[name] = scattered(rng, np.where(inside, at[name], 0.0))
    if rng.random() < 0.4:
        table["contact_velocity"] = scattered(rng, at["contact_velocity"])
    if rng.random() < 0.1:
        table["time"] = np.zeros(rows)
    return table, {"case": hit}


def spoilt(rng, table):
    """Return a table with a cell that is odd, a column too little, or rows that are one."""
    table = {name: list(values) for name, values in table.items()}
    rows = len(next(iter(table.values())))
    way = rng.random()
    if way < 0.15:
        name = str(rng.choice(list(table)))
        table[name][rng.integers(rows)] = ODD[rng.integers(len(ODD))]
    elif way < 0.2:
        del table[str(rng.choice(list(table)))]
    elif way < 0.3:
        table = {name: values[:1] * rows for name, values in table.items()}
    elif way < 0.35:
        table["remark"] = ["fine"] * rows
    return table


def used(score):
    """Ask a score for everything that it offers, and assert that no number is missing."""
    assert str(score)
    assert repr(score)
    assert score.cite()
    assert score.passed == (not score.failures)
    record = json.dumps(score.to_dict(), allow_nan=False)
    assert json.loads(record)["kind"] == score.kind
    assert sum(group.points for group in score.groups) == score.overall.points
    for finding in score.audit:
        assert np.isfinite(finding.value)
        assert finding.holds == (finding.value <= finding.limit), finding
        assert "nan" not in finding.verdict, finding
    dataset = score.to_dataset()
    for name, values in dataset.variables.items():
        if values.dtype.kind == "f":
            assert np.isfinite(values.values).all(), name


def attempt(seed, folder, pictures=True):
    """Make up results and score them; return the score, or the line that refuses them."""
    rng = np.random.default_rng(seed)
    table, inputs = (curve, velocities, history)[seed % 3](rng)
    table = spoilt(rng, table)
    if rng.random() < 0.2:
        inputs["tolerance"] = float(rng.choice([1e-12, 1e-3, 0.5, 1e6, 0.0, np.nan]))
    if rng.random() < 0.2:
        inputs["restitution"] = rng.choice([1.0, 0.9, 0.3, 1e-3, 1e-7, 0.0, 2.0, np.nan])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            score = carom.verify.score(table, **inputs)
        except carom.InputError as error:
            return one_line(error)
        used(score)
        if pictures:
            is_stored(score, folder)
    return score


def test_scores_of_what_people_have_are_whole_or_refused(calls, tmp_path):
    """Every number finite, every file read back, no warning; else one line."""
    ends = [attempt(seed, tmp_path, pictures=not seed % 25) for seed in range(calls // 40)]
    refused = [end for end in ends if isinstance(end, str)]
    assert len(refused) <= 4 * len(ends) / 5
