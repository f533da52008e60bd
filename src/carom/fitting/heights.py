"""Vertical drops: speeds from the heights before and after."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from carom.io.columns import ERROR
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError

HEIGHTS = {"drop_height": "normal_speed", "rebound_height": "normal_speed_out"}
TWICE = ("speed", "angle", "tangential_speed", "contact_angle", "psi_in", "normal_restitution")
GRAVITY = 9.80665  # m/s^2
MOST = 1.5  # speed after over speed before that scatter may reach
DRAG, AIR = 0.45, 1.2  # drag coefficient of a sphere at Reynolds numbers of 1e3 to 1e5; kg/m^3


def with_speeds(rows: UserTable) -> UserTable:
    """Return the columns with the speeds of drops, V = sqrt(2 g h) and V' = sqrt(2 g h').

    Heights are those of the lowest point of the ball. Adds faults for heights that cannot be, and
    raises InputError for what is said twice.
    """
    there = [name for name in HEIGHTS if name in rows.columns]
    if not there:
        return rows
    rows.require("drop_height")
    twice = [name for name in (*TWICE, *HEIGHTS.values()) if name in rows.columns]
    if twice:
        raise InputError(f"{there[0]}: it gives the same as {twice[0]}; leave one of them out")
    columns = dict(rows.columns)
    for height, speed in HEIGHTS.items():
        if height in columns:
            rows.refuse(height, columns[height] <= 0.0, "must be positive")
            _add_speed(columns, height, speed)
    columns["tangential_speed"] = np.zeros(len(rows))
    if "rebound_height" in columns:
        too_high = columns["normal_speed_out"] > MOST * columns["normal_speed"]
        allowed = "must, apart from scatter, be no larger than drop_height"
        rows.refuse("rebound_height", too_high, allowed)
    return replace(rows, columns=columns)


def _add_speed(columns: dict[str, Array], height: str, speed: str) -> None:
    values = np.where(columns[height] > 0.0, columns[height], np.nan)
    columns[speed] = np.sqrt(2.0 * GRAVITY * values)
    if height + ERROR in columns:
        with np.errstate(divide="ignore", invalid="ignore"):
            columns[speed + ERROR] = GRAVITY * columns[height + ERROR] / columns[speed]


def taken_by_air(heights: Mapping[str, Array], radius: float, mass: float) -> float:
    """Return by which part of itself a restitution from heights is too small, to first order.

    e = sqrt(h'/h) (1 + k (h + h')/4), k = C_d rho pi R^2/m, in air.
    """
    k = DRAG * AIR * np.pi * radius**2 / mass
    whole = heights["drop_height"] + heights["rebound_height"]
    return float(0.25 * k * np.nanmedian(whole))
