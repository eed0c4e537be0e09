# SPDX-License-Identifier: Apache-2.0
"""A flight or a campaign as a picture, by matplotlib."""

from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from . import _core
from .campaigns import CampaignResult

# channels of one panel, how its axis is called, factor from SI
PANELS = (
    (("slider_force_N", "measured_force_N"), "force through\nthe slider [N]", 1.0),
    (("cup_pressure_Pa", "measured_cup_pressure_Pa"), "pressure in\nthe cup [hPa]", 0.01),
    (("pitch_rad", "roll_rad", "yaw_rad"), "attitude [deg]", 180.0 / np.pi),
    (("thrust_N",), "thrust [N]", 1.0),
)


def plot(result: _core.Result, *others: _core.Result, events: bool = True,
         panels: Sequence[tuple[Sequence[str], str, float]] = PANELS, file: Optional[str] = None) -> Any:
    """Force, pressure, attitude and thrust of a flight against time, its events numbered and named
    in a list; further flights are drawn over it, dashed. Returns matplotlib's figure; with `file` it
    is written too."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(len(panels), 1, sharex=True, figsize=(9, 1.9 * len(panels)),
                                layout="constrained", squeeze=False)
    for axis, (channels, label, factor) in zip(axes[:, 0], panels):
        for k, name in enumerate(channels):
            text = name.rsplit("_", 1)[0].replace("_", " ").removesuffix(" rad")
            axis.plot(result["time_s"], factor * result[name], color=f"C{k}", lw=1.2,
                      zorder=2 if k == 0 else 1, label=text)
            for other in others:
                axis.plot(other["time_s"], factor * other[name], color=f"C{k}", lw=0.9, ls="--")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        if len(channels) > 1:
            axis.legend(loc="upper right", fontsize="small")
    if events:
        named = [event for event in result.events if event.name != "parameter_set"]
        for number, event in enumerate(named, 1):
            for axis in axes[:, 0]:
                axis.axvline(event.time_s, color="0.75", lw=0.8, zorder=0)
        _number(axes[0, 0], [event.time_s for event in named])
        text = "\n".join(f"{i}  {event.time_s:.2f} s  {event.name.replace('_', ' ')}"
                         for i, event in enumerate(named, 1))
        figure.text(1.005, 0.98, text, va="top", fontsize="small")
    axes[-1, 0].set_xlabel("time [s]")
    axes[0, 0].set_title(f"{result.outcome.replace('_', ' ')}: {result.reason}; in truth {result.true_end.replace('_', ' ')}", loc="left", pad=14)
    if file is not None:
        figure.savefig(file, dpi=150, bbox_inches="tight")
    return figure


def _number(axis: Any, times_s: Sequence[float]) -> None:
    """Numbers over an axis, those of one instant side by side in one label."""
    low, high = axis.get_xlim()
    groups: list[list[int]] = []
    for number, time_s in enumerate(times_s, 1):
        if groups and time_s - times_s[groups[-1][0] - 1] < 0.02 * (high - low):
            groups[-1].append(number)
        else:
            groups.append([number])
    for group in groups:
        text = str(group[0]) if len(group) == 1 else f"{group[0]}-{group[-1]}"
        axis.annotate(text, (times_s[group[0] - 1], 1.0), xycoords=("data", "axes fraction"),
                      xytext=(0, 2), textcoords="offset points", fontsize="x-small",
                      ha="center")


def plot_campaign(result: CampaignResult, key: str, bins: int = 10, *, axis: Any = None,
                  label: Optional[str] = None, file: Optional[str] = None) -> Any:
    """Share of successes against what was varied, with Wilson's 95 % intervals; one point a value
    where there are few, else `bins` of them. Returns matplotlib's figure."""
    import matplotlib.pyplot as plt

    if key not in (result.runs.dtype.names or ()):
        raise _core.InputError(f"{key}: no column of these results; there are "
                               + ", ".join(result.runs.dtype.names or ()))
    figure, axis = plt.subplots(figsize=(6, 4), layout="constrained") if axis is None else (axis.figure, axis)
    values = result.runs[key]
    distinct = np.unique(values)
    if values.dtype.kind == "U" or len(distinct) <= 2 * bins:
        groups = [(value, values == value) for value in distinct]
    else:
        edges = np.linspace(values.min(), values.max(), bins + 1)
        place = np.clip(np.digitize(values, edges) - 1, 0, bins - 1)
        groups = [((edges[i] + edges[i + 1]) / 2, place == i) for i in range(bins) if np.any(place == i)]
    shares = np.array([result.interval(which) for _, which in groups])
    axis.errorbar([value for value, _ in groups], shares[:, 0],
                  yerr=[np.maximum(0.0, shares[:, 0] - shares[:, 1]),
                        np.maximum(0.0, shares[:, 2] - shares[:, 0])],
                  fmt="o-", capsize=3, label=label)
    axis.set(xlabel=key, ylabel="share of successes, 95 % intervals", ylim=(-0.03, 1.03))
    axis.grid(alpha=0.3)
    if label is not None:
        axis.legend()
    if file is not None:
        figure.savefig(file, dpi=150, bbox_inches="tight")
    return figure
