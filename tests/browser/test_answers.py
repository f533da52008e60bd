"""What the page makes of a link is what the library makes of it: numbers, histories, paths."""

import re
from functools import cache

import numpy as np
import pytest
from tests.browser.scripts import script

import carom
from carom.bodies.losses import ZENER
from carom.dimensionless.law import SOLID
from carom.dimensionless.rebounds import regime_borders
from carom.page.views import PAGE, View
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed, shared

pytestmark = pytest.mark.browser

DRAWN = 28
MATERIALS = ("bearing-steel", "soda-lime-glass", "alumina", "nylon", "own")
AGAINST = ("half-space", "plate", "cup", "sphere")
SPECIAL = (
    *("", "friction=0", "angle=0", "angle=0&spin=50", "friction=0&spin=-9&restitution=0.8"),
    "against=sphere&angle=85&friction=10&spin=1000",  # thrown back while they touch
)
NUMBERS = (
    *("psi=1.5", "psi=-3&chi=0.2&restitution=0.9", "psi=0.4&chi=7&restitution=0.35"),
    *("psi=2&inelasticity=0.5", "psi=-6&chi=2.5&friction=0.7&inelasticity=1.6", "psi=0"),
)
FINE = 1e-6  # of histories and curves; viscous ones are solved as closely in the browser
DRAWN_TO = 2e-5  # radii; of what is magnified the page keeps five decimals
BEYOND = 120  # times before the contact, and as many after


def bodies(random, against):
    """Return the link of an impact of bodies."""
    first, second = random.choice(MATERIALS, 2)
    words = {
        "radius": round(random.uniform(1.0, 20.0), 3),
        "material": first,
        "second_material": second,
        "young": round(random.uniform(1.0, 400.0), 1),
        "second_poisson": round(random.uniform(0.0, 0.5), 3),
        "second_density": round(random.uniform(900.0, 9000.0)),
        "friction": round(random.uniform(0.05, 0.8), 3),
        "speed": round(random.uniform(0.1, 5.0), 2),
        "angle": round(random.uniform(0.0, 80.0), 2),
        "spin": round(random.uniform(-300.0, 300.0), 1),
    }
    if against == "plate":
        words["thickness"] = round(words["radius"] * random.uniform(0.8, 4.0), 2)
    else:
        words |= {"against": against, "second_radius": round(random.uniform(25.0, 60.0), 2)}
        words["restitution"] = random.choice([1.0, 0.9, 0.62])
    return "&".join(f"{name}={value}" for name, value in words.items())


@pytest.fixture(scope="module")
def cases(tabs):
    """Links of bodies, what the page makes of each, its impact, and what decides the restitution.

    Made when they are first asked for, in the tab that is there then.
    """

    @cache
    def made():
        random = np.random.default_rng(50)
        links = [*(bodies(random, AGAINST[i % len(AGAINST)]) for i in range(DRAWN)), *SPECIAL]
        told = zip(links, answers(tabs[0].page, links), strict=True)
        return [(link, data, *hit_of(View.of(link))) for link, data in told]

    return made


def answers(page, links):
    """Return what the page makes of links."""
    told = page.evaluate(script("answer"), links)
    assert [each for each in told if "refusal" in each] == []
    return [each["answer"] for each in told]


def hit_of(view):
    """Return the impact of a view, and the losses that alone decide its restitution."""
    hit = carom.impact(view.pair, losses=view.losses, **view.motion)
    give = view.pair.plate_give(hit.normal_speed)
    losses = carom.ZenerPlate(inelasticity=ZENER * give) if give else view.losses
    return hit, give, losses


def printed(numbers, view):
    """Return the rows of the results."""
    signs = PAGE["signs"] | (PAGE["signs_of_losses"] if view.is_lossy else {})
    for name in filter(numbers.__contains__, signs):
        number, unit = numbers[name], GLOSSARY[name].unit
        if np.isfinite(number):
            number, unit = (np.degrees(number), "deg") if unit == "rad" else (number, unit)
            (value,), unit = shared((number,), unit)
            yield name, value, unit.replace("1", "")
        else:
            yield name, f"none: it {'was zero before' if np.isnan(number) else 'slides freely'}", ""


def check_rows(data, numbers, view):
    told = [(row["name"], row["value"], row["unit"]) for row in data["results"]]
    assert told == list(printed(numbers, view))


def check_curve(data, solution, losses, borders):
    curve = data["curve"]
    wanted = carom.rebound(curve["psi"][::5], solution.chi, losses=losses)
    assert curve["out"][::5] == pytest.approx(wanted, abs=FINE)
    assert curve["at"] is None or curve["at"] == pytest.approx([solution.psi_in, solution.psi_out])
    assert curve["borders"] == pytest.approx(borders, rel=1e-9)


def check_energies(data, columns):
    energies = data["history"]["energies"]
    whole = sum(np.asarray(columns[name]) for name in energies)
    for name, share in energies.items():
        assert share == pytest.approx(np.asarray(columns[name]) / (whole[0] or 1.0), abs=FINE), name


def travelled(speed, duration):
    """Return the integral of a speed over even times, as `continued`."""
    steps = 0.5 * (speed[1:] + speed[:-1]) * duration / (len(speed) - 1)
    return continued(np.concatenate([[0.0], np.cumsum(steps)]), speed[0], speed[-1], duration)


def continued(path, before, after, duration):
    """Return a path with what comes before and after it at constant speed."""
    away = np.arange(1, BEYOND + 1) * duration / (len(path) - 1)
    return np.concatenate([path[0] - away[::-1] * before, path, path[-1] + away * after])


def seen(stage):
    """Return how far the first body has moved along the second, and how far into it."""
    first, second = stage["bodies"]
    x, y = (np.subtract(first[name], second[name]) for name in "xy")
    size = second["radius"]
    if second["kind"] in ("plane", "plate"):
        return x, 1.0 - y
    if second["kind"] == "sphere":
        return (1.0 + size) * np.arctan2(x, y), 1.0 + size - np.hypot(x, y)
    return (size - 1.0) * np.arctan2(x, -y), np.hypot(x, y) - (size - 1.0)


def check_paths(stage, along, spins, speed, penetration, duration):
    """Compare paths with speeds and penetration, in radii; all are magnified alike."""
    first, second = stage["bodies"]
    way, closer = data = seen(stage)
    deep = continued(penetration, speed[0], speed[-1], duration)
    exact = np.array([travelled(along, duration), deep])
    large = np.sum(data * exact) / np.sum(exact**2)
    assert closer == pytest.approx(large * deep, abs=DRAWN_TO * (1.0 + second["radius"]))
    wide = DRAWN_TO * max(1.0, np.max(np.abs(way))) * (1.0 + second["radius"])
    assert way == pytest.approx(large * exact[0], abs=wide)
    check_turns(stage, spins, large, duration)
    if second["kind"] == "plate":
        fallen = large * travelled(speed, duration)
        assert first["y"] == pytest.approx(1.0 - fallen, abs=DRAWN_TO * (1.0 + large))


def check_turns(stage, spins, large, duration):
    for body, spin in zip(stage["bodies"], spins, strict=True):
        turn = large * travelled(spin, duration)
        assert body["turn"] == pytest.approx(turn, abs=DRAWN_TO * max(1.0, np.max(np.abs(turn))))
    told = re.match(r"motion magnified (\S+) times", stage["caption"])
    assert not told or float(told[1]) == pytest.approx(large, rel=6e-3)


def check_balls(stage, hit, history):
    """Compare the paths of two balls with their velocities, the second at rest before.

    Before and after the contact both fly straight; while they touch, the first follows the surface
    of the second, whose centre nears by the penetration.
    """
    radius = hit.pair.first.radius
    first, second = (np.array([body["x"], body["y"]]) for body in stage["bodies"])
    size, near = stage["bodies"][1]["radius"], DRAWN_TO * (1.0 + stage["bodies"][1]["radius"])
    inside = slice(BEYOND, -BEYOND)
    x, y = (first - second)[:, inside]
    closer, deep = 1.0 + size - np.hypot(x, y), history["penetration"].values / radius
    large = np.sum(closer * deep) / np.sum(deep**2)
    assert closer == pytest.approx(large * deep, abs=near)

    along = history["tangential_speed"].values / radius
    way = travelled(along, hit.duration)[inside]
    rolled = (1.0 + size) * np.arctan2(x, y)
    assert rolled == pytest.approx(large * (way - 0.5 * way[-1]), abs=near * (1.0 + abs(way[-1])))
    masses = hit.pair.first.mass, hit.pair.second.mass
    now = np.array([along, -history["normal_velocity"].values / radius])
    pushed = (now[:, :1] - now) * masses[0] / sum(masses)
    for path, velocity in ((first, now + pushed), (second, pushed)):
        steps = large * hit.duration / (history.sizes["time"] - 1)
        before, after = np.diff(path[:, :BEYOND]), np.diff(path[:, -BEYOND:])
        for moved, speed in ((before, velocity[:, 0]), (after, velocity[:, -1])):
            assert moved == pytest.approx(
                np.repeat(steps * speed[:, np.newaxis], moved.shape[1], 1), abs=DRAWN_TO
            )
    assert np.ptp(second[:, : BEYOND + 1], axis=1) == pytest.approx([0.0, 0.0], abs=DRAWN_TO)
    apart = np.hypot(*(first - second)) - 1.0 - size
    assert apart[:BEYOND].min() > -near
    assert apart[-BEYOND:].min() > -near - large * deep[-1]  # viscous bodies part while deformed
    spins = [history[name].values for name in ("spin", "spin2")]
    check_turns(stage, spins, large, hit.duration)


def as_seen(hit, history):
    """Return the kinetic energies of a history as one sees them, the struck ball at rest before.

    Those of the library are in the frame of the centre of mass.
    """
    columns = {name: history[name].values for name in history.data_vars}
    if len(hit.pair.moving) == 2:
        masses = hit.pair.first.mass, hit.pair.second.mass
        for name, speed in (("normal", "normal_velocity"), ("tangential", "tangential_speed")):
            now = history[speed].values
            centre = masses[0] * now[0] / sum(masses)
            columns[f"{name}_kinetic_energy"] = (
                columns[f"{name}_kinetic_energy"] + 0.5 * sum(masses) * centre**2
            )
    return columns


@pytest.mark.usefixtures("page")
def test_bodies(cases):
    for query, data, hit, give, losses in cases():
        view = View.of(query)
        assert View.of(data["query"]) == view
        numbers = hit.scalars()
        if give:
            del numbers["shear_lost_energy"]  # bodies on plates are elastic
        if abs(numbers["spin_out"]) < 1e-9 * abs(hit.spin):
            numbers["spin_out"] = 0.0
        check_rows(data, numbers, view)
        e = hit.normal_restitution if give else view.restitution
        turning = 1.25 * give * hit.solution.max_force
        check_curve(data, hit.solution, losses, regime_borders(view.pair.chi, e, turning))
        history = hit.history(201)
        check_energies(data, as_seen(hit, history))
        newtons, unit = prefixed(view.friction * hit.max_force or hit.max_force, "N")
        assert data["history"]["unit"] == unit
        for name, column in (("force", "tangential_force"), ("limit", "normal_force")):
            wanted = newtons * history[column].values * (1.0 if name == "force" else view.friction)
            largest = max(np.max(np.abs(wanted)), 1e-3)
            assert data["history"][name] == pytest.approx(wanted, abs=FINE * largest)
        seconds, unit = prefixed(hit.duration, "s")
        assert data["scene"]["unit"] == unit
        assert data["scene"]["duration"] == pytest.approx(seconds * hit.duration, rel=1e-9)
        carried = {"psi": hit.psi_in, "chi": view.pair.chi, "inelasticity": ZENER * give}
        assert data["carried"] == (
            None if np.isinf(hit.psi_in) else pytest.approx(carried, rel=1e-5)
        )


@pytest.mark.usefixtures("page")
def test_paths_of_bodies(cases):
    for _, data, hit, *_ in cases():
        history, radius = hit.history(201), hit.pair.first.radius
        if data["scene"]["stage"]["bodies"][1]["kind"] == "sphere":
            check_balls(data["scene"]["stage"], hit, history)
            continue
        speeds = ("tangential_speed", "normal_velocity", "penetration")
        along, speed, deep = (history[name].values / radius for name in speeds)
        spins = [history[name].values for name in ("spin", "spin2")]
        check_paths(data["scene"]["stage"], along, spins, speed, deep, hit.duration)


@pytest.mark.usefixtures("page")
def test_where_two_balls_go_and_what_is_left(cases):
    """By the impulses, in the frame in which the struck ball was at rest."""
    balls = [(data, hit) for _, data, hit, *_ in cases() if len(hit.pair.moving) == 2]
    assert len(balls) > 5
    for data, hit in balls:
        m, other = hit.pair.first.mass, hit.pair.second.mass
        normal = hit.pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
        along, onwards = (
            hit.tangential_speed - hit.tangential_impulse / m,
            hit.normal_speed - normal / m,
        )
        numbers = data["numbers"]
        assert numbers["along"] == pytest.approx(along, rel=1e-8, abs=1e-9)
        assert numbers["onwards"] == pytest.approx(onwards, rel=1e-8, abs=1e-9)
        assert numbers["throw"] == pytest.approx(np.arctan2(hit.tangential_impulse, normal))

        pushed = hit.tangential_impulse / other, normal / other
        spins = [[hit.spin, 0.0], [hit.spin_out, hit.spin2_out]]
        spinning = [
            sum(
                0.2 * body.mass * (body.radius * spin) ** 2
                for body, spin in zip(hit.pair.moving, each, strict=True)
            )
            for each in spins
        ]
        before = 0.5 * m * np.hypot(hit.tangential_speed, hit.normal_speed) ** 2 + spinning[0]
        moving = 0.5 * m * np.hypot(along, onwards) ** 2 + 0.5 * other * np.hypot(*pushed) ** 2
        kept = (moving + spinning[1]) / before
        assert numbers["energy_kept"] == pytest.approx(kept, rel=2e-6)


def test_numbers(page):
    links = [f"given=numbers&{words}" for words in NUMBERS]
    for query, data in zip(links, answers(page, links), strict=True):
        view = View.of(query)
        solved = carom.solve(view.psi, view.chi, losses=view.losses)
        assert View.of(data["query"]) == view
        numbers = {"psi_in": view.psi, "psi_out": solved.psi_out, "chi": view.chi}
        numbers |= {"contact_restitution": solved.psi_out / view.psi} if view.psi else {}
        numbers |= {"normal_restitution": solved.restitution} if view.on_plate else {}
        check_rows(data, numbers, view)
        e = solved.restitution if view.on_plate else view.restitution
        turning = 1.25 * view.inelasticity / ZENER * solved.max_force
        check_curve(data, solved, view.losses, regime_borders(view.chi, e, turning))
        history = solved.history(201)
        energies = {
            "contact_kinetic_energy": 0.5 * history.psi**2,
            "tangential_elastic_energy": history.stored,
            "frictional_work": history.dissipated,
            "shear_loss": history.shear_lost,
        }
        check_energies(data, energies)
        assert data["history"]["force"] == pytest.approx(1.5 * history.force, abs=FINE)
        assert data["history"]["limit"] == pytest.approx(history.normal_force, abs=FINE)
        assert (data["carried"], data["scene"]["duration"]) == (
            None,
            pytest.approx(solved.duration),
        )
        slope, lost = view.friction / (SOLID * view.chi), view.psi - history.psi
        along = slope * (view.psi - 2.0 / 7.0 * lost)
        spins = [-5.0 / 7.0 * slope * lost, 0.0 * lost]
        speed, deep = history.centre_speed, history.penetration
        check_paths(data["scene"]["stage"], along, spins, speed, deep, solved.duration)
