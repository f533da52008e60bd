"""The base of contact laws: the forces in a contact, and the rebound that follows from them."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.laws.base import FEWEST_STEPS, SOLID, Law
from carom.laws.dem.adaptive import WORK, rebounds
from carom.laws.dem.coefficients import Coefficients
from carom.laws.dem.damping import damped_restitution
from carom.laws.dem.stepping import HISTORY, PATIENCE, REMEMBERED, stepped, stepped_rebounds
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal
from carom.quantities.units import counted, finite, not_negative, positive

READERS = {  # of the parameters that laws have
    "stiffness_ratio": lambda name, value: None if value is None else positive(name, value),
    "stiffness": positive,
    "restitution": damped_restitution,
    "tangential_damping": not_negative,
}


@dataclass(frozen=True)
class ContactLaw(Law):
    """A law of the forces in a contact, from the first touch to separation."""

    largest_chi: ClassVar[float] = 1e6  # which an adaptive impact takes a tenth of a second for
    symmetric: ClassVar[bool] = True  # in the sign of psi: it is solved for |psi|

    def __post_init__(self) -> None:
        for name, read in READERS.items():
            if name in vars(self):
                object.__setattr__(self, name, read(name, getattr(self, name)))

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        raise NotImplementedError(f"{self.name} is more than coefficients")

    def _rebound(self, psi: Array, chi: float, kappa: float, steps: int | None) -> Array:
        law = self.coefficients(chi, kappa)
        out = np.empty(psi.size)
        if steps is None:
            rebounds(law, psi, np.empty(WORK), out)
        else:
            nothing = np.empty((0, len(HISTORY)))
            stepped_rebounds(law, psi, steps, np.empty(REMEMBERED), nothing, out)
        return out

    def _recorded(self, psi: float, chi: float, kappa: float, steps: int, record: Array) -> int:
        """Write what happens in equal steps; return their number, -1 if the bodies do not part."""
        law = self.coefficients(chi, kappa)
        return stepped(law, psi, steps, np.empty(REMEMBERED), record)[0]

    def history(
        self, psi: float, chi: float, *, kappa: float | None = None, steps: int = 1000
    ) -> dict[str, Array]:
        """Return the history of an impact in equal time steps, in the units of Hertz's impact.

        Parameters
        ----------
        psi : float
            Dimensionless tangential velocity before the impact, psi_1 = kappa V_x/(mu V_1).
        chi : float
            Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.
        kappa : float, optional
            Stiffness ratio G*/E*, by default that of solid spheres, 4 chi/7.
        steps : int
            Number of equal time steps in the duration of Hertz's contact, from 4 to a million.

        Returns
        -------
        dict
            Arrays named `time`, `penetration`, `normal_velocity`, `psi`, `normal_force` and
            `tangential_force`.

        Raises
        ------
        InputError
            If a value is out of range, or the bodies do not part.

        Examples
        --------
        >>> import carom
        >>> history = carom.LinearSpring().history(0.5, 1.44)
        >>> round(float(history["normal_force"].max()), 3)
        0.8
        """
        counted("steps", steps, FEWEST_STEPS)
        chi, psi = positive("chi", chi), finite("psi", psi, "1")
        own = SOLID * chi if kappa is None else positive("kappa", kappa)
        record = np.empty((PATIENCE * steps + 2, len(HISTORY)))
        sign = float(np.copysign(1.0, psi)) if self.symmetric else 1.0
        count = self._recorded(sign * psi, chi, own, steps, record)
        if count < 0 or not np.all(np.isfinite(record[:count])):
            raise refusal("steps", steps, "the bodies do not part; take more steps")
        columns = {name: record[:count, i].copy() for i, name in enumerate(HISTORY)}
        for name in ("psi", "tangential_force"):
            columns[name] *= sign
        return columns
