# SPDX-License-Identifier: MIT OR Apache-2.0
"""Modes of a linear model, named by what takes part in them and never by the order of their frequencies.

Participation of state k in mode j is |V_kj W_jk|, right and left eigenvectors, the same for any units. It is summed over groups
of states: u and pitch (phugoid), w and q, v and r (dutch roll), p and roll, every blade mode's coordinates, inflow. The largest
group names the mode; where a second has three tenths both do.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

SHARED = 0.3
"""Participation from which a second group names the mode too."""
SLOW = 0.3
"""Real roll roots slower than this [1/s] are the spiral's."""
REAL = 1e-9
TAKES_PART = 0.2
"""Share of one state of a group beside that of the other below which it is left out of the name."""
BODY_GROUPS = {
    "u": "speed",
    "pitch": "speed",
    "w": "heave",
    "q": "heave",
    "v": "side",
    "r": "side",
    "p": "bank",
    "roll": "bank",
}
_BLADE = re.compile(r"(?P<label>.+?)_(?P<column>0|d|\d+[cs]|blade_\d+)(?:_rate)?$")


@dataclass(frozen=True)
class Modes:
    """Eigenvalues (n,) [1/s], participation (n, s) of every state with its harmonics, names."""

    eigenvalues: np.ndarray
    participation: np.ndarray
    names: tuple[str, ...]
    states: tuple[str, ...]

    def to_dataset(self) -> xr.Dataset:
        """As a Dataset: eigenvalue, frequency, damping, time to half or double, participation, name."""
        import xarray as xr

        root = self.eigenvalues
        size = np.abs(root)
        with np.errstate(divide="ignore", invalid="ignore"):
            damping = np.where(size > 0, -root.real / size, 0.0)
            halving = np.log(2) / np.abs(root.real)
        mode = ("mode",)
        return xr.Dataset(
            {
                "eigenvalue": (mode, root, {"units": "1/s", "long_name": "eigenvalue"}),
                "frequency": (mode, size, {"units": "rad/s", "long_name": "undamped natural frequency"}),
                "damping": (mode, damping, {"units": "1", "long_name": "damping ratio, negative where it grows"}),
                "time": (
                    mode,
                    halving,
                    {"units": "s", "long_name": "time to half amplitude, to double where it grows"},
                ),
                "participation": (("mode", "state"), self.participation, {"units": "1", "long_name": "participation"}),
            },
            coords={"name": (mode, list(self.names)), "state": list(self.states)},
        )


def modes(a: np.ndarray, states: tuple[str, ...], harmonic: np.ndarray, omega: float | None) -> Modes:
    """Modes of x_dot = a x, of conjugates the one of positive frequency.

    states: names, of harmonics too; harmonic as in `Constant`. Amplitudes of harmonics are taken as complex ones z_n, in which a
    mode stands again with its eigenvalue less i n omega: it is read where its states have their lowest harmonic.
    """
    from scipy.linalg import eig

    base = [base_name(name, n) for name, n in zip(states, harmonic, strict=True)]
    complex_, order = _complex(base, harmonic)
    root, left, right = eig(complex_ @ a @ np.linalg.inv(complex_), left=True, right=True)
    share = np.abs(left.conj() * right).T
    share /= share.sum(axis=1, keepdims=True)
    names = tuple(dict.fromkeys(base))
    place = np.array([names.index(name) for name in base])
    lowest = np.full(len(names), np.iinfo(int).max)
    np.minimum.at(lowest, place, np.abs(order))
    own = order == lowest[place]
    here = share[:, own].sum(axis=1)
    kept = np.argsort(-here, kind="stable")[: len(names)]
    shift = np.array([order[own][np.argmax(share[k, own])] for k in kept])
    eigenvalue = root[kept] + 1j * (omega or 0.0) * shift
    upper = np.flatnonzero(eigenvalue.imag > -REAL * (1.0 + np.abs(eigenvalue)))
    chosen = upper[np.lexsort((eigenvalue[upper].imag, -eigenvalue[upper].real))]
    folded = np.zeros((chosen.size, len(names)))
    np.add.at(folded.T, place, share[kept[chosen]].T)
    vectors = np.zeros((chosen.size, len(names)), complex)
    vectors[:, place[own]] = right[np.flatnonzero(own)][:, kept[chosen]].T
    called = tuple(
        name_of(value, dict(zip(names, part, strict=True)), dict(zip(names, vector, strict=True)), omega)
        for value, part, vector in zip(eigenvalue[chosen], folded, vectors, strict=True)
    )
    return Modes(eigenvalue[chosen], folded, called, names)


def base_name(name: str, harmonic: int) -> str:
    """State of which `name` is a harmonic."""
    return name.removesuffix(f"_{abs(harmonic)}{'cos' if harmonic > 0 else 'sin'}") if harmonic else name


def _complex(base: list[str], harmonic: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Matrix to complex amplitudes z_n = (cosine - i sine)/2, z_-n in the place of the sine; the order n of each."""
    whole = np.eye(len(base), dtype=complex)
    place = {(name, int(n)): i for i, (name, n) in enumerate(zip(base, harmonic, strict=True))}
    for (name, n), i in place.items():
        if n > 0:
            j = place[name, -n]
            whole[i, [i, j]], whole[j, [i, j]] = [0.5, -0.5j], [0.5, 0.5j]
    return whole, np.asarray(harmonic)


def name_of(root: complex, share: dict[str, float], vector: dict[str, complex], omega: float | None) -> str:
    """Name of a mode by the participation of its states; vector: the states' amplitudes in it."""
    groups: dict[tuple[str, str], float] = {}
    for state, value in share.items():
        group = _group(state)
        groups[group] = groups.get(group, 0.0) + value
    (first, _), *others = sorted(groups.items(), key=lambda item: -item[1])
    named = [first, *(group for group, value in others[:1] if value >= SHARED)]
    words: list[str] = []
    for group in named:
        word = _word(group, root, share, vector, omega)
        if word not in words:
            words.append(word)
    return " - ".join(words)


def _group(state: str) -> tuple[str, str]:
    """What a state belongs to: a kind, and of blades the mode with the way in which they move together."""
    if state in BODY_GROUPS:
        return BODY_GROUPS[state], ""
    if "inflow" in state:
        return "inflow", state.split("inflow")[0].rstrip("_")
    if state.startswith("wake_"):
        return "wake", ""
    blade = _BLADE.fullmatch(state)
    if blade is None:
        return "other", state
    column = blade["column"]
    kind = {"0": "collective", "d": "differential"}.get(column, "single" if column.startswith("blade") else "cyclic")
    return kind, blade["label"]


def _word(
    group: tuple[str, str], root: complex, share: dict[str, float], vector: dict[str, complex], omega: float | None
) -> str:
    kind, label = group
    moving, growing = root.imag > REAL, root.real > 0.0
    blade = label.replace("_", " ").replace("-", "/")
    if kind == "speed":
        return "phugoid" if moving else "pitch divergence" if growing else "speed"
    if kind == "heave":
        q, w = share.get("q", 0.0), share.get("w", 0.0)
        both = moving and q > TAKES_PART * w
        return (
            "short period" if both else "heave" if w > q else "pitch divergence" if growing and not moving else "pitch"
        )
    if kind == "side":
        r, v = share.get("r", 0.0), share.get("v", 0.0)
        return "dutch roll" if moving and v > TAKES_PART * r else "yaw" if r > v else "sideslip"
    if kind == "bank":
        return "roll" if moving or abs(root) > SLOW else "spiral"
    if kind == "inflow":
        return f"{label} inflow".strip()
    if kind == "wake":
        return kind
    if kind == "cyclic":
        return f"{_whirl(root, label, vector, omega)} {blade}"
    if kind == "collective":
        return "coning" if label == "flap_1" else f"collective {blade}"
    return {"differential": f"differential {blade}", "single": f"blade {blade}"}.get(kind, label)


def _whirl(root: complex, label: str, vector: dict[str, complex], omega: float | None) -> str:
    """Progressing where the wave turns with the rotor and faster than it.

    Blades see q = Re[(z_c cos psi + z_s sin psi) e^(root t)], in which z_c + i z_s goes with the frequency less that of the
    rotor and z_c - i z_s with their sum.
    """
    cosine, sine = vector.get(f"{label}_1c", 0.0), vector.get(f"{label}_1s", 0.0)
    forward = abs(cosine + 1j * sine) > abs(cosine - 1j * sine)
    fast = omega is not None and root.imag > omega
    return "progressing" if forward and fast else "regressing"
