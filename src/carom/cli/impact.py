"""`carom impact`: one impact from flags or a case file."""

import json
import os
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import typer

import carom
from carom.cli import completion
from carom.cli.cases import check_outputs, merged, outputs, stored, tell_sweep
from carom.cli.options import checking, described, file_argument, name_option, whole_option
from carom.io.progress import advancing
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError, one_of, refusal
from carom.quantities.units import finite, whole

if TYPE_CHECKING:
    from carom.impacts.result import ImpactResult


def _flag(name: str, example: str, of: str = "") -> Any:
    unit = GLOSSARY[name].unit
    meaning = GLOSSARY[name].meaning.capitalize() + of
    return typer.Option(help=f"{meaning}, e.g. {example}{'' if unit == '1' else f' [{unit}]'}.")


METHODS = ("exact", "halfspace")
NO_PEAKS = "peaks: boundary elements give no stress below the surface; leave --method out"
ANIMATION_FRAMES = 60  # of an animation
CASE_KEYS = {  # of what options give, in a case file, where they have other names there
    "radius": "first.radius",
    "material": "first.material",
    "gyration_radius": "first.gyration_radius",
    "inner_radius": "first.inner_radius",
    "against": "second.kind",
    "second_radius": "second.radius",
    "second_material": "second.material",
    "thickness": "second.thickness",
    "width": "second.width",
    "plot": "output.plot",
    "animate": "output.animation",
    "output": "output.data",
    "spectrum": "output.spectrum",
}


OPTIONS = {
    "case": file_argument(
        "TOML file that describes the impact; options replace what it says. Give several for one "
        "impact each."
    ),
    "radius": _flag("radius", "'5 mm'", " of the first body, a sphere"),
    "material": name_option(
        "Material of the first body: a name that carom materials lists, or 'young=210 GPa, "
        "poisson=0.3, density=7850'.",
        completion.materials,
    ),
    "gyration_radius": _flag(
        "gyration_radius", "'3 mm'", " of the first body (default: that of a solid sphere)"
    ),
    "inner_radius": _flag("inner_radius", "'4 mm'"),
    "against": name_option(
        "Second body: half-space, sphere or cup (default: half-space).",
        ("half-space", "sphere", "cup"),
    ),
    "second_radius": _flag("radius", "'10 mm'", " of the second body, a sphere or cup"),
    "second_material": name_option(
        "Material of the second body (default: that of the first).", completion.materials
    ),
    "thickness": _flag("thickness", "'3 mm'", ", which gives way (default: a thick wall)"),
    "width": _flag("width", "'200 mm'", " (default: wide enough)"),
    "friction": _flag("friction", "0.2"),
    "roughness": _flag(
        "roughness", "'0.1 um'", " (default: both that of lapped and that of ground ones must do)"
    ),
    "speed": _flag("speed", "'2 m/s'"),
    "angle": _flag("angle", "'30 deg'"),
    "normal_speed": _flag("normal_speed", "2"),
    "tangential_speed": _flag("tangential_speed", "1"),
    "spin": _flag(
        "spin", "'100 rad/s'", ", positive if it adds to the tangential speed of the contact point"
    ),
    "spin2": _flag("spin2", "'50 rad/s'", ", if that is a sphere"),
    "normal_spin": "Spin about the line of impact, e.g. '500 rad/s' [rad/s]. The exact theory "
    "neglects it and says how much it may matter; --method halfspace solves for it.",
    "restitution": "Normal coefficient of restitution of a viscous (Kelvin-Voigt) contact, e.g. "
    "0.9 (default: elastic bodies).",
    "loss_time": "Loss time of a viscous (Kelvin-Voigt) contact, e.g. '2 us' [s], instead of "
    "--restitution.",
    "relaxation_time": "Relaxation time of a standard linear solid, e.g. '20 us' [s]; needs "
    "--modulus-ratio.",
    "modulus_ratio": "Instantaneous modulus of a standard linear solid over its relaxed modulus, "
    "e.g. 1.5; needs --relaxation-time.",
    "yield_velocity": "Normal velocity above which a body yields, e.g. '0.1 m/s', or 'material' "
    "to compute it from the yield strengths of the materials.",
    "flow_stress": "Yield strength of a metal that is struck beyond its yield, e.g. '1 GPa', or "
    "'material' to take that of the materials; the pressure rises as it yields.",
    "method": name_option(
        "'exact' solves the theory; 'halfspace' solves the full contact in three dimensions by "
        "boundary elements, in two seconds, or fifteen for unlike materials.",
        METHODS,
    ),
    "elements": whole_option(
        "Number of boundary elements across the contact, for --method halfspace (default: 64)."
    ),
    "steps": whole_option(
        "Time steps per duration of Hertz's contact, for --method halfspace (default: 300)."
    ),
    "animate": "Store an animation of the contact patch: .gif, or .mp4 if ffmpeg is installed.",
    "output": "Store forces, velocities, radii and energies over time: .nc or .csv.",
    "spectrum": "Store the frequency spectra of the forces: .nc or .csv.",
    "peaks": typer.Option(
        "--peaks", help="Also print the largest stresses of the impact in each body."
    ),
}


@described(OPTIONS)
def impact_command(
    case: list[str] | None = None,
    normal_spin: str | None = None,
    method: str = "exact",
    as_json: bool = False,
    plot: str | None = None,
    peaks: bool = False,
    **given: str | None,
) -> None:
    """Solve one oblique impact of two bodies.

    Use this command to learn how a sphere leaves an oblique impact, through which phases of stick
    and slip the contact goes, and whether the assumptions of the theory hold. Options, a case file
    or both describe the impact. Numbers may have a unit; those without are in the SI unit that
    stands in brackets below.

    \b
    Example: carom impact --radius "5 mm" --material steel --friction 0.2 --speed 2 --angle "30 deg"
    A case file: carom impact examples/steel_ball.toml --plot hit.png --animate hit.gif
    Several, or the standard input: carom impact steel.toml glass.toml - --json < brass.toml

    You can add to the first example:

    \b
    --restitution 0.9            a ball that loses energy to viscosity
    --yield-velocity "0.1 m/s"   a ball that yields
    --method halfspace           slip in any direction, coupling of unlike materials
    --spectrum forces.csv        spectra of the forces, for acoustic sensors
    --peaks                      the largest stresses in both bodies
    """
    from carom.bodies.cases import LOSSES, MOTION, RATIO
    from carom.bodies.pairs import OF_BOTH

    named = (*CASE_KEYS, *OF_BOTH, *MOTION, *LOSSES, RATIO)
    options = {**given, "plot": plot}
    flags = {CASE_KEYS.get(name, name): options[name] for name in named}
    with checking() as faults:
        counts = {name: given[name] for name in ("elements", "steps")}
        solver = faults.trying(_method, method, counts)
        if normal_spin is not None:
            faults.trying(finite, "normal_spin", normal_spin)
        if peaks and method == "halfspace":
            faults.add(NO_PEAKS)
        read = []
        files = case or [""]
        for name in files:
            with faults.catching(name if len(files) > 1 else ""):
                read.append(_read(name if case else None, flags))
        twice = Counter(os.path.realpath(file) for one in read for file in one.files.values())
        several = [file for file, count in twice.items() if count > 1]
        words = "several impacts are to be stored there; write [output] into each case file"
        faults.add(*(str(refusal("output file", file, words)) for file in several))
    spin: dict[str, Any] = {} if normal_spin is None else {"normal_spin": normal_spin}
    records, paths = [], list[Path]()
    shown = None if len(read) > 1 else False  # one alone shows its own progress
    with advancing("solving the impacts", len(read), shown) as advance:
        for name, one in zip(files, read, strict=True):
            hit = carom.impact(one.pair, **one.motion | spin, losses=one.losses, method=solver)
            told = _told(hit, peaks=peaks, as_json=as_json)
            paths += _store(hit, one.files)
            if as_json:
                records.append(told)
            else:
                typer.echo(f"{name}\n{told}" if len(read) > 1 else told)
            advance(1)
    if as_json:
        typer.echo(json.dumps(records if len(records) > 1 else records[0], indent=2))
    for path in paths:
        stored(path)


class _Case(NamedTuple):
    """One impact: bodies, speeds, losses, and the files that are asked for."""

    pair: Any
    motion: dict[str, Any]
    losses: Any
    files: dict[str, str]


def _read(path: str | None, flags: Mapping[str, Any]) -> _Case:
    """Return what a case file and flags say together, or raise InputError with all faults."""
    from carom.bodies import cases
    from carom.bodies.checks import checked_motion

    with Faults() as faults:
        pair, read = None, {}
        if path is not None:
            read = faults.trying(cases.read_case, path, losses=True)
        content = merged(read or {}, flags)
        files = faults.trying(outputs, content) or {}
        written = {"plot": files.get("plot"), "output": files.get("data")}
        faults.trying(check_outputs, written | {"spectrum": files.get("spectrum")})
        if "animation" in files:
            faults.trying(carom.plots.checked_animation, files["animation"])
        losses, motion = faults.trying(cases.losses_of, content), cases.motion_of(content)
        round_ones = not cases.has_shapes(content)
        if round_ones:
            faults.trying(cases.numbers_of, content)
        if read is not None:  # else a file that cannot be read may give what is missing
            pair = faults.trying(cases.pair_of, content)
            if round_ones:
                faults.trying(checked_motion, pair, **motion)
    tell_sweep(content)
    return _Case(pair, motion, losses, files)


def _told(hit: "ImpactResult", *, peaks: bool, as_json: bool) -> Any:
    """Return an impact as a record for JSON, or as a text."""
    told: Any = hit.to_dict() if as_json else str(hit)
    if not peaks:
        return told
    from carom.impacts.peaks import peaks_record, peaks_text

    if not isinstance(hit, carom.results.Impact):
        raise InputError(NO_PEAKS)
    found = hit.peaks()
    return told | {"peaks": peaks_record(found)} if as_json else f"{told}\n{peaks_text(found)}"


def _method(name: str, numbers: Mapping[str, str | None]) -> Any:
    there = {key: text for key, text in numbers.items() if text is not None}
    if not there:
        return one_of("method", name, METHODS)
    from carom.impacts.boundary_elements import RANGES

    with Faults() as faults:
        faults.trying(one_of, "method", name, METHODS)
        counts = {n: faults.trying(whole, n, text, *RANGES[n]) for n, text in there.items()}
        words = "it is an option of boundary elements; add --method halfspace"
        if name == "exact":
            faults.add(*(str(refusal(n, counts[n] or there[n], words)) for n in counts))
    return carom.BoundaryElements(**counts)


def _store(hit: "ImpactResult", files: Mapping[str, str]) -> Iterator[Path]:
    if "data" in files:
        yield carom.save(hit, files["data"])
    if "spectrum" in files:
        yield carom.save(hit.spectrum(), files["spectrum"])
    if "plot" in files:
        hit.plot(files["plot"])
        yield Path(files["plot"])
    if "animation" in files:
        hit.animate(files["animation"], ANIMATION_FRAMES)
        yield Path(files["animation"])
