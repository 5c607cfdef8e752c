# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a study found: values, errors, orders and cost of every setting."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .estimate import Estimate, estimate
from .parameters import Parameter, Setting
from .runs import Outcome, Quantity

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Findings:
    """One discretisation of one run at several settings, coarse to fine; `.data` is its Dataset."""

    title: str
    parameter: Parameter
    settings: tuple[Setting, ...]
    outcomes: tuple[Outcome, ...]
    quantities: tuple[Quantity, ...]
    failures: tuple[str, ...] = ()

    @property
    def labels(self) -> list[str]:
        """Settings as they were given."""
        return [setting.label for setting in self.settings]

    @property
    def is_history(self) -> bool:
        """Whether quantities are histories."""
        return len(self.outcomes[0].times) > 1

    @cached_property
    def times(self) -> np.ndarray:
        """Instants that all settings have [s]."""
        shared = np.round(self.outcomes[0].times, 9)
        for outcome in self.outcomes[1:]:
            shared = np.intersect1d(shared, np.round(outcome.times, 9))
        return shared

    @cached_property
    def samples(self) -> np.ndarray:
        """Quantities (n_settings, n_instants, n_quantities) at `times`, in the units shown."""
        return np.array([o.samples[np.isin(np.round(o.times, 9), self.times)] for o in self.outcomes])

    @cached_property
    def estimates(self) -> list[Estimate]:
        """Error estimate of every quantity."""
        sizes = np.array([setting.size for setting in self.settings])
        # what did not settle has no limit to tend to
        settled = not any(outcome.notes for outcome in self.outcomes)
        order = self.parameter.formal_order if settled else None
        found = [estimate(sizes, self.samples[:, :, i], order) for i in range(len(self.quantities))]
        return found if settled else [replace(each, note="a setting did not settle") for each in found]

    @cached_property
    def scales(self) -> np.ndarray:
        """What an error is compared with: the excursion of a history in the finest run, the value of a trim."""
        finest = self.samples[-1]
        return np.asarray(np.max(np.abs(finest - finest[0]), axis=0) if self.is_history else np.abs(finest[0]))

    @property
    def data(self) -> xr.Dataset:
        """The study by setting and quantity; an order of 0 means that there is none, `order_note` says why."""
        import xarray as xr

        settings, names = self.labels, [q.name for q in self.quantities]
        both = ("setting", "quantity")
        # a quantity without an order has no known error at the finest setting: zero there, and `error_known` says so
        error = np.array([[e.error[k] or 0.0 for e in self.estimates] for k in range(len(settings))])
        largest = np.array([[e.largest[k] or 0.0 for e in self.estimates] for k in range(len(settings))])
        known = np.array([[e.error[k] is not None for e in self.estimates] for k in range(len(settings))])
        variables = {
            "size": ("setting", [s.size for s in self.settings], "smaller is finer: the value, or its inverse", "SI"),
            "error": (both, error, "estimated error, root of the mean square over the instants", "unit"),
            "error_largest": (both, largest, "estimated error, largest magnitude", "unit"),
            "error_known": (both, known.astype(int), "1 where error is an estimate", "1"),
            "scale": ("quantity", self.scales, "excursion of a history in the finest run, magnitude in a trim", "unit"),
            "order": (
                "quantity",
                [e.order or 0.0 for e in self.estimates],
                "observed order, 0 where there is none",
                "1",
            ),
            "seconds": ("setting", [o.seconds for o in self.outcomes], "wall clock", "s"),
            "cpu_seconds": ("setting", [o.cpu_seconds for o in self.outcomes], "processor time, all threads", "s"),
        }
        for name in self.counters:
            counted = [o.counters.get(name, 0) for o in self.outcomes]
            variables[name] = ("setting", counted, name.replace("_", " "), "1")
        values = self.samples if self.is_history else self.samples[:, 0]
        dims = ("setting", "time", "quantity") if self.is_history else both
        coords: dict[str, object] = {
            "setting": settings,
            "quantity": names,
            "unit": ("quantity", [q.unit for q in self.quantities]),
            "order_note": ("quantity", [e.note for e in self.estimates]),
        }
        if self.is_history:
            coords["time"] = ("time", self.times, {"units": "s", "long_name": "time from the start of the flight"})
        data = {name: (d, v, {"long_name": text, "units": unit}) for name, (d, v, text, unit) in variables.items()}
        data["value"] = (dims, values, {"long_name": "quantity compared", "units": "unit"})
        return xr.Dataset(
            data,
            coords,
            {
                "title": self.title,
                "parameter": self.parameter.name,
                "meaning": self.parameter.meaning,
                "failures": "; ".join(self.failures),
            },
        )

    @property
    def counters(self) -> list[str]:
        """Names of what was counted in any run."""
        return list(dict.fromkeys(name for outcome in self.outcomes for name in outcome.counters))

    def rows(self) -> list[list[object]]:
        """A line per setting and quantity; an empty cell is a number that is not known."""
        head = ["setting", "quantity", "unit", "value", "error", "error_largest", "scale", "order", "note"]
        rows: list[list[object]] = [[*head, "seconds", "cpu_seconds", *self.counters]]
        for k, (label, outcome) in enumerate(zip(self.labels, self.outcomes, strict=True)):
            cost = [f"{outcome.seconds:.3f}", f"{outcome.cpu_seconds:.3f}"]
            counted = [outcome.counters.get(name, 0) for name in self.counters]
            for i, (quantity, found) in enumerate(zip(self.quantities, self.estimates, strict=True)):
                value = "" if self.is_history else f"{self.samples[k, 0, i]:.9g}"
                known = (found.error[k], found.largest[k], found.order)
                errors = ["" if x is None else f"{x:.4g}" for x in known]
                errors.insert(2, f"{self.scales[i]:.6g}")
                rows.append([label, *quantity[:2], value, *errors, found.note, *cost, *counted])
        return rows
