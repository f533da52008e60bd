"""The lines of Python that give what the page shows."""

from carom.page.views import OF_MATERIAL, OWN, PAGE, SECOND, View

LINES: dict[str, str] = PAGE["script"]
LAW, DAMPED = "laws[label]", "dataclasses.replace(laws[label], restitution={e})"


def script(view: View, time: float) -> str:
    """Return the lines for a view, fields at a time that is a share of the duration."""
    losses = ", losses=losses" if view.losses else ""
    names = {"psi": "hit.psi_in", "out": "hit.psi_out", "chi": "pair.chi", "kappa": "pair.kappa"}
    e, plate = "hit.normal_restitution", "1.25**0.4 * pair.plate_give(hit.normal_speed)"
    if view.in_numbers:
        names = {"psi": "impact.psi_in", "out": "impact.psi_out", "chi": "impact.chi"}
        names["kappa"] = "None"
        e, plate = "impact.restitution", repr(view.inelasticity)
    e = e if view.on_plate else repr(view.restitution)
    of_losses = LINES["plate" if view.on_plate else "losses"].format(e=e, plate=plate)
    damps = bool(view.is_lossy and view.laid_over)
    parts = ["import dataclasses\n\n" if damps else "", LINES["imports"]]
    parts.append(of_losses if losses else "")
    if view.in_numbers:
        parts.append(LINES["numbers"].format(psi=view.psi, chi=view.chi, losses=losses))
    else:
        parts.append(_bodies(view, time, losses))
    if view.on_plate and not losses:
        parts.append(of_losses)
        losses = ", losses=losses"
    rubs = view.in_numbers or view.friction > 0.0
    parts.append(
        LINES["curve" if rubs else "curve_without_friction"].format(losses=losses, **names)
    )
    if view.laid_over:
        law = DAMPED.format(e=e) if damps else LAW
        printed = LINES["laws_printed"].format(**names) if rubs else ""
        parts.append(LINES["laws"].format(labels=view.laid_over, law=law, printed=printed, **names))
    parts.append(LINES["saved"])
    if view.data:
        parts.append(LINES["data"].format(name=view.data))
    return "".join(parts)


def _bodies(view: View, time: float, losses: str) -> str:
    kinds = {"half-space": "HalfSpace", "sphere": "Sphere", "cup": "Cup"}
    first = f'carom.Sphere(radius="{view.radius!r} mm", material={_stuff(view)})'
    sized = f'radius="{view.second_radius!r} mm", ' if view.against != "half-space" else ""
    thick = f', thickness="{view.thickness!r} mm"' if view.on_plate else ""
    second = f"carom.{kinds[view.against]}({sized}material={_stuff(view, SECOND)}{thick})"
    bodies = {"first": first, "second": second, "friction": view.friction}
    motion = {"speed": view.speed, "angle": view.angle, "spin": view.spin}
    return LINES["bodies"].format(**bodies, **motion, time=min(max(time, 0.0), 1.0), losses=losses)


def _stuff(view: View, which: str = "") -> str:
    """Return the material of the ball, or with "second_" that of the second body."""
    name = getattr(view, f"{which}material")
    if name != OWN:
        return repr(name)
    young, poisson, density = (getattr(view, which + part) for part in OF_MATERIAL)
    return f'carom.Material(young="{young!r} GPa", poisson={poisson!r}, density={density!r})'
