"""Tangential model carom in LIGGGHTS itself, where `carom liggghts build` has built it."""

import subprocess

import numpy as np
import pytest

import carom
from carom.adapters import liggghts
from carom.cli import main

pytestmark = [
    pytest.mark.engine,
    pytest.mark.skipif(
        not liggghts.has_model(liggghts.program()), reason="carom liggghts build has not been run"
    ),
]
GLASS = carom.Material(young=70e9, poisson=0.2, density=2500)
BEAD = carom.Sphere(radius=3e-3, material=GLASS)
PAIRS = {
    "unlike wall": carom.Pair(BEAD, carom.HalfSpace(material="steel"), friction=0.3),
    "unlike spheres": carom.Pair(BEAD, carom.Sphere(radius=5e-3, material="steel"), friction=0.3),
}


@pytest.mark.parametrize("springs", liggghts.SPRINGS)
@pytest.mark.parametrize("name", PAIRS)
def test_is_the_law_of_carom(name, springs):
    """Step for step, but for R - d/2 and single precision; Hertz-Mindlin would be off by 0.5."""
    law = carom.dem.ExactContactLaw(springs)
    engine = carom.verify.Liggghts()
    (actual,) = carom.verify.bench(engine, law, pair=PAIRS[name], steps=100).measured
    assert actual.failure is None
    assert actual.law_error < (4e-6 if "wall" in name else 2e-5)
    assert actual.max_error < 0.1 / springs


def test_passes(tmp_path, capsys):
    results = str(tmp_path / "r.csv")
    assert main(["verify", "liggghts", "--law", "carom", "--output", results]) == 0
    assert main(["verify", "score", results, "--tolerance", "0.002"]) == 0
    assert "PASS" in capsys.readouterr().out


SCRIPT = """\
units si
atom_style granular
atom_modify map array
communicate single vel yes
boundary p p p
newton off
hard_particles yes
region box block 0 0.1 0 0.1 0 0.1 units box
create_box 1 box
create_atoms 1 single {x} 0.05 0.05 units box
create_atoms 1 single {other} 0.05 0.05 units box
set group all diameter 0.01 density 2500
set atom 1 vx 1.0 vy {slide} vz {slide}
set atom 2 vx {back} vy -{slide} vz -{slide}
neighbor 0.001 bin
neigh_modify every 1 delay 0 check no one 200
fix m1 all property/global youngsModulus peratomtype 5e7
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientFriction peratomtypepair 1 0.3
fix m5 all property/global kn peratomtypepair 1 1e4
fix m6 all property/global kt peratomtypepair 1 1e4
fix m7 all property/global gamman peratomtypepair 1 0
fix m8 all property/global gammat peratomtypepair 1 0
fix m9 all property/global cohesionEnergyDensity peratomtypepair 1 1e5
fix m4 all property/global coefficientRestitution peratomtypepair 1 {restitution}
pair_style gran model {model}
pair_coeff * *
fix motion all nve/sphere
timestep 1e-6
thermo_modify lost error norm no
{run}
write_dump all custom end id vx vy vz omegax omegay omegaz modify sort id format "%d {numbers}"
"""
GIVEN = {"x": 0.04, "other": 0.05, "slide": 0.2, "back": 0.6, "restitution": 1.0}
GIVEN |= {"model": "hertz tangential carom", "run": "run 1000"}
GIVEN["numbers"] = " ".join(["%.17g"] * 6)


@pytest.fixture
def run(tmp_path):
    """Run two spheres that drift together along x; returns what was printed, and the end."""

    def call(**changes):
        (tmp_path / "end").unlink(missing_ok=True)
        (tmp_path / "in.test").write_text(SCRIPT.format_map(GIVEN | changes))
        command = [str(liggghts.program()), "-in", "in.test", "-log", "none"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
        end = tmp_path / "end"
        states = np.loadtxt(end, skiprows=9)[:, 1:] if end.exists() else None
        return (done.stdout + done.stderr).decode(errors="replace"), states

    return call


def test_memory_changes_sides(run):
    """Across a border each sphere becomes the last of the list in turn, and the contact its own."""
    _, still = run()
    assert (np.abs(still[:, 4:]) > 10.0).all()  # rad/s: the impact is oblique, and over
    assert still[0, 0] < 0.7 < 0.9 < still[1, 0]
    for x in (0.0898, 0.0998):
        printed, moved = run(x=x, other=round((x + 0.01) % 0.1, 6))
        assert moved is not None, printed[-500:]
        np.testing.assert_allclose(moved, still, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize(("model", "spins"), [("carom", (55.3, 47.9)), ("history", (53.0, 49.3))])
def test_a_second_run_forgets_contacts(run, model, spins):
    """LIGGGHTS does, whatever the model; the numbers are those of the page."""
    for commands, spin in zip(("run 1000", "run 300\nrun 700"), spins, strict=True):
        _, end = run(model=f"hertz tangential {model}", run=commands)
        assert np.hypot(*end[0, 4:]) == pytest.approx(spin, abs=0.05)


def test_only_asking_for_forces_moves_no_spring(run):
    """A compute asks in every step. `pre no` keeps contacts where a run is cut in two."""
    _, whole = run()
    ask = "compute c all pair/gran/local id force\ndump d all local 1 forces c_c[1] c_c[2]\n"
    _, parts = run(run=f"{ask}run 300\nrun 700 pre no")
    np.testing.assert_allclose(parts, whole, rtol=1e-9, atol=1e-9)


def test_the_tangential_part_beside_other_normal_forces(run):
    """The same beside an elastic one; losses, cohesion and rolling friction act as they do."""
    model = "hertz tangential carom {}part_tangential on"
    _, elastic = run()
    _, same = run(model=model.format(""))
    np.testing.assert_array_equal(same, elastic)
    _, lossy = run(model=model.format(""), restitution=0.5)
    along = [end[1, 0] - end[0, 0] for end in (elastic, lossy)]
    assert along[1] == pytest.approx(0.5 * along[0], rel=0.03)
    for cohesion in ("sjkr", "sjkr2"):
        printed, end = run(model=model.format(f"cohesion {cohesion} "))
        assert end is not None, printed[-500:]
    spins = "fix m10 all property/global coefficientRollingFriction peratomtypepair 1 0.5\n"
    spins += "set atom 1 omegay 200.0\nrun 1000"  # of one sphere alone, which rolls on the other
    _, free = run(model=model.format(""), run=spins)
    _, rolled = run(model=model.format("rolling_friction cdt "), run=spins)
    differ = [np.ptp(end[:, 4]) for end in (free, rolled)]
    assert differ[1] < 0.95 * differ[0]


ELASTIC = "the normal force must be that of elastic spheres"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"restitution": 0.9}, ELASTIC),
        ({"model": "hooke/stiffness tangential carom"}, ELASTIC),
        ({"model": "hertz tangential carom cohesion sjkr"}, ELASTIC),
        (
            {"model": "hooke/stiffness tangential carom part_tangential on"},
            "takes the limit of friction from Hertz's depth",
        ),
        ({"model": "hertz tangential carom springs 20"}, "springs must be 16, 32 or 64"),
        ({"run": "neigh_modify one 9000\nrun 1"}, "neigh_modify one 200"),
    ],
    ids=["losses", "another normal force", "cohesion", "no Hertz", "springs", "pages"],
)
def test_refuses(run, changes, said):
    printed, end = run(**changes)
    assert said in printed
    assert end is None
