"""Closed forms, in SI units. Each says where it is from."""

import numpy as np


def poiseuille(z, time, gap, drive, nu):
    """Newtonian flow between walls z = 0 and gap from rest, body acceleration `drive`: parabola less its series."""
    u = drive * z * (gap - z) / (2 * nu)
    for odd in range(1, 200, 2):
        k = odd * np.pi
        u = u - 4 * drive * gap**2 / (nu * k**3) * np.sin(k * z / gap) * np.exp(-k**2 * nu * time / gap**2)
    return u


def couette(z, time, gap, speed, nu):
    """Flow from rest between a wall at rest, z = 0, and one that moves with `speed`, z = gap (Schlichting)."""
    u = speed * z / gap
    for n in range(1, 200):
        k = n * np.pi
        u = u + 2 * speed * (-1)**n / k * np.sin(k * z / gap) * np.exp(-k**2 * nu * time / gap**2)
    return u


class Papanastasiou:
    """Stress eta rate + tau (1 - exp(-m rate)) in simple shear, and steady flows that carry it."""

    def __init__(self, eta, tau, m):
        self.eta, self.tau, self.m = eta, tau, m

    @classmethod
    def of(cls, fluid):
        """From the keys of a Bingham fluid of a case."""
        return cls(fluid["plastic_viscosity"], fluid["yield_stress"], fluid["growth_exponent"])

    def stress(self, rate):
        return self.eta * rate - self.tau * np.expm1(-self.m * rate)

    def rate(self, stress):
        """Shear rate at a stress >= 0, by bisection."""
        stress = np.asarray(stress, float)
        low, high = np.zeros_like(stress), stress / self.eta
        for _ in range(80):
            middle = 0.5 * (low + high)
            less = self.stress(middle) < stress
            low, high = np.where(less, middle, low), np.where(less, high, middle)
        return 0.5 * (low + high)

    def plane_velocity(self, y, half_gap, gradient):
        """Between no-slip walls at y = -half_gap, half_gap under the force `gradient` [Pa/m]; also a film of the
        thickness half_gap with its surface at y = 0. Exact in the shear rate."""
        here, wall = self.rate(gradient * np.abs(y)), self.rate(gradient * half_gap)
        part = lambda rate: np.exp(-self.m * rate) * (1 + self.m * rate)
        return (self.eta * (wall**2 - here**2) / 2 + self.tau / self.m * (part(here) - part(wall))) / gradient

    def pipe_velocity(self, r, radius, gradient):
        """In a pipe, where the stress is gradient r/2: a plane flow under half the gradient."""
        return self.plane_velocity(r, radius, gradient / 2)

    def couette_velocity(self, r, cylinders, speed):
        """Azimuthal velocity between concentric cylinders (inner, outer radius), the inner turning at `speed`
        [rad/s], and the torque per length: d(u/r)/dr = -rate/r with the stress T/(2 pi r^2)."""
        inner, outer = cylinders
        fine = np.linspace(inner, outer, 20001)

        def omega(torque):
            slope = self.rate(torque / (2 * np.pi * fine**2)) / fine
            steps = 0.5 * (slope[1:] + slope[:-1]) * np.diff(fine)
            return np.append(np.cumsum(steps[::-1])[::-1], 0)  # angular velocity, 0 at the outer wall

        low, high = 0.0, 4 * np.pi * outer**2 * (self.tau + self.eta * speed / (1 - (inner / outer)**2))
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if omega(middle)[0] < speed else (low, middle)
        return r * np.interp(r, fine, omega(low)), low


def newtonian_couette_velocity(r, cylinders, speed):
    """Azimuthal velocity between cylinders, the inner turning at `speed` [rad/s]."""
    inner, outer = cylinders
    return speed * inner**2 / (outer**2 - inner**2) * (outer**2 / r - r)


def buckingham_reiner(radius, gradient, eta, tau):
    """Flow rate of an ideal Bingham fluid through a pipe [m^3/s]."""
    s = 2 * tau / (gradient * radius)
    return np.pi * radius**4 * gradient / (8 * eta) * (1 - 4 * s / 3 + s**4 / 3)


def arrested_slump(area, stress_length):
    """Run-out X of a plane slump at rest, `area` of one half, stress_length B = tau/(rho g):
    h = sqrt(2 B (X - x)) + (pi/2) B, its integral being the area."""
    low, high = 0.0, area / stress_length
    for _ in range(100):
        x = 0.5 * (low + high)
        held = 2 / 3 * np.sqrt(2 * stress_length) * x**1.5 + np.pi / 2 * stress_length * x
        low, high = (x, high) if held < area else (low, x)
    return low


def slump_height(x, run_out, stress_length):
    return np.sqrt(2 * stress_length * np.maximum(run_out - x, 0)) + np.pi / 2 * stress_length


def slump_reach(fraction, run_out, stress_length):
    """How far from the middle this fraction of a slump at rest lies."""
    left = np.linspace(0, run_out, 20001)  # from the front
    held = 2 / 3 * np.sqrt(2 * stress_length) * left**1.5 + np.pi / 2 * stress_length * left
    return run_out - np.interp((1 - fraction) * held[-1], held, left)


def huppert(time, area, nu, gravity):
    """Front of a plane Newtonian gravity current of constant `area` (Huppert 1982)."""
    return 1.4112 * (gravity * area**3 / (3 * nu))**0.2 * time**0.2


def huppert_reach(fraction):
    """How far from the middle, in parts of the front's distance, this fraction of the current lies: its thickness
    goes as (1 - (x/x_N)^2)^(1/3)."""
    x = np.linspace(0, 1, 200001)
    held = np.cumsum((1 - x**2)**(1 / 3))
    return np.interp(fraction * held[-1], held, x)


def surface_wave(guess, wave_number, depth, nu):
    """The s [1/s] nearest to a guess of waves cos(kx) e^(st) of small height on a viscous layer above a floor that it
    slips along: w = A sinh kz + C sinh mz, m^2 = k^2 + s/nu, without stress on the surface (Lamb, Hydrodynamics,
    art. 349, with a floor). By the secant method."""
    k = wave_number

    def stress(s):
        m = np.sqrt(k**2 + s / nu + 0j)
        share = -2 * k**2 / (m**2 + k**2)  # C/A at the surface
        rates = k / np.tanh(k * depth) + share * m / np.tanh(m * depth)
        return s**2 / (k * np.tanh(k * depth)) + 9.81 * (1 + share) + 2 * nu * s * rates

    s, before = complex(guess), 1.01 * complex(guess)
    for _ in range(50):
        here, there = stress(s), stress(before)
        if here == there:
            break
        s, before = s - here * (s - before) / (here - there), s
    return s


def creeping_wave_rate(wave_number, depth, nu):
    """Rate [1/s] at which such a wave levels without inertia."""
    kd = wave_number * depth
    return 9.81 / (2 * nu * wave_number) * np.sinh(kd)**2 / (np.sinh(kd) * np.cosh(kd) + kd)
