r"""Cool a gas of spheres by friction
=================================

`carom.collide` in a loop makes a granular gas: here spheres cool by friction alone, in 3-D.

Nothing is lost along the normal, :math:`e = 1`, but slip takes its share of every collision. At
first slip makes the spheres spin. Then both temperatures fall as :math:`t^{-2}` in a constant
ratio, because the way a sphere leaves depends on the direction of approach and not on the speed.
Walton's law, fitted to the exact one, does as well while spheres slide. Where they stick, at large
:math:`\mu`, it leaves too much spin. Perfectly rough spheres lose nothing.

`python granular_gas.py --spheres 1e6` simulates a million, which takes a minute for each law; with
`--restitution 0.9` spheres are viscoelastic. The gas is simulated directly, by Bird's scheme
without time counter (1994, 11.1), in batches. Pairs that share a sphere take turns, so no error of
a time step remains. Grey: the gas is Maxwellian at all times, which is exact at the start (for
constant :math:`\beta` Huthmann & Zippelius 1997).
"""

import argparse
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.progress import Progress
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled

BALL = carom.Sphere(radius="1 mm", material="soda-lime-glass")
PAIR = carom.Pair(BALL, BALL, friction=1.0)
WALTON = "Walton, fitted"
LAWS = {
    "exact": None,
    WALTON: carom.laws.fit_walton(PAIR).law,
    "perfectly rough": carom.laws.RoughLaw(),
}
UNTIL = 50  # collisions of a sphere

# %%
# The gas, its rates by kinetic theory, and the figure.
Q = BALL.gyration_ratio
NODES, WEIGHTS = (0.5 * each for each in np.polynomial.legendre.leggauss(120))
LOOKS = {
    name: {"color": color, "ls": dash}
    for name, color, dash in zip(LAWS, LINES, DASHES, strict=False)
}


class History(NamedTuple):
    """The history of a gas: arrays in time, with temperatures divided by that at the start."""

    time: np.ndarray  # in mean free times at the start
    collisions: np.ndarray  # of one sphere so far
    translational: np.ndarray
    rotational: np.ndarray
    drift: np.ndarray  # |mean velocity| over the thermal one; zero while momentum is kept

    @property
    def ratio(self):
        """T_rot/T_tr."""
        return self.rotational / self.translational

    def between(self, first, last):
        """The steps between two numbers of collisions of a sphere."""
        return slice(*np.searchsorted(self.collisions, [first, last]))

    def slope(self, first, last):
        """Rate of T_tr^(-1/2), which is constant where T_tr falls as t^-2."""
        time, cold = (x[self.between(first, last)] for x in (self.time, self.translational**-0.5))
        return (cold[-1] - cold[0]) / (time[-1] - time[0])


class Gas:
    """A gas: velocities in (T_0/m)^(1/2), here 1 m/s, spins in rad/s; positions do not matter."""

    def __init__(self, spheres, seed):
        self.random = np.random.default_rng(seed)
        self.velocity = self.random.standard_normal((spheres, 3))
        self.velocity -= self.velocity.mean(axis=0)
        self.velocity *= np.sqrt(3 * spheres / np.sum(self.velocity**2))
        self.spin = np.zeros((spheres, 3))
        self.earliest = np.empty(spheres, dtype=np.int64)
        self.time, self.hits = 0.0, 0

    def state(self):
        """Time, collisions of one sphere, both temperatures, drift."""
        count = len(self.velocity)
        moving, turning = (squares(each).sum() / (3 * count) for each in (self.velocity, self.spin))
        drift = np.linalg.norm(np.einsum("ij->j", self.velocity)) / count
        return self.time, 2 * self.hits / count, moving, Q * BALL.radius**2 * turning, drift

    def advance(self, law):
        """Let one batch of candidates pass; return how many pairs collided.

        Of all pairs N (N-1)/2 each meets sigma_T g_max dt/V candidates in dt, and collides with
        probability g/g_max; g_max is twice the largest speed, which no pair can exceed.
        """
        count, before = len(self.velocity), self.hits
        batch = max(count // 3, 1)
        largest = 2 * np.sqrt(squares(self.velocity).max())
        one, other = (self.random.integers(size, size=batch) for size in (count, count - 1))
        other += other >= one
        for each, partner in self.apart(one, other):
            self.hits += self.collide(each, partner, largest, law)
        self.time += 8 * batch / ((count - 1) * np.sqrt(np.pi) * largest)
        return self.hits - before

    def apart(self, one, other):
        """Yield pairs that share no sphere, in groups: each pair after all that it depends on."""
        while one.size:
            order = np.arange(one.size)
            for spheres in (one, other):
                self.earliest[spheres] = one.size
            for spheres in (one, other):
                np.minimum.at(self.earliest, spheres, order)
            free = (self.earliest.take(one) == order) & (self.earliest.take(other) == order)
            yield one[free], other[free]
            one, other = one[~free], other[~free]

    def collide(self, one, other, largest, law):
        """Let candidates that share no sphere collide or not; return how many did."""
        approach = self.velocity.take(one, axis=0) - self.velocity.take(other, axis=0)
        speed = np.sqrt(squares(approach))
        meets = self.random.random(one.size) * largest < speed
        one, other = one[meets], other[meets]
        normal = approach[meets] / speed[meets, np.newaxis]
        normal += unit(self.random.standard_normal(normal.shape))  # cosine-weighted about g
        after = carom.collide(
            PAIR,
            velocity1=self.velocity.take(one, axis=0),
            spin1=self.spin.take(one, axis=0),
            velocity2=self.velocity.take(other, axis=0),
            spin2=self.spin.take(other, axis=0),
            normal=unit(normal),
            law=law,
        )
        self.velocity[one], self.velocity[other] = after.velocity1, after.velocity2
        self.spin[one], self.spin[other] = after.spin1, after.spin2
        return one.size


def squares(vectors):
    """Squared lengths."""
    return np.einsum("ij,ij->i", vectors, vectors)


def unit(vectors):
    """Vectors of length one."""
    return vectors / np.sqrt(squares(vectors))[:, np.newaxis]


def cool(law, spheres, until, *, seed=1, name="gas"):
    """Follow a gas without spin until each sphere has had so many collisions."""
    gas = Gas(spheres, seed)
    states, total = [gas.state()], spheres * until / 2
    with Progress(transient=True, disable=not sys.stdout.isatty()) as bar:
        task = bar.add_task(name, total=total)
        while gas.hits < total:
            bar.update(task, advance=gas.advance(law))
            states.append(gas.state())
    return History(*np.array(states).T)


def rates(law, ratio, pair=PAIR, restitution=1.0):
    """Rates of ln T_tr and of T_rot/T_tr per collision of a sphere, of Maxwellian spheres.

    Between the normal and the tangential velocities of contact points their energy is shared
    evenly: x of it is tangential, V_t^2/V_n^2 = (1 + T_rot/(q T_tr)) x/(1 - x). J_t = m eta V_t.
    """
    x, scale = 0.5 + NODES, 1 + ratio / Q
    slope = np.sqrt(scale * x / (1 - x))
    along, across = slope[:, np.newaxis] * [1, 0, 0], np.array([0, 0, 1])
    after = carom.collide(pair, velocity1=along + across, normal=across, law=law)
    eta = 1 - after.velocity1[:, 0] / slope
    moving = 8 / 3 * WEIGHTS @ (x * eta * (scale * eta - 1)) - (1 - restitution**2) / 3
    turning = 8 / 3 * WEIGHTS @ (x * eta * (scale * eta - ratio)) / Q
    return moving, turning - ratio * moving


def maxwellian(law, until):
    """Collisions of a sphere, T_tr and T_rot/T_tr of Maxwellian spheres that start without spin."""
    many = np.linspace(0, until, 201)
    run = solve_ivp(lambda _, y: rates(law, y[1]), (0, until), (0, 0), t_eval=many, rtol=1e-8)
    return many, np.exp(run.y[0]), run.y[1]


def lasting(law, pair, restitution=1.0):
    """Return the ratio T_rot/T_tr that Maxwellian spheres reach in the end."""
    return brentq(lambda ratio: rates(law, ratio, pair, restitution)[1], 1e-9, 2)


def draw(gases, ends):
    """Temperatures in time; their ratio; where it ends for other frictions."""
    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=66)
    for name, gas in gases.items():
        for values in (gas.translational, gas.rotational):
            axes[0].loglog(gas.time[1:], values[1:], **LOOKS[name])
        axes[1].plot(*maxwellian(LAWS[name], UNTIL)[::2], color="0.6", lw=0.8)
        axes[1].plot(gas.collisions, gas.ratio, **LOOKS[name], label=name)
    axes[1].plot([], [], color="0.6", lw=0.8, label="Maxwellian")
    axes[0].plot([70, 400], [0.18, 0.18 * (70 / 400) ** 2], color="0.3", lw=0.8)
    axes[0].text(180, 0.04, "$t^{-2}$")
    axes[0].text(0.25, 1.15, "translational")
    axes[0].text(1.5, 0.05, "rotational")
    axes[0].text(0.25, 6e-4, rf"$\mu = {PAIR.friction:g}$")
    axes[0].set(title="temperatures", xlim=(0.2, 600), ylim=(4e-4, 2), ylabel="$T/T_0$")
    axes[0].set_xlabel("time (mean free times at the start)")
    axes[1].set(title="their ratio", xlim=(0, UNTIL), ylim=(0, 1.1))
    axes[1].set_xlabel("collisions of a sphere")
    axes[1].set_ylabel(r"$T_\mathrm{rot}/T_\mathrm{tr}$")
    axes[1].legend(loc="lower right")
    pairs = [carom.Pair(BALL, BALL, friction) for friction in np.geomspace(0.02, 4, 40)]
    for name, law in {
        "exact": lambda pair: None,
        WALTON: lambda pair: carom.laws.fit_walton(pair).law,
    }.items():
        curve = [lasting(law(pair), pair) for pair in pairs]
        axes[2].semilogx([pair.friction for pair in pairs], curve, **LOOKS[name])
        axes[2].plot(PAIR.friction, ends[name], "o", color=LOOKS[name]["color"], mfc="white")
    axes[2].plot([], [], "o", color="0.3", mfc="white", label="simulated")
    axes[2].plot([], [], color="0.3", label="Maxwellian")
    axes[2].legend(loc="upper left")
    axes[2].set(xlim=(0.02, 4), ylim=(0, 0.8), xlabel=r"$\mu$")
    axes[2].set(title="ratio in the end", ylabel=r"$T_\mathrm{rot}/T_\mathrm{tr}$")
    return figure


def settles(gas, spheres):
    """Check that T_rot/T_tr settles and T_tr falls as t^-2; return the ratio at the end."""
    assert np.all(np.diff(gas.translational + gas.rotational) < 0), "energy only falls"
    spans = (0.5 * UNTIL, 0.75 * UNTIL), (0.75 * UNTIL, UNTIL)
    early, late = (gas.ratio[gas.between(*span)].mean() for span in spans)
    assert abs(late / early - 1) < 0.02 + 8 / np.sqrt(spheres), "T_rot/T_tr settles"
    bend = gas.slope(*spans[1]) / gas.slope(*spans[0]) - 1
    assert abs(bend) < 0.02 + 8 / np.sqrt(spheres), f"t^-2: T_tr^(-1/2) bends by {bend:.2%}"
    return late


def cool_with_losses(spheres, restitution):
    """Cool viscoelastic spheres; return T_rot/T_tr at the end and that of Maxwellian ones."""
    law = carom.laws.ReboundLaw(PAIR.chi, losses=carom.KelvinVoigt(restitution=restitution))
    gas = cool(law, spheres, UNTIL + 0.1, name=f"e = {restitution:g}")
    assert gas.drift.max() < 1e-12, "momentum is kept"
    return gas, settles(gas, spheres), lasting(law, PAIR, restitution)


@styled
def main(folder: str | Path = ".", spheres: int = 20_000) -> str:
    """Cool three gases, check what they keep and how they end, and draw them."""
    gases = {name: cool(law, spheres, UNTIL + 0.1, name=name) for name, law in LAWS.items()}
    for name, gas in gases.items():
        assert gas.drift.max() < 1e-12, f"{name}: momentum is kept"
    rough = gases["perfectly rough"]
    np.testing.assert_allclose(rough.translational + rough.rotational, 1, rtol=1e-12)
    ends = {name: settles(gases[name], spheres) for name in ("exact", WALTON)}
    save_figure(draw(gases, ends), Path(folder) / "granular_gas.png")
    return f"T_rot/T_tr ends at {ends['exact']:.3f}, by Walton's law at {ends[WALTON]:.3f}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--spheres", type=float, default=20_000)
    parser.add_argument("--restitution", type=float, default=1.0, help="e of the spheres, below 1")
    given = parser.parse_known_args()[0]
    if given.restitution < 1.0:
        _, late, maxwell = cool_with_losses(int(given.spheres), given.restitution)
        print(f"T_rot/T_tr ends at {late:.3f}; Maxwellian spheres at {maxwell:.3f}")
    else:
        print(main(spheres=int(given.spheres)))
