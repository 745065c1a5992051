#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Times SciPy's fsolve on the paper's equations: solver_peers.py TRUTH.csv, a JSON line a start."""
import csv
import json
import math
import statistics
import sys
import time

from scipy.optimize import fsolve

LP = DX = DY = 0.02  # as in Appendix A, in metres
PASSES = 15
WRONG_RAD = 1e-3
STARTS = {"zero": [0, 0, 0, 0, 0, 0], "rest": [0, 0, 0, DX, DY, 0]}


def read_truth(path):
    """The angles of `penduline simulate --truth`."""
    with open(path, newline="") as file:
        return [(float(row["theta1_rad"]), float(row["theta2_rad"]))
                for row in csv.DictReader(file)]


def reflections(theta1, theta2):
    """Z of the disc under the sensors, from the plane rod . p = lp."""
    rod_x = -math.sin(theta2)
    rod_y = math.sin(theta1) * math.cos(theta2)
    rod_z = -math.cos(theta1) * math.cos(theta2)
    return (LP - rod_x * DX) / rod_z, (LP - rod_y * DY) / rod_z


def equations(unknowns, dz1, dz2):
    """Residuals as in Appendix A, its quarter turns worked out, which halves their time."""
    theta1, theta2, l1, l2, l3, l4 = unknowns
    s1, c1 = math.sin(theta1), math.cos(theta1)
    s2, c2 = math.sin(theta2), math.cos(theta2)
    return (
        -LP * s2 - DX + l2 * c2,
        l2 * s1 * s2 - l1 * c1 + LP * s1 * c2,
        -l1 * s1 - dz1 - l2 * s2 * c1 - LP * c1 * c2,
        -LP * s2 + l4 * c2,
        l3 * c1 - DY + l4 * s1 * s2 + LP * s1 * c2,
        -l4 * s2 * c1 + l3 * s1 - dz2 - LP * c1 * c2,
    )


def measure(samples, start):
    """Solves all samples PASSES times: the passes' median, and what the answers are worth."""
    per_solve = []
    for _ in range(PASSES):
        begin = time.process_time()
        answers = [fsolve(equations, start, args=sample, full_output=True)[0]
                   for _, sample in samples]
        per_solve.append((time.process_time() - begin) / len(samples))
    errors = [
        max(abs(math.remainder(answer[i] - truth[i], math.tau)) for i in range(2))
        for answer, (truth, _) in zip(answers, samples)
    ]
    return {
        "s_per_solve": statistics.median(per_solve),
        "wrong_roots": sum(not error <= WRONG_RAD for error in errors),
        "worst_rad": max(errors),
    }


def main():
    samples = [(truth, reflections(*truth)) for truth in read_truth(sys.argv[1])]
    for name, start in STARTS.items():
        print(json.dumps({"name": f"scipy_fsolve/from_{name}", **measure(samples, start)}))


if __name__ == "__main__":
    main()
