# SPDX-License-Identifier: Apache-2.0
"""Synthetic aperture radar (SAR): an image of how coherently a tag's phases add up."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._core import Error
from ._tables import Table

__all__ = ["antenna_positions", "image"]

_LIGHT_M_S = 299_792_458.0


def antenna_positions(reads: Table, poses: Table) -> np.ndarray:
    """(N, 3) believed antenna position [m, world] at each read, interpolated linearly between poses.

    An antenna with a single pose is fixed. NaN before the first pose and after the last.
    """
    places = np.full((len(reads), 3), np.nan)
    for antenna in np.unique(reads.names("antenna")):
        rows = reads._are("antenna", [antenna])
        track = poses[poses._are("name", [antenna])]
        if len(track) == 0:
            continue
        track = track[np.argsort(track["stamp_ns"], kind="stable")]
        still = len(track) == 1
        for axis in range(3):
            places[rows, axis] = track["position_m"][0, axis] if still else np.interp(
                reads.time_s[rows], track.time_s, track["position_m"][:, axis], left=np.nan, right=np.nan)
    return places


def image(reads: Table, poses: Table, tag: str, x_m: Any, y_m: Any, height_m: float) -> np.ndarray:
    """Matched filter of a tag's phases over a grid: (len(y_m), len(x_m)), from 0 to 1.

        I(p) = (1/M) Σ_a,f |Σ_n exp(j (φ_n − 4π f |p − a_n| / c))|

    The sum is coherent over the reads n of one antenna a on one carrier f, whose phase offset is unknown,
    and by magnitude over antennas and carriers; M is the number of reads. It is 1 where all phases fit.
    """
    of_tag = reads[reads._are("tag", [tag])]
    places = antenna_positions(of_tag, poses)
    usable = np.isfinite(places[:, 0])
    if not usable.any():
        raise Error(f"sar: tag '{tag}' has no reads with a pose")
    of_tag, places = of_tag[usable], places[usable]
    grid = np.stack([*np.meshgrid(np.asarray(x_m, float), np.asarray(y_m, float))], axis=-1)
    power = np.zeros(grid.shape[:2])
    carriers = of_tag["frequency_hz"]
    for antenna in np.unique(of_tag["antenna"]):
        for carrier in np.unique(carriers):
            rows = (of_tag["antenna"] == antenna) & (carriers == carrier)
            power += np.abs(_sum(of_tag["phase_rad"][rows], places[rows], carrier, grid, height_m))
    return power / len(of_tag)


def _sum(phases: np.ndarray, places: np.ndarray, carrier_hz: float, grid: np.ndarray,
         height_m: float) -> np.ndarray:
    """Coherent sum over the reads, one read at a time, so that it needs memory for one image only."""
    total = np.zeros(grid.shape[:2], dtype=complex)
    wave = 4.0 * np.pi * carrier_hz / _LIGHT_M_S
    for phase, place in zip(phases, places, strict=True):
        squared = ((grid - place[:2]) ** 2).sum(axis=-1) + (height_m - place[2]) ** 2
        total += np.exp(1j * (phase - wave * np.sqrt(squared)))
    return total
