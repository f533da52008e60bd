"""The copy of the page from disk, without a network, against the library."""

import json
import shutil

import numpy as np
import pytest
from tests.browser.scripts import script

import carom
from carom.explorer.export import export
from carom.explorer.scenes import scene_of
from carom.explorer.views import View
from carom.verify.errors import losses_of

pytestmark = [pytest.mark.browser, pytest.mark.slow]

STATES, PAIRS, THINNER = 1000, 100, 60
RESTITUTIONS = (1.0, 0.9, 0.7)
LATE = 2e-4  # of the duration, that a front which is quick may be early or late
CLOSE = 1e-3  # of the largest value of a history or profile
STEP = 1 / 600  # of the duration: how finely the copy follows an impact
HARDLY = 3e-4  # of the energy: what takes less is judged as if it took so much
SHORT = 2 * STEP  # phases that the copy may pass over
NEAR_FRONT = 0.01  # of the contact radius: there viscous tractions rise like a root
SOLVE = script("solve")
ANSWER = script("answer")
COUNTED = ("psi_in", "chi", "kappa", "duration", "max_force", "max_radius")


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A folder with a copy of the page."""
    folder = tmp_path_factory.mktemp("course") / "impact page"
    export(folder)
    yield folder
    shutil.rmtree(folder)


@pytest.fixture(scope="module")
def offline(chromium, copy):
    """The copy in a browser that has no network; nothing but its own files is asked for."""
    size = {"width": 1280, "height": 900}
    context = chromium.new_context(viewport=size, reduced_motion="reduce")
    context.set_offline(True)
    tab, trouble = context.new_page(), []
    tab.on("console", lambda m: m.type in ("error", "warning") and trouble.append(m.text))
    tab.on("pageerror", lambda error: trouble.append(str(error)))
    own = (copy.as_uri(), "data:", "blob:")
    tab.on("request", lambda r: r.url.startswith(own) or trouble.append(f"asked for {r.url}"))
    tab.goto(f"{copy.as_uri()}/index.html")
    drawn = "document.querySelector('#rebounds .main-svg') && Carom.page.answers()[0]"
    tab.wait_for_function(drawn)
    yield tab
    assert trouble == []
    context.close()


@pytest.fixture(scope="module")
def states():
    """Random states over all that the copy covers."""
    rng = np.random.default_rng(29)
    drawn = zip(rng.uniform(-10.0, 10.0, STATES), rng.uniform(0.5, 3.0, STATES), strict=True)
    return [(float(psi), float(chi), RESTITUTIONS[i % 3]) for i, (psi, chi) in enumerate(drawn)]


@pytest.fixture(scope="module")
def copied(offline, states):
    """What the copy makes of them."""
    return [json.loads(text) for text in offline.evaluate(SOLVE, states)]


@pytest.fixture(scope="module")
def solved(states):
    """What the library makes of them."""
    return [carom.solve(psi, chi, losses=losses_of(e)) for psi, chi, e in states]


def off(value, exact):
    """Return the largest difference, as a part of the largest value."""
    exact = np.asarray(exact)
    return float(np.max(np.abs(np.array(value) - exact)) / max(np.max(np.abs(exact)), 1e-300))


def test_rebounds(states, copied, solved):
    for state, value, exact in zip(states, copied, solved, strict=True):
        assert abs(value["out"] - exact.psi_out) <= 1e-6, state


@pytest.mark.parametrize("restitution", RESTITUTIONS)
def test_rebounds_of_tiny_velocities(offline, restitution):
    """psi_2/psi_1, which the table holds, where psi_2 itself is below 1e-6."""
    states = [
        (psi, chi, restitution) for psi in (1e-7, 1e-4, 9e-4) for chi in (0.5, 1.44, 2.5, 3.0)
    ]
    value = offline.evaluate("all => all.map(each => Carom.rebound.of(...each))", states)
    for (psi, chi, e), out in zip(states, value, strict=True):
        exact = carom.rebound(psi, chi, losses=losses_of(e))
        assert out / psi == pytest.approx(exact / psi, abs=5e-4)


def test_histories(states, copied, solved):
    for state, value, exact in zip(states, copied, solved, strict=True):
        history = exact.history(201)
        assert off(value["psi"], history.psi) <= CLOSE, state
        assert off(value["force"], history.force) <= CLOSE, state
        assert off(value["contact"], history.contact_radius) <= CLOSE, state
        energies = {
            "stored": history.stored,
            "dissipated": history.dissipated,
            "shear": history.shear_lost,
        }
        for name, exact_energy in energies.items():
            error = np.max(np.abs(value[name] - exact_energy))
            least = HARDLY * 0.5 * state[0] ** 2
            assert error <= CLOSE * max(np.max(exact_energy), least), (state, name)


def test_histories_of_thin_rings(offline):
    rng = np.random.default_rng(7)
    drawn = zip(
        np.exp(rng.uniform(*np.log([1e-3, 0.05]), THINNER)),
        rng.uniform(0.5, 3.0, THINNER),
        strict=True,
    )
    states = [(float(psi), float(chi), (0.9, 0.7)[i % 2]) for i, (psi, chi) in enumerate(drawn)]
    for state, text in zip(states, offline.evaluate(SOLVE, states), strict=True):
        history = carom.solve(*state[:2], losses=losses_of(state[2])).history(201)
        assert off(json.loads(text)["psi"], history.psi) <= CLOSE, state
        assert off(json.loads(text)["force"], history.force) <= CLOSE, state


def test_stick_radii(states, copied, solved):
    for state, value, exact in zip(states, copied, solved, strict=True):
        share = np.linspace(0.0, 1.0, 201)
        changes = [phase.start / exact.duration for phase in exact.phases[1:]]
        near = np.zeros(share.size, dtype=bool)
        for at in changes:
            near |= np.abs(share - at) < STEP
        times = np.clip(share + LATE * np.array([[-1.0], [0.0], [1.0]]), 0.0, 1.0)
        radii = exact.at((times * exact.duration).ravel()).stick_radius.reshape(3, -1)
        stick = np.array(value["stick"])
        within = (stick >= radii.min(axis=0) - CLOSE) & (stick <= radii.max(axis=0) + CLOSE)
        assert np.all(within | near), state


def test_phases(states, copied, solved):
    for state, value, exact in zip(states, copied, solved, strict=True):
        wanted = [
            (p.kind, p.sign, p.start / exact.duration, p.end / exact.duration) for p in exact.phases
        ]
        data = [(p["kind"], p["sign"], p["start"], p["end"]) for p in value["phases"]]
        wanted, data = ([p for p in all_ if p[3] - p[2] > SHORT] for all_ in (wanted, data))
        assert [p[:2] for p in data] == [p[:2] for p in wanted], state
        ends = np.array([p[2:] for p in data]) - np.array([p[2:] for p in wanted])
        assert np.max(np.abs(ends)) <= STEP, state


def test_tractions(states, copied, solved):
    line = np.linspace(0.0, 1.0, 33)
    for state, value, exact in zip(states, copied, solved, strict=True):
        instants = 61 if state[2] == 1.0 else 31
        times = np.linspace(0.0, exact.duration, instants)
        now = exact.at(times)
        data = np.array(value["tractions"])
        assert data.shape == (instants, line.size)
        wanted, kept = np.zeros_like(data), np.ones_like(data, dtype=bool)
        for row in range(1, instants - 1):
            wanted[row] = exact.traction(times[row], now.contact_radius[row] * line)
            if state[2] != 1.0:
                front = now.stick_radius[row] / now.contact_radius[row]
                kept[row] = np.abs(line - front) > NEAR_FRONT
        if state[2] != 1.0:
            kept[:, -1] = False  # where it is infinite
        wanted = np.clip(wanted / exact.max_radius, -9.0, 9.0)
        assert off(data[kept], wanted[kept]) <= CLOSE, state


def random_pairs():
    """Return links of impacts of bodies."""
    rng = np.random.default_rng(2)
    materials = ("bearing-steel", "soda-lime-glass", "alumina", "nylon", "own")
    for i in range(PAIRS):
        first, second = rng.choice(materials, 2)
        words = {
            "radius": round(float(rng.uniform(1.0, 20.0)), 3),
            "material": first,
            "against": ("half-space", "sphere", "cup")[i % 3],
            "second_radius": round(float(rng.uniform(25.0, 60.0)), 2),
            "second_material": second,
            "friction": round(float(rng.uniform(0.05, 0.8)), 3),
            "restitution": f"{RESTITUTIONS[i % 2]:g}",
            "speed": round(float(rng.uniform(0.1, 5.0)), 2),
            "angle": round(float(rng.uniform(0.0, 80.0)), 2),
            "spin": round(float(rng.uniform(-300.0, 300.0)), 1),
        }
        yield "&".join(f"{name}={value}" for name, value in words.items())


@pytest.fixture(scope="module")
def answers(offline):
    """Links of impacts of bodies, and what the copy says of them."""
    special = ("", "friction=0", "angle=0", "angle=0&spin=50", "friction=0&spin=-9")
    queries = [*random_pairs(), *special]
    return list(zip(queries, offline.evaluate(ANSWER, queries), strict=True))


def test_bodies(answers):
    for query, value in answers:
        scene = scene_of(View.of(query))
        assert "answer" in value, (query, value)
        rows = value["answer"]["results"]
        assert [row["name"] for row in rows] == [row["name"] for row in scene.results], query
        for row, exact in zip(rows, scene.results, strict=True):
            assert (row["symbol"], row["meaning"]) == (exact["symbol"], exact["meaning"])
            if row["name"] in COUNTED:
                assert row == exact, query
            else:
                same_number(row, exact, scene)


def same_number(row, exact, scene):
    """Check a number that follows from psi_2, or that springs give, in its unit."""
    if exact["value"].startswith("none"):
        assert row["value"] == exact["value"]
        return
    rough = scene.restitution != 1.0 and row["name"] in ("dissipated_energy", "shear_lost_energy")
    assert row["unit"] == exact["unit"]
    allowed = CLOSE if rough else 1e-5
    scale = max(abs(float(exact["value"])), 0.1)
    assert abs(float(row["value"]) - float(exact["value"])) <= allowed * scale, (row, exact)


def test_scenes_of_bodies(answers):
    for query, value in answers:
        scene, data = scene_of(View.of(query)), value["answer"]
        exact = scene.moving()
        assert data["scene"]["unit"] == exact["unit"]
        assert data["scene"]["duration"] == pytest.approx(exact["duration"], rel=1e-9)
        for name in ("time", "contact", "force", "rim"):
            assert np.max(np.abs(np.subtract(data["scene"][name], exact[name]))) < CLOSE, name
        stage, wanted = data["scene"]["stage"], exact["stage"]
        assert stage["caption"] == wanted["caption"], query
        assert np.allclose(stage["time"], wanted["time"], atol=2e-5)
        for body, other in zip(stage["bodies"], wanted["bodies"], strict=True):
            assert body["kind"] == other["kind"]
            assert body["radius"] == pytest.approx(other["radius"])
            size = max(1.0, *(np.max(np.abs(other[name])) for name in ("x", "y", "turn")))
            for name in ("x", "y", "turn"):
                assert np.allclose(body[name], other[name], atol=CLOSE * size), (query, name)
        for name, share in scene.energies.items():
            assert np.allclose(data["history"]["energies"][name], share, atol=CLOSE), (query, name)


def test_answers_are_those_of_the_server(offline):
    pytest.importorskip("carom.explorer.answers")
    from carom.explorer.answers import answer

    queries = ["given=numbers&psi=1.5", "given=numbers&psi=-3&chi=2&restitution=0.9", "angle=40"]
    for query, value in zip(queries, offline.evaluate(ANSWER, queries), strict=True):
        exact, data = json.loads(json.dumps(answer(View.of(query)))), value["answer"]
        assert set(data) == set(exact)
        assert set(data["scene"]) >= set(exact["scene"])
        assert (data["query"], data["carried"]) == (exact["query"], exact["carried"])
        assert set(data["history"]) == set(exact["history"])
        assert list(data["history"]["energies"]) == list(exact["history"]["energies"])
        assert data["history"]["unit"] == exact["history"]["unit"]
        assert data["curve"]["borders"] == pytest.approx(exact["curve"]["borders"])
        assert data["curve"]["at"] == pytest.approx(exact["curve"]["at"], abs=1e-6)
        exact_curve = carom.rebound(
            data["curve"]["psi"],
            scene_of(View.of(query)).chi,
            losses=losses_of(scene_of(View.of(query)).restitution),
        )
        assert np.allclose(data["curve"]["out"], exact_curve, atol=2e-6)
        assert [data["curve"]["psi"][i] for i in (0, -1)] == [
            exact["curve"]["psi"][i] for i in (0, -1)
        ]


REFUSED = {
    "given=numbers&chi=4": ("chi", "0.5 to 3"),
    "restitution=0.95": ("restitution", "1, 0.9, 0.7 only"),
    "angle=95": ("angle", "must be a number from 0 to 89.9 deg, not '95'"),
    "speed=fast": ("speed", "not 'fast'"),
    "radius=3 cm": ("radius", "not '3 cm'; this copy takes mm only"),
    "given=numbers&friction=0": ("friction", "must be above 0"),
    "speed=": ("speed", "it is empty"),
    "against=cup&second_radius=2": ("second_radius", "must be above 5 mm"),
    "against=sphere&second_material=rigid": ("second_material", "density"),
    "material=cheese": ("material", "there is no 'cheese'; there are steel; "),
    "law=cheese": ("law", "there is no 'cheese'; there are "),
    "taste=mild": ("", "the link says 'taste', which is unknown; leave it out"),
    "thickness=3": ("thickness", "there is no '3'; there are thick"),
    "given=numbers&inelasticity=0.4": ("inelasticity", "there is no '0.4'; there are 0"),
    "a" * 20000: ("", "the link has 20000 characters; at most "),
}


def test_refusals(offline):
    for query, (field, words) in REFUSED.items():
        (value,) = offline.evaluate(ANSWER, [query])
        assert value["refusal"]["field"] == field, query
        assert words in value["refusal"]["message"]
    (unused,) = offline.evaluate(ANSWER, ["given=numbers&angle=95"])
    assert "answer" in unused
    (twice,) = offline.evaluate(ANSWER, ["angle=95&angle=40&pace=5"])
    assert twice["answer"]["query"] == "angle=40"


def test_links_that_say_a_number_otherwise(offline):
    """The copy knows few restitutions; 0.90 is one of them. What it does not know is copied."""
    ask = """query => {
      const odd = Carom.fields.set(new URLSearchParams(query));
      return [Carom.fields.value("restitution"), odd];
    }"""
    assert offline.evaluate(ask, "restitution=0.90") == ["0.9", []]
    assert offline.evaluate(ask, "restitution=1.0") == ["1", []]
    shown, (odd,) = offline.evaluate(ask, "restitution=0.95")
    assert (shown, "0.95; this copy has 1, 0.9, 0.7 only, and 1 is shown" in odd) == ("1", True)
    shown, (odd,) = offline.evaluate(ask, "thickness=3")
    assert odd == "Its thickness: there is no 3; this copy has thick only, and thick is shown"
    hint = offline.get_attribute("label[for=thickness]", "title")
    assert hint == "this copy has thick walls only; the program takes plates"
    shown, (odd,) = offline.evaluate(ask, "data=kharaz2001")
    assert (shown, odd.endswith("not fitted in this copy")) == ("1", True)


def test_what_needs_the_library_says_so(offline):
    can, why = offline.evaluate("[Carom.source.can, Carom.source.why]")
    assert not any(can.values())
    assert "carom explore" in why
    assert offline.evaluate("Carom.source.fit({}).catch(refusal => refusal.message)") == why


def test_size(copy):
    assert sum(each.stat().st_size for each in copy.rglob("*") if each.is_file()) <= 15e6
