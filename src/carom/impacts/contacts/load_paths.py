"""Quasi-static load paths of a contact, with any history of normal and tangential load."""

from __future__ import annotations

from dataclasses import dataclass, field
from numbers import Integral
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.bodies.checks import with_friction
from carom.bodies.pairs import ContactScales, Pair
from carom.dimensionless.load_paths import paths
from carom.dimensionless.load_paths.memory import SLOPE, profile_of
from carom.impacts.contacts.fields import Contact
from carom.impacts.contacts.in_contact import InContact
from carom.impacts.contacts.load_steps import Control, Steps, followed, read_steps
from carom.io.citations import LOADS, TURNING, bibtex
from carom.io.labels import labelled_dataset
from carom.io.progress import Progress, advancing
from carom.plots.result import Result, card
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY, aligned
from carom.quantities.refusals import known_keywords, refusal
from carom.quantities.units import is_real

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


PATH_COLUMNS = (
    *("penetration", "displacement", "normal_force", "tangential_force"),
    *("contact_radius", "stick_radius", "frictional_work", "tangential_elastic_energy"),
)


@dataclass(frozen=True, eq=False)
class LoadPath(InContact, Result):
    """The contact of a pair after each step of a load path, in SI units; made by `load_path`.

    A step is a straight line in penetration and displacement, and arrays have the shape (n,). The
    energy lost so far, `frictional_work`, and the stored `tangential_elastic_energy` add up to the
    work of F_x. The displacement U is that since the start, and F_x is positive if it opposes a
    growing U; in two directions both have the shape (n, 2). `scales` make lengths and forces
    dimensionless. The theory is that of Mindlin & Deresiewicz (1953), J. Appl. Mech. 20:327.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> path = carom.load_path(pair, penetration=[1e-6, 2e-6], displacement=[0.0, 1e-7])
    >>> path.tangential_force.round(4)
    array([0.    , 1.6381])
    """

    pair: Pair
    penetration: Array
    displacement: Array
    normal_force: Array
    tangential_force: Array
    contact_radius: Array
    stick_radius: Array
    frictional_work: Array
    tangential_elastic_energy: Array
    scales: ContactScales = field(repr=False)
    _steps: Steps = field(repr=False)

    def __len__(self) -> int:
        return self.penetration.size

    def then(
        self,
        *,
        normal_force: Control = None,
        penetration: Control = None,
        tangential_force: Control = None,
        displacement: Control = None,
        progress: Progress = None,
    ) -> LoadPath:
        """Return the path with further steps, with the same or another control.

        The whole path is computed again, so it is faster to give many steps at once.

        Parameters
        ----------
        normal_force, penetration, tangential_force, displacement, progress : optional
            As in `load_path`, from the end of this path. If one part has two directions, values
            of one direction are taken along x.

        Returns
        -------
        LoadPath
            The previous steps and the new ones.

        Raises
        ------
        InputError
            As in `load_path`.

        Examples
        --------
        >>> pushed = carom.load_path(pair, normal_force="10 N", tangential_force=[0.0, 1.0])
        >>> moved = pushed.then(normal_force="10 N", displacement=0.0)
        >>> len(moved), bool(moved.tangential_force[-1] < 0.0)
        (3, True)
        """
        more = read_steps(self.pair, normal_force, penetration, tangential_force, displacement)
        return _load_path(self.pair, self._steps.followed_by(more), progress)

    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX."""
        return bibtex(*LOADS, *([TURNING] if self.displacement.ndim == 2 else []))

    def _contact(self, at: Any) -> Contact:
        step = -1 if at is None else at
        k = self._step(step)
        if self.displacement.ndim == 2:
            allowed = "fields and stresses are available only for paths in one direction"
            raise refusal("at", step, allowed)
        d, u = self.penetration[: k + 1], self.displacement[: k + 1]
        if not d[k] > 0.0:
            raise refusal("at", step, "the bodies do not touch after this step")
        scales = self.scales
        path = paths.follow_path(*self._steps.first(k + 1).dimensionless(scales))
        d, u = d / scales.length, u / scales.tangential_length
        return Contact(
            self.pair,
            scales,
            penetration=float(d[k]),
            displacement=float(u[k]),
            stick_radius=float(path.results[k, paths.STICK]),
            profile=profile_of(path.stack),
            _slid=lambda radii: paths.slid(d, u, radii) * scales.tangential_length,
            _scalars={name: float(getattr(self, name)[k]) for name in PATH_COLUMNS[2:4]},
            attributes=_state(path.stack) | {"inputs": self.inputs()},
        )

    def _rows(self) -> dict[str, str]:
        columns = {GLOSSARY[name]: getattr(self, name) for name in PATH_COLUMNS}
        return {it.meaning: it.span(float(v.min()), float(v.max())) for it, v in columns.items()}

    def __str__(self) -> str:
        return "\n".join([f"Load path of {len(self)} steps", *aligned(self._rows())])

    def _repr_html_(self) -> str:
        figure = self.plot() if len(self) > 1 else None
        return card(f"Load path of {len(self)} steps", self._rows(), figure)

    def _draw(self, dataset: xr.Dataset, **look: Any) -> Figure:
        from carom.plots.cone import plot_cone

        return plot_cone(dataset, **look)

    def to_dataset(self) -> xr.Dataset:
        """Return the path as a dataset along `step`, and `direction` if there are two.

        It has penetration, displacement, contact_radius and stick_radius in m, normal_force and
        tangential_force in N, frictional_work and tangential_elastic_energy in J, and friction.
        """
        count = {"units": "1", "long_name": "step of the load path"}
        columns = {name: getattr(self, name) for name in PATH_COLUMNS}
        dims = ("step", "direction")
        coords: dict[str, Any] = {"step": ("step", np.arange(len(self)), count)}
        if self.displacement.ndim == 2:
            coords["direction"] = ("direction", ["x", "y"], {"long_name": "direction"})
        return labelled_dataset(
            {name: (dims[: values.ndim], values) for name, values in columns.items()}
            | {"friction": self.pair.friction},
            coords,
            {"title": "load path", "inputs": self.inputs()},
        )

    def inputs(self) -> dict[str, Any]:
        """Return the inputs of the path except its steps, as plain numbers and words."""
        return self.pair._describe()

    def _step(self, step: Any) -> int:
        n = len(self)
        whole = isinstance(step, Integral) and is_real(step)
        try:
            return range(n)[int(step) if whole else n]
        except IndexError:
            allowed = f"must be a whole number from 0 to {n - 1}, or negative to count from the end"
            raise refusal("at", step, allowed) from None


def _state(stack: Array) -> dict[str, Any]:
    """Return what the contact does after a step: kind of phase, and the sign of slip."""
    g = float(stack[-1, SLOPE])
    if abs(g) < 1.0:
        return {"phase_kind": "stick", "phase_sign": 0}
    return {"phase_kind": "gross slip" if len(stack) == 2 else "slip", "phase_sign": int(g)}


@known_keywords
def load_path(
    pair: Pair,
    *,
    normal_force: Control = None,
    penetration: Control = None,
    tangential_force: Control = None,
    displacement: Control = None,
    progress: Progress = None,
) -> LoadPath:
    """Compute a quasi-static load path of a contact exactly, with slip and memory.

        q(s) = U + c(s), |q| <= d - s

    The deflection q of each spring keeps its c(s) while the spring sticks. Coulomb's law limits |q|
    and changes c where the spring slips, and F_x is the integral of q (Mindlin & Deresiewicz 1953,
    J. Appl. Mech. 20:327, for any history). A path that turns in two directions is computed with 64
    springs and Coulomb's law at every radius, |f| <= mu p (Moreau 1977, J. Differ. Equations
    26:347). Its forces are within 0.002 of the largest mu F_z, its stick radii within 0.01 of the
    largest radius, and its work within 0.5 %.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction, which must not be zero.
    normal_force, penetration : array_like, shape (n,), or float or str
        Either the normal force in N, not negative, or the penetration in m, negative where the
        bodies are apart. The first entry is reached by a straight step from the first touch.
    tangential_force, displacement : array_like, shape (n,) or (n, 2), or float or str
        Either the tangential force in N, or the tangential displacement since the start in m, along
        x or in two columns along x and y. One value, or one row, holds for all steps.
    progress : bool or callable, optional
        Whether to show a progress bar of a path in two directions, or a function that is called
        with the number of finished steps and of all steps.

    Returns
    -------
    LoadPath
        The contact after each step. Quantities have the shape (n,), tangential forces and
        displacements in two directions (n, 2).

    Raises
    ------
    InputError
        If a control is missing, given twice, empty, not finite or of a wrong length, or if a step
        needs a larger tangential force than Coulomb's law allows.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> loop = carom.load_path(pair, normal_force="10 N", tangential_force=[0.0, 1.5, -1.5, 1.5])
    >>> (loop.stick_radius / loop.contact_radius).round(4)
    array([1.  , 0.63, 0.63, 0.63])
    """
    with_friction(pair, "a load path needs friction, or there is no tangential force")
    steps = read_steps(pair, normal_force, penetration, tangential_force, displacement)
    return _load_path(pair, steps, progress)


def _load_path(pair: Pair, steps: Steps, progress: Progress) -> LoadPath:
    with advancing("computing the load path", len(steps.target), progress, unit="steps") as advance:
        scales, columns = followed(pair, steps, advance)
    return LoadPath(pair, penetration=steps.penetration, **columns, scales=scales, _steps=steps)
