"""The sphericart side of `compare-sphericart`: prints JSON like the example `batch_speed`. NumPy's arrays
come from the heap and go back to it (see the environment that the caller sets), so that pages are not
mapped anew at each call."""

import json
import statistics
import sys
import time

import numpy
import sphericart

BUDGET = 0.02
BANDS = [2, 4, 6, 9, 14, 19]


def spiral(count, scalar):
    i = numpy.arange(count)
    z = 1 - (2 * i + 1) / count
    angle = numpy.pi * (3 - numpy.sqrt(5)) * i
    radius = numpy.sqrt(1 - z * z)
    return numpy.stack([radius * numpy.cos(angle), radius * numpy.sin(angle), z], axis=1).astype(scalar)


def median(call, points):
    call(points)
    times, begin = [], time.perf_counter()
    while len(times) < 5 or time.perf_counter() - begin < BUDGET:
        start = time.perf_counter()
        call(points)
        times.append((time.perf_counter() - start) * 1e9 / len(points))
    return statistics.median(times)


def speeds():
    cells = {}
    for count in [1_000, 100_000]:
        for l_max in BANDS:
            for name, scalar in [("f32", numpy.float32), ("f64", numpy.float64)]:
                basis, points = sphericart.SphericalHarmonics(l_max), spiral(count, scalar)
                cells[f"{name} values {l_max} {count}"] = median(basis.compute, points)
                cells[f"{name} gradients {l_max} {count}"] = median(basis.compute_with_gradients, points)
    return cells


def errors():
    cells, points = {}, spiral(1_000, numpy.float32)
    for l_max in BANDS:
        basis = sphericart.SphericalHarmonics(l_max)
        found = basis.compute_with_gradients(points)
        truth = basis.compute_with_gradients(points.astype(numpy.float64))
        for kind, single, double in zip(["values", "gradients"], found, truth):
            cells[f"{kind} {l_max}"] = float(abs(single - double).max())
    return cells


json.dump(errors() if "errors" in sys.argv else speeds(), sys.stdout)
