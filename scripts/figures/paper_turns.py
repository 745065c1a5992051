#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# Which frame turns of the paper's Tables 1 and 2 give its Eqs. 22 and 23 (docs/paper.md, "Turns").
"""Needs numpy. Eqs. 22 and 23 are taken with the signs of Appendix A, which the print kept."""

import itertools

import numpy as np

QUARTER = np.pi / 2
FIRST_TURNS = {"90 + theta1": lambda theta1: QUARTER + theta1,
               "theta1 - 90": lambda theta1: theta1 - QUARTER}
THIRD_TURNS_DEG = (0, 90, 180, -90)
LAST_TURNS_DEG = (90, -90)
LP_M = 0.02


def transform(theta, d, a, alpha):
    """Eq. 21."""
    sin_theta, cos_theta = np.sin(theta), np.cos(theta)
    sin_alpha, cos_alpha = np.sin(alpha), np.cos(alpha)
    return np.array([[cos_theta, -sin_theta * cos_alpha, sin_theta * sin_alpha, a * cos_theta],
                     [sin_theta, cos_theta * cos_alpha, -cos_theta * sin_alpha, a * sin_theta],
                     [0, sin_alpha, cos_alpha, d],
                     [0, 0, 0, 1]])


def spot(turns, theta1, theta2, across, along):
    """Position column of the chain of Table 1 (across = l1, along = l2) or 2 (l3, l4)."""
    first, third_deg, last_deg = turns
    chain = (transform(0, 0, 0, FIRST_TURNS[first](theta1))
             @ transform(QUARTER + theta2, 0, 0, 0)
             @ transform(0, 0, LP_M, np.radians(third_deg))
             @ transform(np.radians(last_deg), across, along, 0))
    return chain[:3, 3]


def equation_22(theta1, theta2, l1, l2):
    sin1, cos1 = np.sin(theta1 + QUARTER), np.cos(theta1 + QUARTER)
    sin2, cos2 = np.sin(theta2 + QUARTER), np.cos(theta2 + QUARTER)
    return np.array([LP_M * cos2 + l2 * sin2,
                     l2 * cos1 * cos2 - l1 * sin1 - LP_M * cos1 * sin2,
                     l1 * cos1 + l2 * cos2 * sin1 - LP_M * sin1 * sin2])


def equation_23(theta1, theta2, l3, l4):
    sin1, cos1 = np.sin(theta1 + QUARTER), np.cos(theta1 + QUARTER)
    sin2, cos2 = np.sin(theta2 + QUARTER), np.cos(theta2 + QUARTER)
    return np.array([LP_M * cos2 + l4 * sin2,
                     l3 * sin1 + l4 * cos1 * cos2 - LP_M * cos1 * sin2,
                     l4 * cos2 * sin1 - l3 * cos1 - LP_M * sin1 * sin2])


def verdict(turns, equation, names):
    """What the position column is against the equation, at places drawn at random."""
    random = np.random.default_rng(1)
    angles = random.uniform(-0.5, 0.5, (20, 2))
    lengths = random.uniform(-0.05, 0.05, (20, 2))

    def is_equation(about_x, step, signs):
        return all(np.allclose(about_x * spot(turns, *angle, *(length[::step] * signs)),
                               equation(*angle, *length), atol=1e-12)
                   for angle, length in zip(angles, lengths))

    for about_x, place in (((1, 1, 1), "the equation"), ((1, -1, -1), "half a turn about X off")):
        for step, exchange in ((1, ""), (-1, ", " + " and ".join(names) + " exchanged")):
            for signs in itertools.product((1, -1), repeat=2):
                if is_equation(about_x, step, signs):
                    turned = " and ".join(name for name, sign in zip(names[::step], signs)
                                          if sign < 0)
                    return place + exchange + (f", {turned} negative" if turned else "")
    return "another point"


def main():
    print("first alpha, third alpha, last theta (degrees): the position column is")
    for sensor, equation, names in (("Sx, Eq. 22", equation_22, ("l1", "l2")),
                                    ("Sy, Eq. 23", equation_23, ("l3", "l4"))):
        print(sensor)
        for turns in itertools.product(FIRST_TURNS, THIRD_TURNS_DEG, LAST_TURNS_DEG):
            print("  {:11s} {:4d} {:4d}: {}".format(*turns, verdict(turns, equation, names)))


if __name__ == "__main__":
    main()
