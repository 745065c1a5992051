#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# The paper's simulation: readings of its Euler scheme, what its starts do (docs/paper.md).
"""Needs numpy and the program."""

import pathlib
import tempfile
import warnings

import numpy as np

from program_runs import read_table, rig_file, run

LENGTH_M, GRAVITY_M_S2, DAMPING_PER_S, STEP_S = 0.3, 9.8, 0.01, 0.05
STIFFNESS = GRAVITY_M_S2 / LENGTH_M
NATURAL_RAD_S = np.sqrt(STIFFNESS)


def tilt_rate(theta, omega, psi):
    """Eq. 14."""
    sine = np.sin(theta)
    return psi**2 * sine * np.cos(theta) - STIFFNESS * sine - DAMPING_PER_S * omega


def turn_rate(theta, omega, psi):
    """Eq. 15."""
    return -2 * omega * psi / np.tan(theta) - DAMPING_PER_S * psi


def explicit(theta, omega, psi):
    """Every derivative from the state before."""
    return (theta + STEP_S * omega, omega + STEP_S * tilt_rate(theta, omega, psi),
            psi + STEP_S * turn_rate(theta, omega, psi))


def semi_implicit(theta, omega, psi):
    """The angle from the new rate."""
    _, omega_new, psi_new = explicit(theta, omega, psi)
    return theta + STEP_S * omega_new, omega_new, psi_new


def rates_first(theta, omega, psi):
    """Each state from what is newest: omega, then psi, then theta."""
    omega = omega + STEP_S * tilt_rate(theta, omega, psi)
    psi = psi + STEP_S * turn_rate(theta, omega, psi)
    return theta + STEP_S * omega, omega, psi


def angles_first(theta, omega, psi):
    """The same in the printed order: theta, then omega, then psi."""
    theta = theta + STEP_S * omega
    omega = omega + STEP_S * tilt_rate(theta, omega, psi)
    return theta, omega, psi + STEP_S * turn_rate(theta, omega, psi)


def backward(theta, omega, psi):
    """Every derivative from the state itself, as the printed index i says; by Newton's method."""
    before = np.array([theta, omega, psi])

    def misfit(state):
        return state - before - STEP_S * np.array([state[1], tilt_rate(*state), turn_rate(*state)])

    state = before
    for _ in range(50):
        slopes = np.column_stack([(misfit(state + nudge) - misfit(state - nudge)) / 2e-7
                                  for nudge in np.eye(3) * 1e-7])
        state = state - np.linalg.solve(slopes, misfit(state))
    return tuple(state)


def energy(theta, omega, psi):
    return (omega**2 + (psi * np.sin(theta))**2) / 2 + STIFFNESS * (1 - np.cos(theta))


def print_readings():
    print("Share of the energy left, or the step by which it has doubled")
    for scheme in (explicit, semi_implicit, rates_first, angles_first, backward):
        words = []
        for psi, steps in ((0.0, 200), (2.0, 1000), (6.0, 1000)):
            state = (np.radians(10), 0.0, psi)
            start = energy(*state)
            step = 0
            while step < steps and energy(*state) <= 2 * start:
                state = scheme(*state)
                step += 1
            left = energy(*state) / start
            words.append(f"psi {psi:.0f}, {steps} steps: "
                         + (f"{left:8.3g} left" if left <= 2 else f"doubled by {step:3d}"))
        print(f"  {scheme.__name__:15s}", "   ".join(words))


def print_small_swing():
    growth = np.sqrt(1 - DAMPING_PER_S * STEP_S + STIFFNESS * STEP_S**2)
    undamped = np.sqrt(1 + STIFFNESS * STEP_S**2)
    print(f"Explicit Euler, small swings: amplitude times {growth:.4f} a step,"
          f" {growth**200:.0f} in 10 s ({undamped**200:.0f} without damping);"
          f" energy times {growth**400:.1g}")
    stepped = np.arccos(1 - STIFFNESS * STEP_S**2 / 2) / STEP_S
    print(f"Semi-implicit, small swings: frequency {100 * (stepped / NATURAL_RAD_S - 1):+.2f} %")


def simulated_truth(folder, *options):
    run("simulate", "--rig", folder / "rig.toml", "-o", folder / "unused.csv", "--ideal",
        "--truth", folder / "truth.csv", *options)
    return read_table(folder / "truth.csv")


def tilt_deg(truth):
    return np.degrees(np.arccos(-truth["z_m"] / LENGTH_M))


def print_starts(folder):
    print("Undamped swing from theta = 10 deg: tilt from .. to .., speed at the start")
    rig_file(folder, "rig.toml", ("damping_per_s = 0.01", "damping_per_s = 0"))
    conical = np.sqrt(GRAVITY_M_S2 / (LENGTH_M * np.cos(np.radians(10))))
    printed_speed = 2 * LENGTH_M * np.sin(np.radians(45))
    for words, psi in (("2 rad/s", 2), ("6 rad/s", 6), ("conical", conical),
                       ("0.42 m/s", printed_speed / (LENGTH_M * np.sin(np.radians(10))))):
        tilt = tilt_deg(simulated_truth(folder, "--psi", psi, "--rate", 1000, "--seconds", 2))
        speed = psi * LENGTH_M * np.sin(np.radians(10))
        print(f"  {words:9s} psi {psi:5.2f} rad/s: {tilt.min():5.2f} .. {tilt.max():5.2f} deg,"
              f" {speed:.3f} m/s")


def print_precession(folder):
    """The ellipse's axis from position and velocity, which the small-swing ellipse fixes."""
    rig_file(folder, "rig.toml")
    truth = simulated_truth(folder, "--case", 2)
    x, y = -truth["theta2_rad"], truth["theta1_rad"]
    x_rate = -truth["omega2_rad_s"] / NATURAL_RAD_S
    y_rate = truth["omega1_rad_s"] / NATURAL_RAD_S
    axis = np.unwrap(np.arctan2(2 * (x * y + x_rate * y_rate),
                                x**2 - y**2 + x_rate**2 - y_rate**2)) / 2
    t_s = truth["t_us"] / 1e6
    long_axis = np.radians(10)
    short_axis = long_axis * 2 / NATURAL_RAD_S
    print("Case 2, 2 rad/s: the ellipse turns by")
    for seconds in (10, 50):
        # Over one period, which evens out the wobble within it.
        at_end = (t_s > seconds - 1.1) & (t_s <= seconds)
        turned = np.degrees(np.mean(axis[at_end]) - np.mean(axis[t_s <= 1.1]))
        decay = np.exp(-DAMPING_PER_S * 0.55) - np.exp(-DAMPING_PER_S * (seconds - 0.55))
        airy = np.degrees(3 / 8 * NATURAL_RAD_S * long_axis * short_axis * decay / DAMPING_PER_S)
        print(f"  {turned:.1f} deg in {seconds} s; Airy's (3/8) omega0 a b says {airy:.1f}")
    tilt = tilt_deg(truth)
    print(f"  largest tilt {tilt[:23].max():.2f} deg in the first period,"
          f" {tilt[-23:].max():.2f} in the last")


def main():
    warnings.simplefilter("ignore", RuntimeWarning)  # what has run away overflows
    print_small_swing()
    print_readings()
    with tempfile.TemporaryDirectory() as name:
        print_starts(pathlib.Path(name))
        print_precession(pathlib.Path(name))


if __name__ == "__main__":
    main()
