"""Bodies of any shape in case files, commands, sweeps, figures and films; what refuses them."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import carom
from carom.bodies.cases import case_of, pair_of
from carom.cli.commands import app
from carom.status import PointStatus

ROD = {"kind": "rod", "length": "100 mm", "radius": "3 mm", "angle": "40 deg", "material": "steel"}
FIRST = {
    "rod": ROD,
    "cylinder": {
        **{"kind": "cylinder", "length": "4 mm", "radius": "2 cm", "edge_radius": "1 mm"},
        **{"angle": "70 deg", "material": "steel"},
    },
    "ellipsoid": {
        **{"kind": "ellipsoid", "semi_axes": ["20 mm", "20 mm", "30 mm"], "angle": "30 deg"},
        "material": "rubber",
    },
    "clump": {
        **{"kind": "clump", "centres": [["-3 mm", 0, 0], ["3 mm", 0, "4 mm"]]},
        **{"radii": ["5 mm", "5 mm"], "material": "glass"},
    },
    "egg": {
        **{"kind": "ellipsoid", "semi_axes": ["20 mm", "25 mm", "30 mm"], "angle": "30 deg"},
        **{"material": "rubber", "in_space": True},
    },
    "body": {
        **{"kind": "body", "mass": "10 g", "inertia": 8e-6, "contact": ["3 cm", "-4 cm"]},
        **{"curvature_radius": "3 mm", "material": "steel"},
    },
}
SOLID = [
    *("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy"),
    *("normal_elastic_energy", "tangential_elastic_energy", "frictional_work"),
]


def case(first: dict[str, object] = ROD, **more: object) -> dict[str, object]:
    return {"friction": 0.5, "first": first, "normal_speed": 1.0, **more}


def hit_of(content: dict[str, object], **more: object) -> carom.results.BodyImpact:
    return carom.impact(pair_of(content), normal_speed=1.0, **more)


def rows(content: dict[str, object], path: Path) -> list[str]:
    """Store a case as a file; return the options that name it."""

    def written(value: object) -> str:
        if isinstance(value, dict):
            return "{" + ", ".join(f"{key} = {written(v)}" for key, v in value.items()) + "}"
        return json.dumps(value)

    path.write_text("\n".join(f"{key} = {written(value)}" for key, value in content.items()))
    return [str(path)]


@pytest.mark.first_case
@pytest.mark.parametrize("kind", FIRST)
def test_a_case_file_is_what_its_maker_gives(kind: str, tmp_path: Path) -> None:
    options = {key: value for key, value in FIRST[kind].items() if key != "kind"}
    maker = carom.Body if kind == "body" else getattr(carom.shapes, FIRST[kind]["kind"])
    wall = carom.HalfSpace(options["material"])
    hit = carom.impact(carom.Pair(maker(**options), wall, 0.5), normal_speed=1.0)
    asked = ["impact", *rows(case(FIRST[kind]), tmp_path / "case.toml"), "--json"]
    answer = json.loads(CliRunner().invoke(app, asked).stdout)
    expected = json.loads(json.dumps(hit.to_dict()))
    assert answer == expected
    assert str(hit).startswith("Rebound")
    assert "speed of the centres" in hit._repr_html_()
    again = pair_of(case_of(pair_of(case(FIRST[kind]))))
    assert again.inverse_mass == pytest.approx(hit.pair.inverse_mass, rel=1e-12)
    assert again.kappas == hit.pair.kappas


def test_a_key_of_another_kind_is_refused(tmp_path: Path) -> None:
    for key, value in {"gyration_radius": 0.1, "semi_axes": [1, 2, 3], "mass": 1.0}.items():
        with pytest.raises(carom.InputError, match=f"{key}: .* a rod has none"):
            pair_of(case({**ROD, key: value}))
    with pytest.raises(carom.InputError, match="length: missing for a rod; give it in its table"):
        pair_of(case({"kind": "rod", "radius": 0.01, "material": "steel"}))
    with pytest.raises(carom.InputError) as error:  # all that is wrong with it, at once
        pair_of(case({**ROD, "radius": -1.0, "mass": 1.0, "material": "wax"}))
    assert [fault.partition(":")[0] for fault in error.value.faults] == [
        "mass",
        "material",
        "radius",
    ]
    with pytest.raises(carom.InputError, match="length: 1 cannot be used; a sphere has none"):
        pair_of(case({"length": 1, "radius": "5 mm", "material": "steel"}))
    ball, lengths = {"radius": "5 mm", "material": "steel"}, carom.Grid({"first.length": [0.1]})
    with pytest.raises(carom.InputError, match=r"first\.length: a half-space has none"):
        carom.sweep(case(ball), lengths)


def test_a_sweep_is_an_impact_at_each_point() -> None:
    grid = carom.Grid({"first.angle": ["10 deg", "40 deg"], "spin": [0.0, 3.0, -300.0, 300.0]})
    result = carom.sweep(case(), grid)
    expected = [[0, 0, PointStatus.NOT_APPROACHING, 0], [0, 0, PointStatus.NOT_APPROACHING, 0]]
    assert result.status.values.tolist() == expected
    for i, angle in enumerate(result.first_angle.values):
        for j, spin in enumerate(result.spin.values[:2]):
            hit = hit_of(case({**ROD, "angle": float(angle)}), spin=spin)
            point = result.isel(first_angle=i, spin=j)
            for name in ("psi_out", "normal_restitution", "spin_out", "dissipated_energy"):
                assert float(point[name]) == getattr(hit, name), name
    assert np.isnan(result.psi_out.values[:, 2]).all()


def test_points_that_are_no_bodies_have_a_status() -> None:
    angles = carom.Table({"first.angle": [0.5, 1.57079632679, 3.0]})
    assert carom.sweep(case(), angles).status.values.tolist() == [0, 2, 2]
    whole = case({**FIRST["body"], "inertia": np.eye(3).tolist(), "contact": [0.0, 0.0, -0.1]})
    with pytest.raises(carom.InputError, match="sweeps take bodies that move in a plane"):
        carom.sweep(whole, carom.Grid({"friction": [0.1]}))
    with pytest.raises(carom.InputError, match=r"outputs: 'peak_tension_first' .* spheres only"):
        carom.sweep(case(), carom.Grid({"friction": [0.1]}), outputs=["peak_tension_first"])


@pytest.mark.parametrize("kind", FIRST)
def test_energies_of_the_history_add_up(kind: str) -> None:
    turning = {"tangential_speed": 0.4, "spin": 2.0}
    if kind == "egg":
        turning = {"tangential_speed": [0.4, -0.2], "spin": [1.0, -2.0, 3.0]}
    history = hit_of(case(FIRST[kind]), **turning).history(60)
    energies = np.array([history[name].values for name in SOLID])
    assert energies.sum(axis=0) == pytest.approx(energies[:, 0].sum(), rel=1e-12)
    assert np.diff(energies[-1]).min() > -1e-5 * energies[:, 0].sum()


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["rod", "egg"])
def test_a_history_of_few_times_has_the_same_columns(kind: str) -> None:
    hit = hit_of(case(FIRST[kind]))
    many = hit.history(9).isel(time=[0, 4, 8])
    assert list(hit.history(3)) == list(many)
    np.testing.assert_allclose(hit.history(3).normal_velocity, many.normal_velocity, rtol=1e-12)
    assert list(hit.history(2)) == list(many)


def test_figures_and_films(tmp_path: Path) -> None:
    hit = hit_of(case())
    assert len(hit.plot().axes) == 4
    assert hit.animate(tmp_path / "rod.gif", frames=2).stat().st_size > 1000
    stored = carom.read(carom.save(hit, tmp_path / "rod.nc"))
    assert float(stored.psi_out) == hit.psi_out
    worn = hit.wear(101)
    assert float(worn.work_error) < 2e-3  # springs' own work of friction


@pytest.mark.parametrize("law", [carom.Metal(), carom.ElasticPlastic(), None])
def test_a_law_of_yield_is_no_fault(law: object) -> None:
    findings = {each.name: each.holds for each in hit_of(case(), losses=law).validity.findings}
    assert findings["p_0/Y"] is (law is not None)


def test_what_is_not_known_is_refused() -> None:
    egg = hit_of(case(FIRST["ellipsoid"]))
    for ask in (egg.fields, egg.contact, egg.wear, egg.peaks):
        with pytest.raises(carom.InputError, match="known of round contacts in a plane"):
            ask(**({"at": 0.5 * egg.duration} if ask in (egg.fields, egg.contact) else {}))
    viscous = hit_of(case(), losses=carom.KelvinVoigt(restitution=0.9))
    with pytest.raises(carom.InputError, match=r"losses: .* which is not known off the centre"):
        viscous.contact(at=0.5 * viscous.duration)
    with pytest.raises(carom.InputError, match="spectra are those of spheres"):
        egg.spectrum()
    pair = pair_of(case())
    for more, words in {
        "method": ("halfspace", "method: 'halfspace' .* of spheres only"),
        "normal_spin": (3.0, "normal_spin: 3.0 .* of spheres only"),
        "spin2": (3.0, "spin2: 3.0 .* the second body does not move"),
        "spin": ([1.0, 2.0, 3.0], "spin: .* the bodies move in a plane"),
    }.items():
        with pytest.raises(carom.InputError, match=words[1]):
            carom.impact(pair, normal_speed=1.0, **{more: words[0]})
    with pytest.raises(carom.InputError, match=r"speed: 1e-190 m/s .* floating point cannot hold"):
        carom.impact(pair, normal_speed=1e-190)
    with pytest.raises(carom.InputError, match=r"normal_speed: .* the contact points part at"):
        carom.impact(pair, normal_speed=1.0, spin=-300.0)
