"""Parameters from measured rebounds: friction, stiffness ratio, restitution, with intervals."""

from collections.abc import Collection, Mapping, Sequence
from math import inf
from pathlib import Path
from typing import Any

from carom.bodies.pairs import Pair
from carom.io.progress import advancing
from carom.lab.fitting.groups import by_groups, with_readings
from carom.lab.fitting.intervals import Estimate, Settled, refuse_contradicted, settle
from carom.lab.fitting.joint_result import JointFit, jointly_assembled, named_sets
from carom.lab.fitting.model import EXACT, OFFSET, STRAIGHT, Model, suited
from carom.lab.fitting.options import check_count, checked_confidence, read_options, read_shared
from carom.lab.fitting.problem import RobustLoss
from carom.lab.fitting.reading import read_problem, read_rebounds
from carom.lab.fitting.result import Fit, assembled
from carom.quantities.refusals import Faults, flag, known_keywords, refuse
from carom.quantities.units import Value

__all__ = ["Estimate", "Fit", "JointFit", "fit", "joint_fit"]


@known_keywords
def fit(
    data: Any,
    *,
    pair: Pair | None = None,
    vary: Collection[str] | str | None = None,
    fixed: Mapping[str, Any] | None = None,
    robust: bool = True,
    confidence: Value = 0.95,
    columns: Mapping[str, str] | str | Path | None = None,
    sheet: str | None = None,
    decimal: str | None = None,
) -> Fit:
    """Return friction, stiffness and restitution from measured rebounds, or a plate's thickness.

    The model is V_n' = e V_n and V_x' = mu V_n psi_2(psi_1; chi, e)/kappa, with psi_1 = kappa
    V_x/(mu V_n), chi = (kappa/2)(m_n/m_t), J_t = m_t (V_x - V_x'), and the psi_2 of Maw, Barber &
    Fawcett (1976). For e < 1 the solid is that of `KelvinVoigt`. The fit minimises the sum of a
    loss of the residuals, which count in standard deviations. An interval ends where this sum,
    minimised over all other parameters, has risen by a quantile of chi squared (profile
    likelihood), or of F where errors come from the scatter. On a plate that gives way, a
    `HalfSpace` with a thickness, e and psi_2 follow from the thickness and the speed of each impact
    (Zener 1941), and the thickness can be fitted instead of e.

    Parameters
    ----------
    data : str, mapping or data frame
        A file, CSV or a spreadsheet, or columns by name, in SI units or with a unit in the head:
        "angle [deg]". The motion before is angle and speed; or normal_speed and tangential_speed;
        or angle, contact_angle or psi_in alone if no speed is needed; spin and spin2 may be added.
        Of the motion after give any of normal_restitution, normal_speed_out,
        tangential_restitution, tangential_speed_out, rebound_speed, rebound_angle, spin_out,
        contact_restitution, contact_beta, contact_rebound_angle, impulse_ratio, psi_out; on a plate
        also duration, the contact time. surface_angle and surface_angle_out, from the surface, may
        replace angle and rebound_angle, and spin_out_magnitude, of which friction gives the sign,
        spin_out. For vertical drops give drop_height or normal_speed, and rebound_height,
        normal_speed_out or normal_restitution; later bounces as rebound_height_2,
        normal_speed_out_2; or times between bounces alone, bounce_interval or bounce_time. Heights
        in a file need their unit. A column thickness holds those of many plates. Standard
        deviations are in columns `<name>_error`, also for the motion before; where none are given
        they come from the scatter. Rows with the same `group`, a text or number, repeat one
        setting: their means are fitted, and an error of the motion before is common to them. A
        blank cell, "-", NaN, NA or n/a means not measured.
    pair : Pair, optional
        The bodies, by default those in the comment "# case:" of the file.
    vary : names, optional
        Parameters to fit, of friction, kappa (or chi), restitution and spin_offset; by default the
        first three, or restitution alone if all impacts are normal ones. The others are held: at
        what `fixed` says, else friction and kappa at those of the pair, restitution at 1, the
        offset at 0. A restitution that was measured, or is not 1 by what was, or a friction that
        the bodies do not have, must be varied or fixed. kappa is kept from 2/3 to 1, as that of
        elastic bodies, unless the data clearly contradict that. On a plate there is
        thickness instead of restitution: by default held at that of the pair, or fitted if all
        impacts are normal ones.
    fixed : mapping, optional
        Values of parameters that are known, e.g. {"restitution": 0.98}.
    robust : bool
        Whether outliers count less, by the loss (nu + 1) log(1 + r^2/nu) of Student's t instead of
        r^2; nu is 3, 5, 10 or 30, whichever is likeliest.
    confidence : float or str
        Confidence level of the intervals, e.g. 0.95 or "95 %".
    columns : mapping or str, optional
        Quantities by the heads of columns that have other names, e.g. {"omega": "spin_out"} or
        {"w": "spin_out [rpm]"}; or a TOML file with them in a table [columns].
    sheet : str, optional
        The sheet of a spreadsheet, if several could be meant.
    decimal : str, optional
        "," or ".", the decimal sign of a file where numbers such as 1,234 leave it open.

    Returns
    -------
    Fit
        `estimates` has friction, kappa, chi and restitution as pure numbers, thickness in m and
        spin_offset in rad/s, each an `Estimate` with value, low and high, or with a reason if the
        data do not determine it. `regimes` counts the rows in each regime, `notes` has remarks,
        `comparison` compares with other laws, and `losses` has laws of restitution against speed.
        Methods for the rest are advice, posterior, plot and to_dataset.

    Raises
    ------
    InputError
        If columns are missing, misnamed or contradict each other (all faults of the data in one
        message), there are too few values, or a parameter is unknown or out of range.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> angles = [f"{angle} deg" for angle in range(5, 80, 5)]
    >>> hits = [carom.impact(pair, speed=2.0, angle=angle) for angle in angles]
    >>> measured = {"angle": angles, "contact_beta": [-hit.contact_restitution for hit in hits]}
    >>> found = carom.fit(measured, pair=pair, fixed={"restitution": 1.0})
    >>> round(found.friction.value, 3), round(found.chi.value, 2)
    (0.2, 1.44)

    A plate of which the thickness is sought, from about 5 mm on:

    >>> plate = carom.Pair(ball, carom.HalfSpace("steel", thickness="5 mm"), friction=0.2)
    >>> drops = {"normal_speed": [0.2, 0.5, 1.0], "normal_restitution": [0.59, 0.535, 0.49]}
    >>> print(carom.fit(drops, pair=plate).thickness)
    3 mm (2.971 to 3.03)
    """
    how = {"columns": columns, "sheet": sheet, "decimal": decimal}
    with Faults() as faults:
        level = faults.trying(checked_confidence, confidence)
        limited = faults.trying(flag, "robust", robust)
        found = faults.trying(_settled, data, pair, vary, fixed, limited, how)
    return assembled(found, level)


@known_keywords
def joint_fit(
    data: Mapping[str, Any] | Sequence[Any],
    *,
    share: Collection[str] | str = (),
    pair: Pair | Sequence[Pair | None] | None = None,
    vary: Collection[str] | str | None = None,
    fixed: Mapping[str, Any] | None = None,
    robust: bool = True,
    confidence: Value = 0.95,
    columns: Mapping[str, str] | str | Path | None = None,
    sheet: str | None = None,
    decimal: str | None = None,
) -> JointFit:
    """Return fits of several sets of rebounds, which may share parameters, and their differences.

    The losses of all sets, each as in `fit`, are added and made least together. What the sets do
    not share, each has for itself, as the scatter of its quantities.

    Parameters
    ----------
    data : sequence or mapping
        Files or other tables, as for `fit`; of a mapping the keys name the sets.
    share : names, optional
        Parameters that are the same in all sets, of those that are varied; by default none.
    pair : Pair or sequence, optional
        The bodies, of all sets or of one after the other.
    vary, fixed, robust, confidence, columns, sheet, decimal : as for `fit`
        The same for all sets.

    Returns
    -------
    JointFit
        `fits` has a `Fit` for each set; `difference` compares two of them; `agreement` judges what
        is shared.

    Raises
    ------
    InputError
        As for `fit`, for all sets at once; or if a shared parameter is not varied in one of them.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> slow = {"angle [deg]": [20, 45, 60, 70], "impulse_ratio": [0.19, 0.21, 0.2, 0.2]}
    >>> fast = {"angle [deg]": [25, 50, 60, 75], "impulse_ratio": [0.2, 0.21, 0.19, 0.2]}
    >>> both = carom.joint_fit([slow, fast], pair=pair, share="friction", fixed={"restitution": 1})
    >>> print(both.verdict)
    the sets agree in friction (p = 0.98)
    """
    level, limited = checked_confidence(confidence), flag("robust", robust)
    sets = named_sets(data)
    pairs = list(pair) if isinstance(pair, Sequence) else [pair] * len(sets)
    refuse(len(pairs) != len(sets) and f"pair: {len(pairs)} of {len(sets)}; give one for each set")
    how = {"columns": columns, "sheet": sheet, "decimal": decimal}
    alone: dict[str, Settled] = {}
    with Faults() as faults:
        for (name, each), own in zip(sets.items(), pairs, strict=True):
            with faults.catching(name):
                alone[name] = _settled(each, own, vary, fixed, limited, how)
    common = read_shared(share, [each.whole.model.free for each in alone.values()])
    return jointly_assembled(alone, common, level)


def _settled(
    data: Any,
    pair: Pair | None,
    vary: Collection[str] | str | None,
    fixed: Mapping[str, Any] | None,
    limited: bool,
    how: Mapping[str, Any],
) -> Settled:
    """Return the best fit of one set of data."""
    loss = RobustLoss() if limited else RobustLoss(inf)
    problem = by_groups(read_problem(read_rebounds(data, **how), pair), loss)
    options = read_options(problem, vary, fixed)
    check_count(problem, options.free)
    turns = OFFSET in options.free or options.start[OFFSET]
    law = STRAIGHT if problem.is_normal and not turns else EXACT
    model = Model(suited(law, problem), problem, (), options.start).freeing(options.free)
    with advancing("fitting", None):
        settled = settle(with_readings(model, loss), loss, options.start, options.taken)
    if options.taken:
        refuse_contradicted(settled.whole)
    return settled
