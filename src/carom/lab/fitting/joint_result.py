"""Several sets of data: fits side by side, what they share, and by how much they differ."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.io.labels import labelled_dataset
from carom.lab.fitting.estimation import Best
from carom.lab.fitting.intervals import Estimate, Settled
from carom.lab.fitting.joint import settle_jointly
from carom.lab.fitting.options import NAMES
from carom.lab.fitting.report_file import Reported
from carom.lab.fitting.result import Fit, assembled
from carom.plots.result import Section, card
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, nearest, refuse

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

SAID = {True: ", so that they differ", False: ", no difference shown", None: ""}
UNLIKELY = 0.01  # probability below which sets contradict what they are to share


@dataclass(frozen=True)
class Difference(Estimate):
    """The value of a parameter in one set less that in another, with its interval."""

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the largest value that is possible at all."""
        return -inf, inf

    @property
    def differs(self) -> bool | None:
        """Whether the interval excludes zero; None without one."""
        return not self.low <= 0.0 <= self.high if self.determined else None


@dataclass(frozen=True, eq=False)
class JointFit(Reported):
    """Fits of several sets of data, which may share parameters; made by `carom.joint_fit`.

    `fits` has the `Fit` of each set by its name; `joint["steel.csv"]` is one of them. `shared` are
    the names of what they share, and `agreement` the probability that sets which do share it differ
    more than these do, from an F-test; None if nothing is shared.

    Examples
    --------
    >>> data = carom.datasets.load("kharaz2001")
    >>> joint = carom.joint_fit({"first": data, "again": data}, share="friction")
    >>> joint["first"].friction.value == joint["again"].friction.value
    True
    """

    fits: Mapping[str, Fit]
    shared: tuple[str, ...]
    agreement: float | None
    _alone: Mapping[str, Mapping[str, float]] = field(repr=False)
    _best: Best | None = field(repr=False)

    def __getitem__(self, name: str) -> Fit:
        return self.fits[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.fits)

    def difference(self, parameter: str, one: str, other: str) -> Difference:
        """Return the value of a parameter in one set less that in another, with its interval.

        L = D - sqrt((v_1 - l_1)^2 + (u_2 - v_2)^2 - 2 r (v_1 - l_1)(u_2 - v_2)), and U likewise,
        from values v and intervals l to u of both (Zou & Donner 2008; with correlation Zou 2007);
        r is not 0 only if the sets share something.

        Parameters
        ----------
        parameter : str
            friction, kappa, chi, restitution, thickness or spin_offset.
        one, other : str
            Names of the sets.

        Returns
        -------
        Difference
            With value, low and high; `differs` tells whether the interval excludes 0.

        Raises
        ------
        InputError
            If there is no such parameter or set, or the sets share it.

        Examples
        --------
        >>> steel = {"drop_height": [0.1, 0.1, 0.1], "rebound_height": [0.080, 0.082, 0.081]}
        >>> brass = {"drop_height": [0.1, 0.1, 0.1], "rebound_height": [0.060, 0.061, 0.062]}
        >>> balls = carom.joint_fit({"steel": steel, "brass": brass}, pair=pair)
        >>> print(balls.difference("restitution", "steel", "brass"))
        0.119 (0.0966 to 0.141)
        """
        unknown = f"is not one of them; there are {', '.join(self.fits)}"
        refuse(*(f"set: {name!r} {unknown}" for name in (one, other) if name not in self.fits))
        first, second = (self.fits[name].estimates.get(parameter) for name in (one, other))
        if first is None or second is None:
            hint = nearest(parameter, NAMES) or f"the sets have {', '.join(self._parameters)}"
            raise InputError(f"parameter: both sets must have {parameter!r}; {hint}")
        if parameter in self._common:
            raise InputError(f"parameter: {parameter} is shared, so that it does not differ")
        value = first.value - second.value
        for name, each in ((one, first), (other, second)):
            if not each.determined:
                why = each.reason or "it was not varied"
                return Difference(parameter, value, reason=f"{name}: {why}")
        if parameter == "chi" and "kappa" in self.shared:  # of unlike bodies, in proportion to it
            low, high = sorted((first.low - second.low, first.high - second.high))
            return Difference(parameter, value, low, high)
        r = self._correlation(parameter, one, other)
        below = _joined(first.value - first.low, second.high - second.value, r)
        above = _joined(first.high - first.value, second.value - second.low, r)
        return Difference(parameter, value, value - below, value + above)

    def _correlation(self, parameter: str, one: str, other: str) -> float:
        """Return the correlation of the values of a parameter in two sets."""
        plain = "kappa" if parameter == "chi" else parameter
        names = [f"{plain}_{[*self.fits].index(name) + 1}" for name in (one, other)]
        if self._best is None or not {*names} <= {*self._best.model.free}:
            return 0.0
        i, j = map(self._best.model.free.index, names)
        return float(self._best.information.correlations[i, j])

    @property
    def differences(self) -> dict[str, dict[str, Difference]]:
        """Values in each later set less those in the first, by parameter and set."""
        first, *later = self.fits
        return {
            parameter: {name: self.difference(parameter, name, first) for name in later}
            for parameter in self._parameters
            if parameter not in self._common
        }

    @property
    def _parameters(self) -> list[str]:
        """Names of the parameters that all sets have, and one of them determines."""
        every = [fit.estimates for fit in self.fits.values()]
        common = [name for name in NAMES if all(name in each for each in every)]
        return [name for name in common if any(each[name].determined for each in every)]

    @property
    def _common(self) -> tuple[str, ...]:
        """Names of the parameters that are the same in all sets, chi with kappa if it is."""
        chis = {fit.chi.value for fit in self.fits.values()}
        return (*self.shared, *(("chi",) if "kappa" in self.shared and len(chis) == 1 else ()))

    @property
    def verdict(self) -> str:
        """Whether the sets allow what they are to share, in a sentence; empty without any."""
        if self.agreement is None:
            return ""
        names = " and ".join(self.shared)
        if self.agreement >= UNLIKELY:
            return f"the sets agree in {names} (p = {self.agreement:.2g})"
        alone = "; ".join(
            f"{name} {', '.join(GLOSSARY[each].text(values[each], 3) for each in self.shared)}"
            for name, values in self._alone.items()
        )
        apart = f"the sets contradict a common {names} (p = {self.agreement:.1g})"
        return f"{apart}, so that the intervals do not hold; alone they give: {alone}"

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers, texts and lists, for JSON; what is open is None.

        Returns
        -------
        dict
            sets (each as `Fit.to_dict` gives it), shared, agreement, verdict, and differences by
            parameter and set, less the value of the first set; SI units.
        """
        return {
            "sets": {name: fit.to_dict() for name, fit in self.fits.items()},
            "shared": list(self.shared),
            "agreement": self.agreement,
            "verdict": self.verdict,
            "differences": {
                parameter: {name: each.to_dict() for name, each in by_set.items()}
                for parameter, by_set in self.differences.items()
            },
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return value, low and high along (set, parameter) in SI units, NaN if there is none."""
        names, words = self._parameters, {"value": "value", "low": "lower end", "high": "upper end"}
        variables: dict[str, Any] = {}
        for key, what in words.items():
            numbers = [[getattr(f[name], key) for name in names] for f in self.fits.values()]
            variables[key] = ("set", "parameter"), numbers, {"long_name": f"{what}, SI"}
        coords = {
            "set": ("set", list(self.fits), {"long_name": "set of data"}),
            "parameter": ("parameter", names, {"long_name": "parameter"}),
        }
        attrs = {"title": "parameters from several sets of rebounds", "verdict": self.verdict}
        attrs["shared"] = " ".join(self._common)
        return labelled_dataset(variables, coords, attrs)

    def cite(self) -> str:
        """Return what to cite for this result, and for data that have a DOI, as BibTeX."""
        every = "\n".join(fit.cite() for fit in self.fits.values())
        return "".join(dict.fromkeys(re.split(r"(?m)^(?=@)", f"{every}\n")))

    def _draw(self, dataset: Any, **look: Any) -> "Figure":
        from carom.plots.fits import plot_sets  # which loads matplotlib

        return plot_sets(dataset, **look)

    def _sections(self) -> Iterator[Section]:
        """Yield the comparison, then what the report of each set says."""
        sides = [("parameter", "set", "value", "interval"), *self._rows()]
        said = [self.verdict] if self.verdict else []
        yield Section("Parameters of the sets", said, sides)
        yield Section("Sets beside each other", (), draw=self.plot)
        for name, fit in self.fits.items():
            for section in fit._sections():
                yield section._replace(heading=f"{name}: {section.heading}")

    def _rows(self) -> Iterator[tuple[str, ...]]:
        """Yield each parameter, of which set or in all, value and interval; and its differences."""
        first, *_ = self.fits
        for parameter in self._parameters:
            shared = parameter in self._common
            own = {"all": self.fits[first]} if shared else self.fits
            for name, fit in own.items():
                yield parameter, name, *fit[parameter].cells
            for name, each in self.differences.get(parameter, {}).items():
                value, interval = each.cells
                yield parameter, f"{name} less {first}", value, f"{interval}{SAID[each.differs]}"

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        rows = {f"{name}, {what}": f"{value}, {reach}" for name, what, value, reach in self._rows()}
        return card("Parameters from several sets", rows, self.plot(), self.verdict)

    def __str__(self) -> str:
        confidence = next(iter(self.fits.values())).confidence
        wide = max(map(len, self.fits))
        level = f"{100.0 * confidence:g} % intervals by profile likelihood"
        lines = [f"{len(self.fits)} sets; in brackets {level}"]
        first, differences = next(iter(self.fits)), self.differences
        for parameter in self._parameters:
            if parameter not in differences:
                lines.append(f"{parameter}, shared: {self.fits[first][parameter]}")
                continue
            lines.append(parameter)
            lines += [f"  {name:{wide}s}  {fit[parameter]}" for name, fit in self.fits.items()]
            for name, each in differences[parameter].items():
                lines.append(f"  {name} less {first}: {each}{SAID[each.differs]}")
        lines += [self.verdict] if self.verdict else []
        lines += [f"note, {name}: {note}" for name, fit in self.fits.items() for note in fit.notes]
        return "\n".join(lines)


def _joined(one: float, other: float, correlation: float) -> float:
    """Return the width of an interval of a difference on one side, from those of both values."""
    if not (isfinite(one) and isfinite(other)):
        return inf
    return sqrt(max(one**2 + other**2 - 2.0 * correlation * one * other, 0.0))


def named_sets(data: Mapping[str, Any] | Sequence[Any]) -> dict[str, Any]:
    """Return sets of data by names, those of files where they have some; InputError below two."""
    if isinstance(data, Mapping):
        sets = {str(name): each for name, each in data.items()}
    else:
        several = isinstance(data, Sequence) and not isinstance(data, str | bytes)
        refuse(not several and "data: give several sets, e.g. ['steel.csv', 'brass.csv']")
        files = {i: Path(each) for i, each in enumerate(data, 1) if isinstance(each, str | Path)}
        whole = len({path.name for path in files.values()}) < len(files)
        names = {i: str(path if whole else path.name) for i, path in files.items()}
        sets = {names.get(i, f"set {i}"): each for i, each in enumerate(data, 1)}
        refuse(len(sets) < len(data) and "data: one file is given twice; leave it out")
    refuse(len(sets) < 2 and "data: one set alone; give several, or use carom.fit")
    return sets


def jointly_assembled(
    alone: Mapping[str, Settled], shared: tuple[str, ...], confidence: float
) -> JointFit:
    """Return the result of sets that were fitted alone, once more together if they share some."""
    values = {name: each.whole.values for name, each in alone.items()}
    if not shared:
        fits = {name: assembled(each, confidence) for name, each in alone.items()}
        return JointFit(fits, (), None, values, None)
    best, parts, agreement = settle_jointly([*alone.values()], shared, confidence)
    together = zip(alone, parts, strict=True)
    fits = {name: assembled(part, confidence, profile) for name, (part, profile) in together}
    return JointFit(fits, shared, agreement, values, best)
