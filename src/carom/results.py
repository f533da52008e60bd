"""Results as records, tables and labelled datasets, and how they are stored."""

import json
import os
import tempfile
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.quantities import GLOSSARY, InputError, refusal

if TYPE_CHECKING:
    import xarray as xr

    from carom.dimensionless.solution import Phase


TABLES = (".nc", ".csv")
FIGURES = (".png", ".pdf", ".svg")


MARKS = {True: "ok ", False: "NO ", None: " ? "}


class Finding(NamedTuple):
    """One number that tells whether the theory holds: value, limit, and a plain verdict."""

    name: str
    value: float
    limit: float
    holds: bool | None  # None: cannot be judged
    verdict: str


class Validity(NamedTuple):
    """All findings on one impact."""

    findings: tuple[Finding, ...]

    @property
    def holds(self) -> bool:
        """Whether no finding is beyond its limit."""
        return all(finding.holds is not False for finding in self.findings)

    def __str__(self) -> str:
        return "\n".join(
            f"{MARKS[f.holds]} {f.name} = {f.value:.3g}: {f.verdict}" for f in self.findings
        )


def carom_version() -> str:
    """Return the version of the package."""
    try:
        return version("carom")
    except PackageNotFoundError:
        return "unknown"


def labelled(
    columns: Mapping[str, ArrayLike],
    scalars: Mapping[str, float],
    phases: "tuple[Phase, ...]",
    inputs: Mapping[str, Any],
) -> "xr.Dataset":
    """Return a history as a dataset whose variables carry unit and meaning from the glossary."""
    import xarray as xr

    data: dict[str, Any] = {
        name: ("time", np.asarray(values), attributes(name)) for name, values in columns.items()
    }
    data |= {name: ((), value, attributes(name)) for name, value in scalars.items()}
    coordinate = {"time": data.pop("time")}
    data |= _phase_variables(phases)
    return xr.Dataset(
        data,
        coords=coordinate,
        attrs={
            "title": "oblique impact of elastic spheres",
            "carom_version": carom_version(),
            "inputs": json.dumps(dict(inputs)),
        },
    )


def _phase_variables(phases: "tuple[Phase, ...]") -> dict[str, Any]:
    seconds = {"units": "s"}
    return {
        "phase_kind": ("phase", [p.kind for p in phases], {"long_name": "kind of phase"}),
        "phase_sign": ("phase", [p.sign for p in phases], {"long_name": "sign of slip"}),
        "phase_start": ("phase", [p.start for p in phases], {"long_name": "start", **seconds}),
        "phase_end": ("phase", [p.end for p in phases], {"long_name": "end", **seconds}),
        "phase_cause": ("phase", [p.cause for p in phases], {"long_name": "what ended it"}),
    }


def attributes(name: str) -> dict[str, str]:
    """Return the attributes of a variable: its unit, meaning and symbol."""
    entry = GLOSSARY[name]
    return {"units": entry.unit, "long_name": entry.meaning, "symbol": entry.symbol}


def save(dataset: "xr.Dataset", path: str | Path) -> Path:
    """Store a dataset as .nc or .csv; a file that is there is replaced whole or not at all.

    Raises InputError if the name ends otherwise or the file cannot be written.
    """
    target = checked_output(path, TABLES)

    def write(where: Path) -> None:
        if target.suffix.lower() == ".nc":
            dataset.to_netcdf(where, engine="h5netcdf")
        else:
            where.write_text(as_csv(dataset), encoding="utf-8")

    return replace_whole(target, write)


def as_csv(dataset: "xr.Dataset") -> str:
    """Return the columns of a dataset as CSV, with units and inputs in comment lines.

    The columns are the variables along all coordinates that have a unit: time, or chi and psi_1.
    """
    along = {name for name in dataset.dims if "units" in dataset[name].attrs}
    names = [str(name) for name, item in dataset.data_vars.items() if set(item.dims) == along]
    frame = dataset[names].to_dataframe().reset_index()
    head = [f"# {key}: {value}" for key, value in dataset.attrs.items()]
    head += [f"# {n}: {dataset[n].long_name} ({dataset[n].units})" for n in frame.columns]
    return "\n".join(head) + "\n" + str(frame.to_csv(index=False))


def checked_output(path: str | Path, endings: tuple[str, ...]) -> Path:
    """Return the path of an output file, or raise InputError if it cannot become one."""
    target = Path(path)
    if target.suffix.lower() not in endings:
        raise refusal("output file", str(path), f"must end in {' or '.join(endings)}")
    if target.is_dir() or not target.parent.is_dir():
        raise refusal("output file", str(path), "its folder must exist; make it first")
    return target


def replace_whole(target: Path, write: Any) -> Path:
    """Call `write` on a temporary file beside the target, then put it in the target's place."""
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent
        )
        os.close(handle)
        temporary = Path(name)
        try:
            write(temporary)
            temporary.chmod(0o666 & ~_umask())
            temporary.replace(target)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"output file: {str(target)!r} cannot be written; {reason}") from None
    return target


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
