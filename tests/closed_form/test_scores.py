"""Scores of results whose errors are known: the exact ones, closed forms, measured laws."""

import numpy as np
import pandas as pd
import pytest
from tests.oracles.springs import linear_springs

import carom
from carom.impacts.curves import borders
from carom.plots.scores import plot_score
from carom.verify.scoring import score

CHI = 1.4412
PSI = np.array([0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6])
STEEL = carom.material("steel")
BALL = carom.Sphere(radius="5 mm", material="steel")
BODIES = {
    "plate": carom.HalfSpace(material="steel"),
    "sphere": carom.Sphere(radius="8 mm", material="soda-lime-glass"),
    "hollow": carom.Sphere(radius="3 mm", inner_radius="2 mm", material="steel"),
    "cup": carom.Cup(radius="20 mm", material="steel"),
}


def psi_table(psi, psi_out):
    return {"psi_1": psi, "psi_2": psi_out}


def viscous(e):
    """The losses of a restitution; none of 1."""
    return None if e == 1.0 else carom.KelvinVoigt(restitution=e)


def velocities(pair, e=1.0, number=12, seed=1):
    """Return exact impacts with random motion as columns of SI velocities."""
    rng = np.random.default_rng(seed)
    spins = rng.uniform(-300.0, 300.0, (number, 2)) * [1, isinstance(pair.second, carom.Sphere)]
    hits = [
        carom.impact(
            pair,
            speed=rng.uniform(0.1, 5.0),
            angle=rng.uniform(0.0, 1.4),
            spin=spin,
            spin2=spin2,
            losses=viscous(e),
        )
        for spin, spin2 in spins
    ]
    names = ("normal_speed", "tangential_speed", "spin", "spin2")
    columns = {name: [getattr(hit, name) for hit in hits] for name in names}
    after = {name: [getattr(hit, name) for hit in hits] for name in (n + "_out" for n in names[1:])}
    return columns | after | {"normal_speed_out": [e * v for v in columns["normal_speed"]]}


def forces(hit, rows=31, shift=0.4):
    """Exact forces at instants of any clock that miss both touches, in a record around them."""
    times = (np.arange(rows) + shift) / rows * hit.duration
    state = hit.solution.at(times / hit.scales.time)
    load = getattr(state, "normal_force", state.penetration**1.5)
    pushed = {"normal_force": load * hit.scales.force}
    pushed["tangential_force"] = state.force * hit.scales.tangential_force
    before = times[0] - np.arange(4.0, 0.0, -1.0) * times[1]
    after = times[-1] + np.arange(1.0, 4.0) * times[1]
    columns = {n: np.concatenate([np.zeros(4), f, np.zeros(3)]) for n, f in pushed.items()}
    return columns | {"time": 1.0 + np.concatenate([before, times, after])}


@pytest.mark.parametrize(
    ("chi", "e"), [(0.3, 1.0), (1.0, 1.0), (CHI, 1.0), (3.0, 1.0), (CHI, 0.95), (CHI, 0.3)]
)
def test_exact_rebounds_score_zero(chi, e):
    psi = np.linspace(-4.0 * chi - 1.0, 4.0 * chi + 1.0, 41)
    exact = carom.rebound(psi, chi, losses=viscous(e))
    result = score(psi_table(psi, exact), chi=chi, restitution=e)
    assert result.passed
    assert result.restitution == e
    assert result.max_error == result.rms_error == result.mean_error == 0.0
    assert [finding.value for finding in result.audit] == pytest.approx([0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize(("body", "e"), [*((body, 1.0) for body in BODIES), ("plate", 0.7)])
def test_exact_velocities_score_zero(body, e):
    """Any second body, any spins: error to rounding of psi, and the audit finds nothing."""
    pair = carom.Pair(BALL, BODIES[body], friction=0.2)
    columns = velocities(pair, e)
    result = score(columns, case=pair, restitution=e)
    close = (1e-12 if e == 1.0 else 1e-11) * np.abs(result.points.psi_in).max()
    assert result.passed
    assert result.max_error <= close
    assert max(finding.value for finding in result.audit) <= (close if e == 1.0 else 1e-9)
    assert result.notes == ()
    lost = [-change for change in result.points.energy_change]
    hit = carom.impact(
        pair, **{name: columns[name][3] for name in list(columns)[:4]}, losses=viscous(e)
    )
    taken = hit.dissipated_energy + hit.lost_energy + hit.shear_lost_energy
    assert lost[3] == pytest.approx(taken, rel=1e-9)


def test_what_is_left_out_is_made_up_for_and_said():
    """The second spin follows from the first by Newton's third law; e is 1."""
    pair = carom.Pair(BALL, BODIES["sphere"], friction=0.2)
    columns = velocities(pair)
    del columns["spin2_out"], columns["normal_speed_out"]
    result = score(columns, case=pair)
    assert result.passed
    assert result.max_error <= 1e-11
    assert [note.split()[0] for note in result.notes] == ["normal_speed_out", "spin2_out"]


def test_rows_in_which_nothing_was_measured_are_left_out(tmp_path):
    """As `fit` reads them: a gap after the impact, whatever the columns; the rest scores alike."""
    pair = carom.Pair(BALL, BODIES["plate"], friction=0.2)
    columns = velocities(pair)
    spins = [f"{spin!r}" for spin in columns["spin_out"]]
    spins[1] = spins[4] = "-"
    codes = ["one", *["two"] * (len(spins) - 1)]
    result = score(columns | {"spin_out": spins, "code": codes}, case=pair)
    rest = {name: np.delete(values, [1, 4]) for name, values in columns.items()}
    assert result.max_error == score(rest, case=pair).max_error <= 1e-11
    assert result.points.rows.tolist() == [1, 3, 4, *range(6, len(spins) + 1)]
    assert [group.points for group in result.by_origin] == [1, len(spins) - 3]
    (note,) = result.notes
    assert note == "left out, as nothing was measured after the impact: rows 2 and 5"
    psi = tmp_path / "psi.csv"
    psi.write_text("psi_1,psi_2\n1,-0.0612\n2,-\n3,-1.4\n4,-1.5\n")
    assert score(psi, chi=1.44).points.rows.tolist() == [2, 4, 5]
    psi.write_text("psi_1,psi_2\n1,-0.0612\n-,-0.5\n3,-1.4\n4,-1.5\n")
    with pytest.raises(carom.InputError, match=r"^psi_1: no value in cell A3; write it there"):
        score(psi, chi=1.44)


@pytest.mark.parametrize("angle", ["5 deg", "35 deg", "-60 deg", "80 deg"])
@pytest.mark.parametrize(("shift", "e"), [(0.0, 1.0), (0.4, 1.0), (0.4, 0.9), (0.4, 0.5)])
def test_exact_histories_score_zero(angle, shift, e):
    """31 rows of any clock, with some before and after the contact: all is zero to rounding."""
    pair = carom.Pair(BALL, BODIES["plate"], friction=0.2)
    hit = carom.impact(pair, speed=2.0, angle=angle, spin=50.0, losses=viscous(e))
    result = score(forces(hit, shift=shift), case=hit)
    assert result.passed
    assert result.restitution == pytest.approx(e, abs=1e-12)
    assert result.points.psi_in[0] == hit.psi_in
    assert result.max_error <= (1e-9 if e == 1.0 else 1e-8)
    assert {f.name for f in result.audit if f.value > 1e-8} == set()  # of 1 s + 30 us
    touch = 1e-9 if e == 1.0 else 1e-8
    assert result.forces.samples.touch == pytest.approx(1.0, abs=touch * hit.duration)


def test_linear_spring_has_its_measured_error():
    """Max |error in psi_2| 0.1756 at chi = 1.4412, k_t/k_n = kappa, as measured independently."""
    springs = psi_table(PSI, linear_springs([1.0], PSI, CHI, 20_000)[0])
    result = score(springs, chi=CHI)
    assert not result.passed
    assert result.max_error == pytest.approx(0.1756, abs=1e-4)
    table = psi_table(PSI, linear_springs([1.0], PSI, CHI, 20_000)[0])
    assert score(table, chi=CHI, tolerance=0.18).passed


def test_known_errors_are_found_where_they_are():
    """Errors that were added come back: each, the largest, root mean square, mean."""
    rng = np.random.default_rng(3)
    psi, added = rng.uniform(-7.0, 7.0, 50), rng.normal(0.0, 0.1, 50)
    result = score(psi_table(psi, carom.rebound(psi, CHI) + added), chi=CHI)
    np.testing.assert_allclose(result.points.error, added, rtol=0.0, atol=1e-14)
    assert result.points.worst == np.argmax(np.abs(added))
    expected = [np.abs(added).max(), np.sqrt(np.mean(added**2)), added.mean()]
    actual = [result.max_error, result.rms_error, result.mean_error]
    np.testing.assert_allclose(actual, expected, rtol=1e-10)


def test_sliding_law_is_exact_where_all_slips():
    """psi_1 - 4 chi is right from psi_1 = 4 chi - 1 on, and in that group alone."""
    psi = np.linspace(0.05, 4.0 * CHI + 1.0, 60)
    result = score(psi_table(psi, psi - 4.0 * CHI), chi=CHI)
    largest = {group.name: group.max_error for group in result.groups}
    assert largest["gross slip +"] <= 1e-9
    assert min(error for name, error in largest.items() if name != "gross slip +") > 0.01
    assert [group.points for group in result.groups][-1] == (psi > borders(CHI)[2]).sum()


@pytest.mark.parametrize("chi", [0.4, CHI, 3.0])
def test_groups_are_the_sequences_of_phases(chi):
    """Every point is in the group that is called like the phases of its impact, for psi_1 > 0."""
    psi = np.random.default_rng(5).uniform(-4.0 * chi - 1.0, 4.0 * chi + 1.0, 60)
    points = score(psi_table(psi, carom.rebound(psi, chi)), chi=chi).points
    for value, place in zip(psi, points.sequence, strict=True):
        signs = {0: "", 1: " +", -1: " -"}
        phases = carom.solve(abs(value), chi).phases
        name = ", ".join(phase.kind + signs[phase.sign] for phase in phases)
        assert points.sequence_names[place] == name
    assert sum(group.points for group in points.groups) == 60


def test_scaled_forces_scale_their_impulses():
    """(1 + c) F_t adds c (psi_2 - psi_1) to psi_2, (1 + c) F_n makes e = 1 + 2 c."""
    pair = carom.Pair(BALL, BODIES["plate"], friction=0.2)
    hit = carom.impact(pair, speed=2.0, angle="35 deg")
    history = hit.history(801)
    columns = {n: history[n].values for n in ("time", "normal_force", "tangential_force")}
    c = 0.02
    more = score(columns | {"tangential_force": (1 + c) * columns["tangential_force"]}, case=hit)
    assert more.points.error[0] == pytest.approx(c * (hit.psi_out - hit.psi_in), rel=1e-5)
    pressed = score(columns | {"normal_force": (1 + c) * columns["normal_force"]}, case=hit)
    assert pressed.forces.restitution == pytest.approx(1.0 + 2.0 * c, rel=1e-5)
    assert pressed.forces.peak_error == pytest.approx(c, rel=1e-4)
    assert pressed.failures == ("normal force", "peak force", "restitution error")
    for c in (0.03, -0.03):  # of the duration
        slowed = score(columns | {"time": (1.0 + c) * columns["time"]}, case=hit).forces
        assert slowed.duration_error == pytest.approx(c, abs=1e-3)
        assert slowed.restitution == pytest.approx(1.0 + 2.0 * c, abs=1e-4)
        change = hit.psi_out - hit.psi_in
        assert slowed.psi[-1] - hit.psi_out == pytest.approx(c * change, abs=1e-4)


def test_all_ways_of_giving_results_are_one(tmp_path):
    """A mapping, a data frame, a file with comments; SI, units in the head or the cell; angles."""
    pair = carom.Pair(BALL, BODIES["plate"], friction=0.2)
    case = {"friction": 0.2, "speed": "1 m/s", "first": {"radius": "5 mm", "material": "steel"}}
    columns = velocities(pair)
    plain = score(columns, case=pair).points
    path = tmp_path / "results.csv"
    path.write_text("# a comment\n\n" + pd.DataFrame(columns).to_csv(index=False))
    turned = {
        "speed [mm/s]": 1e3 * np.hypot(columns["normal_speed"], columns["tangential_speed"]),
        "angle (deg)": np.degrees(np.arctan2(columns["tangential_speed"], columns["normal_speed"])),
        "spin [rpm]": np.array(columns["spin"]) * 30.0 / np.pi,
        "tangential_speed_out": [f"{100.0 * v!r} cm/s" for v in columns["tangential_speed_out"]],
        "spin_out": columns["spin_out"],
        "remark": ["a"] * 12,
    }
    for source, bodies in (
        (pd.DataFrame(columns), case),
        (path, case),
        (str(path), pair),
        (turned, carom.impact(pair, speed=1.0)),
    ):
        points = score(source, case=bodies).points
        np.testing.assert_allclose(points.error, plain.error, rtol=0.0, atol=1e-11)
        np.testing.assert_allclose(points.psi_in, plain.psi_in, rtol=1e-12)
    assert score(path, case=pair).points.rows.tolist() == list(range(4, 16)), "lines of the file"


@pytest.mark.slow
def test_figures_are_drawn_from_what_is_stored(tmp_path):
    """A stored score is drawn as it is: errors, tolerance, forces."""
    pair = carom.Pair(BALL, BODIES["plate"], friction=0.2)
    hit = carom.impact(pair, speed=2.0, angle="35 deg")
    history = hit.history(60)
    forces = {n: history[n].values for n in ("time", "normal_force", "tangential_force")}
    forces["tangential_force"] = 0.9 * forces["tangential_force"]
    chis = np.linspace(0.5, 3.0, PSI.size)
    for name, result in {
        "curve": score(psi_table(PSI, 0.9 * carom.rebound(PSI, CHI)), chi=CHI),
        "spread": score(psi_table(PSI, 0.9 * carom.rebound(PSI, chis)) | {"chi": chis}),
        "velocities": score(velocities(pair), case=pair),
        "history": score(forces, case=hit),
    }.items():
        dataset = result.to_dataset()
        stored = carom.read(carom.save(result, tmp_path / f"{name}.nc"))
        assert stored.identical(dataset)
        lower = plot_score(stored).axes[-2 if name == "history" else -1]
        (drawn,) = (line for line in lower.lines if len(line.get_ydata()) > 2)
        error = result.forces.tangential_error if name == "history" else result.points.error
        if name != "history":  # what slides anyway is left out, and counted
            points = result.points
            near = np.abs(points.psi_in) <= 2.0 * np.maximum(1.0, 4.0 * points.chi - 1.0)
            notes = [text.get_text() for axis in lower.figure.axes for text in axis.texts]
            assert any(f"{np.sum(~near)} more at larger" in text for text in notes) != near.all()
            error = error[near]
        np.testing.assert_allclose(drawn.get_ydata(), error, rtol=1e-12, atol=1e-15)
        assert sum(line.get_ydata()[0] == 0.01 for line in lower.lines) == 1
        assert bool(lower.patches) == (name != "spread"), "regimes of one chi, phases of one impact"
        assert dataset.passed == result.passed
