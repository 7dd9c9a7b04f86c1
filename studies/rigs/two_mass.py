#!/usr/bin/env python3
"""Another integration of the drops in this folder: two masses on a vertical line, fourth-order
Runge-Kutta with a fixed step, nothing shared with the program. The `derived` references of the
study files are what this prints.

    python3 two_mass.py            every case, with half the step beside it

Downward from first touch: x of the upper mass M, y of the unsprung mass m; stroke s = x - y.
    M x'' = M g - L - F_s(s, s')        m y'' = m g + F_s(s, s') - F_t(y, y')
"""
import math
import sys

FOOT, INCH, POUND = 0.3048, 0.0254, 0.45359237
LBF = POUND * 9.80665


def interpolate(rows, x):
    """Straight lines through rows; end values hold beyond the ends."""
    if x <= rows[0][0]:
        return rows[0][1]
    for (x0, y0), (x1, y1) in zip(rows, rows[1:]):
        if x < x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return rows[-1][1]


def sign(rate, speed):
    return math.tanh(rate / speed)


class Strut:
    """Gas (one or two chambers, each with its own exponent), oil, seals, stop."""

    def __init__(self, area, p0, v0, n, oil_area, rho, zeta, orifices, stop, second=None,
                 recoil=None, seal=0.0, ambient=0.0, seal_speed=1e-3):
        self.area, self.p0, self.v0, self.n = area, p0, v0, n
        self.oil, self.orifices, self.stop = 0.5 * rho * zeta * oil_area ** 3, orifices, stop
        self.second, self.recoil, self.rho = second, recoil, rho
        self.seal, self.ambient, self.seal_speed = seal, ambient, seal_speed

    def pressure(self, s):
        def first(extra):  # first chamber when the second has given `extra` room
            room = self.v0 - self.area * s + extra
            return self.p0 * (self.v0 / room) ** self.n if room > 0 else math.inf
        if not self.second or first(0.0) <= self.second[0]:
            return first(0.0)
        p2, v2, n2 = self.second
        low, high = 0.0, v2 * (1 - 1e-12)
        for _ in range(60):  # room given by the second chamber: one pressure in both
            extra = 0.5 * (low + high)
            if first(extra) > p2 * (v2 / (v2 - extra)) ** n2:
                low = extra
            else:
                high = extra
        return first(0.5 * (low + high))

    def force(self, s, v):
        gas = self.area * (self.pressure(s) - self.ambient)
        oil = self.oil / interpolate(self.orifices, s) ** 2 * v * abs(v)
        if self.recoil and v < 0:
            zeta, area, orifice = self.recoil
            oil += 0.5 * self.rho * zeta * area ** 3 / orifice ** 2 * v * abs(v)
        return gas + oil + min(self.stop * s, 0.0) + self.seal * gas * sign(v, self.seal_speed)


class LinearStrut:
    def __init__(self, stiffness, stop=0.0):
        self.stiffness, self.stop = stiffness, stop

    def force(self, s, v):
        return self.stiffness * s if s > 0 else self.stop * s


class Tyre:
    """F = d^2 / (C1 + C2 d / p) of each tyre (N, mm, MPa), damping 2 zeta sqrt(m f')."""

    def __init__(self, c1, c2, p, count, zeta=0.0, mass=0.0, one_way=False):
        self.c1, self.c2, self.count = c1, c2 / p, count
        self.zeta, self.mass, self.one_way = zeta, mass, one_way

    def load(self, y):
        d = max(1e3 * y, 0.0)
        return self.count * d * d / (self.c1 + self.c2 * d)

    def stiffness(self, y):
        d = max(1e3 * y, 0.0)
        q = self.c1 + self.c2 * d
        return 1e3 * self.count * (2 * d * q - self.c2 * d * d) / (q * q)

    def force(self, y, v):
        if y <= 0:
            return 0.0
        c = 2 * self.zeta * math.sqrt(self.mass * self.stiffness(y))
        return max(self.load(y) + c * (max(v, 0.0) if self.one_way else v), 0.0)


class PointsTyre:
    """Straight lines between measured points."""

    def __init__(self, rows):
        self.rows = [(0.0, 0.0)] + rows

    def load(self, y):
        return interpolate(self.rows, y)

    def force(self, y, v):
        return self.load(y) if y > 0 else 0.0


class PowerTyre:
    def __init__(self, load, diameter, power):
        self.scale, self.power = load / diameter ** power, power

    def force(self, y, v):
        return self.scale * y ** self.power if y > 0 else 0.0


def drop(strut, tyre, upper, lower, sink, lift, gravity=9.80665, end=0.4, step=1e-5):
    def slope(state):
        x, y, u, w = state
        fs, ft = strut.force(x - y, u - w), tyre.force(y, w)
        return (u, w, gravity - (lift + fs) / upper, gravity + (fs - ft) / lower)

    # as it falls: the stop carries gas and what the lower mass feels of the lift
    s = 0.0
    if strut.stop > 0:
        hang = lower * lift / (upper + lower)
        for _ in range(50):
            s -= (strut.force(s, 0.0) + hang) / strut.stop
    state = (s, 0.0, sink, sink)
    most = dict(stroke=0.0, sinkage=0.0, tyre=0.0, ground=0.0, strut=0.0)
    for _ in range(round(end / step)):
        a = slope(state)
        b = slope(tuple(q + 0.5 * step * d for q, d in zip(state, a)))
        c = slope(tuple(q + 0.5 * step * d for q, d in zip(state, b)))
        d = slope(tuple(q + step * e for q, e in zip(state, c)))
        state = tuple(q + step / 6 * (i + 2 * j + 2 * k + m)
                      for q, i, j, k, m in zip(state, a, b, c, d))
        x, y, u, w = state
        most["stroke"] = max(most["stroke"], x - y)
        most["sinkage"] = max(most["sinkage"], x - s)
        most["tyre"] = max(most["tyre"], y)
        most["ground"] = max(most["ground"], tyre.force(y, w))
        most["strut"] = max(most["strut"], strut.force(x - y, u - w))
    return most


def mm2(value):
    return value * 1e-6


def main_gear(friction=0.07, one_way=False, energy=242e3):
    strut = Strut(area=math.pi / 4 * 0.190 ** 2, p0=4.4e6, v0=17.88e-3, n=1.0,
                  oil_area=mm2(19400), rho=800.0, zeta=2.1, stop=1e8, seal=friction,
                  orifices=[(0.0, mm2(470)), (0.230, mm2(470)), (0.237, mm2(320)),
                            (0.500, mm2(320))],
                  recoil=(1.7, mm2(6280), mm2(22)))
    tyre = Tyre(8.469e-3, 5.346e-4, 1.15, 2, zeta=0.15, mass=2 * 517.0, one_way=one_way)
    return dict(strut=strut, tyre=tyre, upper=33390.0, lower=517.0,
                sink=math.sqrt(2 * energy / 33907.0), lift=33390.0 * 9.81, gravity=9.81, end=0.6)


def nose_gear(energy, one_way=False):
    strut = Strut(area=math.pi / 4 * (0.150 ** 2 - 0.088 ** 2), p0=1.1e6, v0=3.63e-3, n=1.1,
                  oil_area=mm2(13270), rho=800.0, zeta=2.1, stop=1e7, seal=0.07,
                  orifices=[(0.0, mm2(320))], second=(7.7e6, 1.7e-3, 1.3),
                  recoil=(1.7, mm2(2300), mm2(19)))
    tyre = Tyre(9.59e-3, 9.285e-4, 1.05, 2, zeta=0.10, mass=2 * 130.0, one_way=one_way)
    return dict(strut=strut, tyre=tyre, upper=13200.0, lower=130.0,
                sink=math.sqrt(2 * energy / 13330.0), lift=13200.0 * 9.81, gravity=9.81, end=0.6)


GOODYEAR = [(0.535, 270), (0.910, 530), (1.180, 740), (1.300, 840), (1.460, 980), (1.650, 1160),
            (1.840, 1345), (2.020, 1525), (2.210, 1725), (2.455, 2000), (2.670, 2250),
            (2.825, 2500), (2.895, 2700)]


def light_leg(tyre_lb):
    """The leaf-spring leg of the energy balance."""
    g = 32.174 * FOOT
    pound_force = POUND * g
    tyre = PointsTyre([(d * INCH, f * pound_force) for d, f in GOODYEAR])
    return dict(strut=LinearStrut(2158.3 * pound_force / FOOT), tyre=tyre,
                upper=(600 - tyre_lb) * POUND, lower=tyre_lb * POUND, sink=7 * FOOT,
                lift=400 * pound_force, gravity=g, end=0.25)


CASES = {
    "open_main_242kJ": (main_gear(), 2e-5),
    "open_main_242kJ_damping_one_way": (main_gear(one_way=True), 2e-5),
    "open_main_242kJ_no_seal_friction": (main_gear(friction=0.0), 2e-5),
    "open_nose_63kJ": (nose_gear(63e3), 2e-5),
    "open_nose_163kJ": (nose_gear(163e3), 2e-5),
    "open_nose_163kJ_damping_one_way": (nose_gear(163e3, True), 2e-5),
    "light_leg_5lb": (light_leg(5.0), 2e-5),
    "light_leg_0.01lb": (light_leg(0.01), 1e-5),
}


def main():
    wanted = sys.argv[1:] or list(CASES)
    print(f"{'case':34} {'step, s':>8} {'stroke, m':>10} {'sinkage, m':>10} {'tyre, m':>10} "
          f"{'ground, N':>10} {'strut, N':>10}")
    for name in wanted:
        case, step = CASES[name]
        for h in (step, 0.5 * step):
            r = drop(step=h, **case)
            print(f"{name:34} {h:8.1e} {r['stroke']:10.6f} {r['sinkage']:10.6f} "
                  f"{r['tyre']:10.6f} {r['ground']:10.1f} {r['strut']:10.1f}")


if __name__ == "__main__":
    main()
