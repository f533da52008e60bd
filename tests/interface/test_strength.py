"""Strengths as users give them: what is missing, negative, unknown; what results say of it."""

import json

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.many.sweeps.points import PointStatus

CASE = {"friction": 0.2, "speed": 1.0, "first": {"radius": "5 mm", "material": "steel"}}


def one_angle(outputs, **changes):
    return carom.sweep(CASE | changes, carom.Grid({"angle": [0.1]}), outputs=outputs)


def findings(hit):
    return {each.name: each for each in hit.validity.findings}


def pair_of(first="bearing steel", second="bearing steel", friction=0.2, **keywords):
    stuff = carom.material(second, **keywords)
    ball = carom.Sphere(radius="5 mm", material=first)
    return carom.Pair(ball, carom.HalfSpace(material=stuff), friction=friction)


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        ({"yield_strength": -1.0}, "yield_strength: -1.0 cannot be used; must be positive"),
        ({"tensile_strength": "0 MPa"}, "tensile_strength: '0 MPa' cannot be used"),
        ({"fracture_toughness": "0.75 MPa"}, "'MPa' is not a unit of fracture toughness"),
        ({"fracture_toughness": "75 MPa m"}, "'MPa m' is not a unit of fracture toughness"),
        ({"flaw_size": "20 s"}, "flaw_size: '20 s' cannot be used"),
        ({"toughness": 1e6}, "toughness: unknown in a material; write fracture_toughness"),
    ],
)
def test_strengths_that_cannot_be_used(inputs, words):
    refused(words, carom.material, "glass", **inputs)


@pytest.mark.parametrize(
    "text", ["0.75 MPa m^0.5", "0.75 MPa sqrt(m)", "0.75 MPa√m", "750 kPa m^1/2"]
)
def test_toughness_is_read_as_it_is_written(text):
    assert carom.material("glass", fracture_toughness=text).fracture_toughness == 7.5e5


def test_a_material_of_the_catalogue_takes_what_is_known_besides():
    stuff = carom.material("float glass")
    more = carom.material("float glass", flaw_size="20 um", young="70 GPa")
    assert (more.young, more.poisson, more.flaw_size) == (70e9, stuff.poisson, 20e-6)
    assert more.fracture_toughness == stuff.fracture_toughness == 0.75e6
    first = {"radius": "5 mm", "material": {"name": "float glass", "flaw_size": "20 um"}}
    actual = one_angle(["crack_speed_first"], first=first)
    assert np.isfinite(actual.crack_speed_first.values).all()


def test_no_strength_at_all_is_told_with_where_to_put_it():
    bodies = pair_of("float glass", "float glass")
    line = refused("no strength of either body is known", carom.bearable_speeds, bodies)
    for word in ("yield_strength", "tensile_strength", "fracture_toughness", "carom.material"):
        assert word in line


@pytest.mark.parametrize(
    ("output", "missing"),
    [("crack_speed_second", "fracture_toughness"), ("tensile_speed_first", "tensile_strength")],
)
def test_an_output_whose_strength_is_missing_is_refused(output, missing):
    body = output.rpartition("_")[2]
    words = rf"(^|\(1\) ){missing}: missing for the {body} body, which {output} needs"
    refused(words, one_angle, [output])


def test_losses_are_refused_where_stresses_are_searched():
    words = "a sweep with losses or plates does not compute stresses"
    refused(words, one_angle, ["yield_speed_first"], restitution=0.9)


def test_a_material_without_the_strength_has_a_status_of_its_own():
    """One of two materials has no yield strength: its point says so, the other is solved."""
    grid = carom.Grid({"second.material": ["steel", "glass"]})
    dataset = carom.sweep(CASE, grid, outputs=["yield_speed_second", "rebound_angle"])
    assert dataset.status.values.tolist() == [PointStatus.SOLVED, PointStatus.STRENGTH_NOT_KNOWN]
    assert np.isfinite(dataset.yield_speed_second.values).tolist() == [True, False]
    assert np.isfinite(dataset.rebound_angle.values).all()  # which no strength matters to


def test_points_that_cannot_be_solved_have_their_status():
    speeds = carom.bearable_speeds(pair_of(), angle=["30 deg", "95 deg"], friction=[0.1, -0.1])
    assert speeds.status.values.tolist() == [
        [PointStatus.SOLVED, PointStatus.NOT_APPROACHING],
        [PointStatus.OUT_OF_RANGE, PointStatus.NOT_APPROACHING],
    ]
    assert np.isnan(speeds.yield_speed_second.values).tolist() == [[False, True], [True, True]]


def test_the_speed_told_is_the_speed_at_which_it_happens():
    """An impact at the speed of the map has the strength as its largest stress, spin or not."""
    pair = pair_of(tensile_strength="1 GPa")
    speeds = carom.bearable_speeds(pair, angle=["15 deg"], friction=[0.2])
    for name, share in (("yield_speed", "yield_ratio"), ("tensile_speed", "tension_ratio")):
        speed = float(speeds[f"{name}_second"][0, 0])
        peaks = carom.impact(pair, speed=speed, angle="15 deg").peaks()
        assert float(peaks[share].sel(body="second")) == pytest.approx(1.0, rel=1e-9)
    first = {"radius": "5 mm", "material": "bearing steel"}
    case = CASE | {"angle": "15 deg", "spin": 40.0, "first": first}
    grid = carom.Grid({"second.material": ["bearing steel"]})
    speed = float(carom.sweep(case, grid, outputs=["yield_speed_first"]).yield_speed_first[0])
    spinning = carom.impact(pair, speed=speed, angle="15 deg", spin=40.0 * speed)
    assert float(spinning.peaks().yield_ratio.sel(body="first")) == pytest.approx(1.0, rel=1e-9)


def test_what_is_missing_is_said():
    peaks = carom.impact(pair_of("steel", "glass"), speed=0.1, angle="30 deg").peaks()
    assert "first body: tensile_strength, fracture_toughness, flaw_size" in peaks.missing
    assert "second body: yield_strength, tensile_strength, flaw_size" in peaks.missing
    assert "toughness_ratio" not in peaks  # which would be NaN for both
    assert "unlike materials" in peaks.notes


def test_bodies_that_yield_make_stresses_upper_bounds():
    hit = carom.impact(pair_of(), speed=20.0, angle="30 deg")
    assert "upper bounds" in hit.peaks().notes
    finding = findings(hit)["von Mises stress/Y"]
    assert (finding.holds, finding.value > 1.0) == (False, True)
    assert "both bodies yield" in finding.verdict
    assert "upper bounds" in finding.verdict
    slow = carom.impact(pair_of(), speed=0.01, angle="30 deg")
    assert slow.peaks().notes == ""
    assert "both bodies stay elastic" in str(slow.validity)


def test_validity_judges_yield_with_friction():
    """Friction of 0.6 brings yield at a fraction of the pressure that it takes head-on."""
    by_name = {}
    for friction in (0.0, 0.6):
        hit = carom.impact(pair_of(friction=friction), speed=1.0, angle="45 deg")
        by_name[friction] = findings(hit)["von Mises stress/Y"].value
    assert by_name[0.6] == pytest.approx(by_name[0.0] * 1.085 / 0.62, rel=0.03)


def test_validity_judges_each_body_by_what_it_bears():
    hit = carom.impact(pair_of("steel", "glass", flaw_size="20 um"), speed=0.3, angle="30 deg")
    actual = findings(hit)
    assert "the first body yields" in actual["von Mises stress/Y"].verdict
    assert "flaws in the second body grow into cracks" in actual["K/K_c"].verdict
    assert "tension/strength" not in actual


@pytest.mark.parametrize("body", ["first", "second"])
def test_a_rigid_body_has_no_peaks(body, steel_ball, plate):
    rigid = carom.material("rigid", density=7850)
    if body == "first":
        pair = carom.Pair(carom.Sphere(radius="5 mm", material=rigid), plate, friction=0.2)
    else:
        pair = carom.Pair(steel_ball, carom.HalfSpace(material=rigid), friction=0.2)
    peaks = carom.impact(pair, speed=0.1, angle="30 deg").peaks()
    assert body not in peaks.body.values.tolist()
    assert peaks.body.size == 1


def test_losses_are_searched_from_a_depth_on():
    """At the surface a viscous body has no largest stress while it is loaded."""
    losses = carom.KelvinVoigt(restitution=0.9)
    hit = carom.impact(pair_of(), speed=0.5, angle="30 deg", losses=losses)
    peaks = hit.peaks()
    assert float(peaks.searched_depth) == pytest.approx(0.2 * hit.max_radius)
    for name in ("peak_von_mises", "peak_shear", "peak_tension"):
        assert (peaks[f"{name}_z"].values >= 0.2 * hit.max_radius * (1.0 - 1e-12)).all()
    elastic = carom.impact(pair_of(), speed=0.5, angle="30 deg").peaks(depth=peaks.searched_depth)
    assert peaks.peak_von_mises.values == pytest.approx(elastic.peak_von_mises.values, rel=0.05)
    refused("depth: 0 cannot be used; viscous bodies", hit.peaks, depth=0)
    refused("depth: '-1 mm' cannot be used", hit.peaks, depth="-1 mm")


def test_losses_leave_the_surface_unjudged():
    """Below a depth all may be well: that is no verdict on the body; beyond its strength it is."""
    pair = pair_of("bearing steel", "float glass", flaw_size="20 um", tensile_strength="50 MPa")
    motion = {"angle": "40 deg", "losses": carom.KelvinVoigt(restitution=0.98)}
    hits = [carom.impact(pair, speed=v, **motion) for v in (0.001, 8.0)]
    slow, fast = map(findings, hits)
    for name in ("von Mises stress/Y", "tension/strength", "K/K_c"):
        assert slow[name].holds is None
    assert "below a depth of" in slow["von Mises stress/Y"].verdict
    assert "not judged with losses" in slow["K/K_c"].verdict
    assert fast["von Mises stress/Y"].holds is False
    peaks = hits[0].peaks()
    assert "only below a depth of" in peaks.notes
    assert "stress_intensity (not bounded with losses)" in peaks.missing


def test_a_toughness_without_flaws_is_not_judged_and_said():
    hit = carom.impact(pair_of("bearing steel", "float glass"), speed=0.1, angle="30 deg")
    finding = findings(hit)["K/K_c"]
    assert finding.holds is None
    assert "no depth of the flaws in the surface of float-glass" in finding.verdict
    assert "Material(flaw_size=...)" in finding.verdict
    assert finding.missing == "flaw_size of float-glass"


def test_coupling_leaves_strength_unjudged_by_boundary_elements():
    """For unlike bodies they have other tractions than those by which stresses are told."""
    pair = pair_of("bearing steel", "float glass", flaw_size="20 um")
    coarse = carom.BoundaryElements(elements=8, steps=20)
    hit = carom.impact(pair, speed=0.3, angle="30 deg", method=coarse)
    finding = findings(hit)["K/K_c"]
    assert finding.holds is None
    assert "neglects the coupling of unlike materials" in finding.verdict


def test_maps_say_what_bounds_their_speeds():
    like = carom.bearable_speeds(pair_of(), angle=[0.1, 0.2])
    assert "lower bounds" in like.notes
    assert "radial tractions" not in like.notes
    glass = pair_of("bearing steel", "glass", flaw_size="9 um")
    unlike = carom.bearable_speeds(glass, angle=[0.1, 0.2])
    assert "radial tractions of unlike materials" in unlike.notes
    refused("one angle makes no curve", carom.plots.plot_strength, like.isel(angle=[0]))


def test_a_rigid_body_is_refused_where_its_stress_is_wanted():
    words = "the second body is rigid and has no stress"
    refused(words, one_angle, ["peak_shear_second"], second={"material": "rigid"})


def test_spheres_that_yield_have_no_known_stress():
    hit = carom.impact(pair_of(), speed=5.0, angle="30 deg", losses=carom.ElasticPlastic())
    refused(r"losses: .* a yielded contact", hit.peaks)
    assert "p_0/Y" in findings(hit)


def test_peaks_and_maps_are_stored_and_read_again(tmp_path):
    peaks = carom.impact(pair_of(), speed=0.5, angle="30 deg").peaks()
    speeds = carom.bearable_speeds(pair_of(), angle=[0.1, 0.8], friction=[0.1, 0.3])
    for name, dataset in (("peaks", peaks), ("strength", speeds)):
        again = carom.read(carom.save(dataset, tmp_path / f"{name}.nc"))
        for variable in dataset.data_vars:
            assert again[variable].values == pytest.approx(dataset[variable].values)
    figure = carom.plots.plot_strength(carom.read(tmp_path / "strength.nc"))
    assert len(figure.axes) == 2


def test_many_frictions_are_drawn_as_a_map():
    friction = np.linspace(0.0, 0.5, 7)
    speeds = carom.bearable_speeds(pair_of(), angle=[0.0, 0.5, 1.0], friction=friction)
    figure = carom.plots.plot_strength(speeds)
    assert figure.axes[0].get_ylabel().startswith("$\\mu$")
    none = speeds.drop_vars(["yield_speed_first", "yield_speed_second"])
    refused("no speed in this dataset is finite", carom.plots.plot_strength, none)


@pytest.mark.parametrize("resume", [False, True])
def test_a_map_can_be_stored_block_by_block(tmp_path, resume):
    """A sweep of speeds goes on where it was stopped, and gives what it gives in memory."""
    pytest.importorskip("zarr")
    grid = carom.Grid({"angle": np.linspace(0.0, 1.2, 5)})
    outputs = ["yield_speed_first", "peak_shear_second"]
    plain = carom.sweep(CASE, grid, outputs=outputs)
    store = tmp_path / "map.zarr"
    stored = carom.sweep(CASE, grid, outputs=outputs, store=store)
    if resume:
        stored = carom.sweep(CASE, grid, outputs=outputs, store=store, resume=True)
    for name in outputs:
        assert stored[name].values.tolist() == plain[name].values.tolist()
    assert json.loads(stored.attrs["inputs"])["outputs"] == outputs


def test_a_sweep_that_asks_for_no_stress_searches_for_none(monkeypatch):
    """The search takes a thousand times as long as an impact."""

    def searched(*_):
        raise AssertionError("searched")

    monkeypatch.setattr("carom.many.sweeps.points.strength_values", searched)
    assert carom.sweep(CASE, carom.Grid({"angle": [0.1, 0.2]})).status.values.tolist() == [0, 0]
    with pytest.raises(AssertionError, match="searched"):
        one_angle(["peak_shear_first"])
