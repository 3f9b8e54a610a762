"""Closed forms of heat, and slabs by finite volumes where there is none. SI units, temperatures in kelvin."""

import numpy as np

STEFAN_BOLTZMANN = 5.670374e-8  # [W/(m² K⁴)]


def bisect(function, low, high):
    """Where a growing function is zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return 0.5 * (low + high)


def erf(x):
    """Of one number."""
    from math import erf as of_one
    return of_one(x)


def slab_between_walls(height, fourier):
    """Temperature over that of the start above the walls' in a slab 0 < height < 1 (Carslaw and Jaeger 1959, ch. 3)."""
    n = np.arange(1, 2001, 2)[:, None]
    return np.sum(4 / (n * np.pi) * np.sin(n * np.pi * height) * np.exp(-(n * np.pi) ** 2 * fourier), axis=0)


def slab_between_walls_mean(fourier):
    n = np.arange(1, 4001, 2)
    return float(np.sum(8 / (n * np.pi) ** 2 * np.exp(-(n * np.pi) ** 2 * fourier)))


def half_space_with_flux(depth, diffusivity, time):
    """Temperature over flux / conductivity [m] at a depth below a surface through which it comes (ibid. 2.9)."""
    from math import erfc
    root = np.sqrt(diffusivity * time)
    return (2 * root / np.sqrt(np.pi) * np.exp(-depth**2 / (4 * root**2))
            - depth * np.vectorize(erfc)(depth / (2 * root)))


def convection_roots(biot):
    """z tan z = Biot."""
    return np.array([bisect(lambda z: z * np.sin(z) - biot * np.cos(z) if k % 2 == 0 else
                            -(z * np.sin(z) - biot * np.cos(z)), k * np.pi, k * np.pi + np.pi / 2) for k in range(80)])


def slab_with_convection(height, biot, fourier):
    """The same of a slab -1 < height < 1 that loses heat by h = biot k / (half thickness) (ibid. 3.11)."""
    z = convection_roots(biot)[:, None]
    return np.sum(4 * np.sin(z) / (2 * z + np.sin(2 * z)) * np.cos(z * height) * np.exp(-z * z * fourier), axis=0)


def slab_with_convection_mean(biot, fourier):
    z = convection_roots(biot)
    return float(np.sum(4 * np.sin(z) ** 2 / (z * (2 * z + np.sin(2 * z))) * np.exp(-z * z * fourier)))


def sphere_with_convection_mean(biot, fourier):
    """Of a sphere of radius 1: 1 - z cot z = Biot (ibid. 9.4)."""
    roots = np.array([bisect(lambda z: (np.sin(z) - z * np.cos(z) - biot * np.sin(z)) * (-1) ** k,
                             k * np.pi + 1e-9, (k + 1) * np.pi - 1e-9) for k in range(60)])
    a = (np.sin(roots) - roots * np.cos(roots)) ** 2 / (roots ** 3 * (roots - np.sin(roots) * np.cos(roots)))
    return float(np.sum(6 * a * np.exp(-roots ** 2 * fourier)))


class Neumann:
    """Freezing at one temperature on a wall (ibid. 11.2): the front is at 2 lambda sqrt(alpha_s t)."""

    def __init__(self, solid, liquid, temperatures, latent):
        """`solid`, `liquid`: (k, c), `temperatures`: (wall, melting, start), density 1 in the ratio k/(rho c)."""
        (self.k, self.c, self.density), (k_l, c_l, _) = solid, liquid
        self.wall, self.melting, start = temperatures
        self.alpha = self.k / (self.density * self.c)
        alpha_l = k_l / (self.density * c_l)
        ratio = np.sqrt(self.alpha / alpha_l)
        stefan = self.c * (self.melting - self.wall) / latent

        def balance(x):
            hot = k_l / self.k * ratio * (start - self.melting) / (self.melting - self.wall)
            return (x * np.sqrt(np.pi) / stefan - np.exp(-x * x) / erf(x)
                    + hot * np.exp(-(ratio * x) ** 2) / max(1 - erf(ratio * x), 1e-300))

        self.root = bisect(balance, 1e-6, 5)

    def front(self, time):
        return 2 * self.root * np.sqrt(self.alpha * time)

    def heat(self, time):
        """To the wall [J/m²]."""
        return 2 * self.k * (self.melting - self.wall) / erf(self.root) * np.sqrt(time / (np.pi * self.alpha))


class Freezing:
    """The same where latent heat is freed over a range of temperatures. x/sqrt(t) = z alone matters: with the potential
    and the flux q = dTheta/dz the equation is dq = -rho z/2 dh. It is followed over temperature, from the wall's to that
    of the start, where the flux must end."""

    def __init__(self, material, density, wall, start):
        t = np.linspace(wall, start, 8001)
        self._t, self._rows = t, list(zip(np.diff(material.potential(t)), density * np.diff(material.enthalpy(t))))
        self.flux = bisect(lambda flux: 1 if self._places(flux) else -1, 1e3, 1e8)
        self._z = self._places(self.flux * (1 + 1e-9))

    def _places(self, flux):
        """z of each temperature; nothing where the flux ends before."""
        z, q, found = 0.0, flux, [0.0]
        for potential, heat in self._rows:
            ahead = q
            for _ in range(2):
                step = 2 * potential / (q + ahead)
                ahead = q - 0.5 * (z + 0.5 * step) * heat
                if ahead <= 0:
                    return []
            z, q = z + step, ahead
            found.append(z)
        return found

    def front(self, temperature, time):
        return float(np.interp(temperature, self._t, self._z)) * np.sqrt(time)

    def heat(self, time):
        """To the wall [J/m²]."""
        return 2 * self.flux * np.sqrt(time)


class Slab:
    """One dimension by finite volumes in enthalpy, from the bottom (cell 0) up; explicit steps.
    `enthalpy`, `potential`, `temperature_of`: h(T) [J/kg], Theta(T) [W/m], T(h)."""

    def __init__(self, height, cells, density, material):
        self.dx, self.density, self.material = height / cells, density, material
        self.height = (np.arange(cells) + 0.5) * self.dx
        self.lost_below = self.lost_above = 0.0

    def run(self, start, time, step, below, above):
        """`below`, `above`: heat flux [W/m²] out of a surface, by a callable of (temperature, potential) of its cell."""
        m = self.material
        h = np.full_like(self.height, m.enthalpy(start))
        steps = int(np.ceil(time / step))
        dt = time / steps
        for _ in range(steps):
            t = m.temperature(h)
            theta = m.potential(t)
            flux = np.zeros(len(h) + 1)  # upwards through the faces
            flux[1:-1] = -(theta[1:] - theta[:-1]) / self.dx
            down, up = below(t[0], theta[0], self.dx, dt), above(t[-1], theta[-1], self.dx, dt)
            flux[0], flux[-1] = -down, up
            h += dt * (flux[:-1] - flux[1:]) / (self.density * self.dx)
            self.lost_below += dt * down
            self.lost_above += dt * up
        self.temperature = m.temperature(h)
        return self


class Material:
    """Properties by rows of temperature [K] and value; solid fraction by rows as well."""

    def __init__(self, heat_capacity, conductivity, solid_fraction=(), latent=0.0):
        t = np.arange(200.0, 2600.0, 0.25)
        c, k = (np.interp(t, *np.array(rows).T) for rows in (heat_capacity, conductivity))
        phi = np.interp(t, *np.array(solid_fraction).T) if len(solid_fraction) else np.zeros_like(t)
        rise = 0.5 * (c[1:] + c[:-1]) * np.diff(t) - latent * np.diff(phi)
        self._t, self._phi = t, phi
        self._h = np.concatenate([[0], np.cumsum(rise)])
        self._theta = np.concatenate([[0], np.cumsum(0.5 * (k[1:] + k[:-1]) * np.diff(t))])

    def enthalpy(self, t):
        return np.interp(t, self._t, self._h)

    def temperature(self, h):
        return np.interp(h, self._h, self._t)

    def potential(self, t):
        return np.interp(t, self._t, self._theta)

    def solid(self, t):
        return np.interp(t, self._t, self._phi)


def surface_loss(material, emissivity, transfer, ambient):
    """Through half a cell to a surface that radiates and convects."""
    def flux(t, theta, dx, _dt):
        def given(surface):
            return emissivity * STEFAN_BOLTZMANN * (surface**4 - ambient**4) + transfer * (surface - ambient)
        low, high = min(ambient, t), max(ambient, t)
        for _ in range(40):
            middle = 0.5 * (low + high)
            conducted = (theta - material.potential(middle)) / (0.5 * dx)
            low, high = (middle, high) if conducted > given(middle) else (low, middle)
        return given(0.5 * (low + high))
    return flux


class ThickWall:
    """A wall of 300 mm by finite volumes that grow from 20 µm on, implicit, behind a contact resistance."""

    def __init__(self, conductivity, density, heat_capacity, start, contact):
        self.dx = 2e-5 * 1.05 ** np.arange(130)
        self.k, self.heat, self.contact = conductivity, density * heat_capacity, contact
        self.t = np.full(len(self.dx), float(start))

    def loss(self, material):
        def flux(t, theta, dx, dt):
            touch = self.t[0]
            for _ in range(6):
                k = (theta - material.potential(touch)) / (t - touch) if abs(t - touch) > 1e-6 else 1.0
                resistance = 0.5 * dx / k + 1 / self.contact + 0.5 * self.dx[0] / self.k
                q = (t - self.t[0]) / resistance
                touch = t - q * 0.5 * dx / k
            self._advance(q, dt)
            return q
        return flux

    def _advance(self, q, dt):
        n = len(self.dx)
        g = self.k / (0.5 * (self.dx[1:] + self.dx[:-1]))
        capacity = self.heat * self.dx / dt
        lower, upper = np.zeros(n), np.zeros(n)
        lower[1:], upper[:-1] = -g, -g
        diagonal = capacity - lower - upper
        right = capacity * self.t
        right[0] += q
        for i in range(1, n):  # Thomas
            w = lower[i] / diagonal[i - 1]
            diagonal[i] -= w * upper[i - 1]
            right[i] -= w * right[i - 1]
        t = np.empty(n)
        t[-1] = right[-1] / diagonal[-1]
        for i in range(n - 2, -1, -1):
            t[i] = (right[i] - upper[i] * t[i + 1]) / diagonal[i]
        self.t = t


def couette_with_friction(nahme):
    """eta = eta0 exp(-b (T - T0)), walls at T0: (stress over eta0 U/H, b times the largest warming)."""
    c = np.arcsinh(np.sqrt(nahme / 8))
    return float(2 * c / np.sinh(2 * c)), float(2 * np.log(np.cosh(c)))


def poiseuille_with_viscosity(height, viscosity, push):
    """u(y) between walls at y = 0 and y[-1] for a viscosity at each of the heights [m], [Pa s], under `push` [Pa/m]."""
    inverse = 1 / viscosity
    def integral(f):
        return np.concatenate([[0], np.cumsum(0.5 * (f[1:] + f[:-1]) * np.diff(height))])
    moment, plain = integral(height * inverse), integral(inverse)
    return push * (moment[-1] / plain[-1] * plain - moment)


def poiseuille_with_yield(height, viscosity, yield_stress, push):
    """The same with a yield stress [Pa] at each height: flows where push |y* - y| is above it, y* such that u is 0 again."""
    def slope(middle):
        stress = push * (middle - height)
        return np.sign(stress) * np.maximum(abs(stress) - yield_stress, 0) / viscosity
    def u(middle):
        f = slope(middle)
        return np.concatenate([[0], np.cumsum(0.5 * (f[1:] + f[:-1]) * np.diff(height))])
    return u(bisect(lambda middle: u(middle)[-1], height[0], height[-1]))


def film_start(height, depth, viscosity, density, push, time):
    """u(y) of a Newtonian film that starts from rest under `push` [m/s²]."""
    nu = viscosity / density
    steady = push / nu * (depth * height - 0.5 * height**2)
    for n in range(200):
        z = (n + 0.5) * np.pi
        steady = steady - 2 * push * depth**2 / (nu * z**3) * np.sin(z * height / depth) * np.exp(-z * z * nu * time / depth**2)
    return steady
