# SPDX-License-Identifier: MIT
"""Passivity controller, virtual coupling and predictive hold.

Hannaford & Ryu 2002: E_n = E_(n-1) - f_out(n-1).dp_n pairs each step with the force held during it;
E_n = E_(n-1) - f_n.dp_n + alpha_(n-1) |dp_(n-1)|^2 / T is the backward pairing;
Adams & Hannaford 1999: kc e + bc (e - e^-)/T = sigma x_v in the wall;
Ellis et al. 1997: 1.5 f_k - 0.5 f_(k-1).
"""

import table
import vec

ZERO = (0.0, 0.0, 0.0)
EPS_MOTION = 1e-9
PASSIVITY = {"position": ZERO, "force": ZERO, "contact": 1.0,
             "alpha_max": 0.0, "mass": 0.1, "pairing": "zoh"}
COUPLING = {"position": ZERO, "stiffness": 1000.0, "damping": 0.5,
            "normal": (0.0, 0.0, 1.0), "offset": 0.0, "wall_stiffness": 1e6}
HOLD = {"in": ZERO, "contact": None, "limit": 100.0}


def braking(params, feed, dt):
    energy, last = 0.0, None
    for k in range(table.rows(feed)):
        now = table.row(PASSIVITY, params, feed, k)
        p, f = now["position"], now["force"]
        if not vec.finite(p, f, now["contact"]):
            last = None
            yield {"force": ZERO, "energy": energy, "alpha": 0.0}
            continue
        dp, alpha = ZERO, 0.0
        if last:
            p0, f0, alpha0, dp0 = last
            dp = vec.sub(p, p0)
            if now["pairing"] == "zoh":
                energy -= vec.dot(f0, dp)
            else:
                energy += alpha0 * vec.dot(dp0, dp0) / dt - vec.dot(f, dp)
        if now["contact"] == 0.0:
            energy = 0.0
        if last and energy < 0.0 and vec.norm(dp) > EPS_MOTION:
            most = now["alpha_max"] or 0.5 * now["mass"] / dt
            alpha = min(-energy * dt / vec.dot(dp, dp), most)
        out = vec.sub(f, vec.scale(alpha / dt, dp))
        last = p, out, alpha, dp
        yield {"force": out, "energy": energy, "alpha": alpha}


def coupling_tick(dt):
    """A virtual coupling, evaluated tick by tick."""
    e = None

    def tick(now):
        nonlocal e
        p, n = now["position"], now["normal"]
        if not vec.finite(p, n):
            e = None
            return {"proxy": ZERO, "force": ZERO, "depth": 0.0, "state": -1}
        n = vec.unit(n)
        x, f, touches = now["offset"] - vec.dot(n, p), 0.0, False
        if e is None:
            e, touches = 0.0, x > 0.0
        else:
            kc, bc = now["stiffness"], now["damping"] / dt
            held, g = bc * e, kc + bc
            proxy = x - held / g
            touches = proxy > 0.0
            if touches:
                proxy = (g * x - held) / (g + now["wall_stiffness"])
                f = kc * (x - proxy) + bc * (x - proxy - e)
            e = x - proxy
        return {"proxy": vec.add(p, vec.scale(e, n)), "force": vec.scale(f, n),
                "depth": x, "state": 1 if touches else 0}

    return tick


def hold_steps(params, feed):
    before, contact = None, None
    for k in range(table.rows(feed)):
        now = table.row(HOLD, params, feed, k)
        f = now["in"]
        if not vec.finite(f) or (now["contact"] is not None
                                 and not vec.finite(now["contact"])):
            before = None
            yield {"out": ZERO}
            continue
        if now["contact"] != contact:
            before = None
        out = f
        if before:
            out = vec.sub(vec.scale(1.5, f), vec.scale(0.5, before))
        before, contact = f, now["contact"]
        if vec.norm(out) > now["limit"]:
            out = vec.scale(now["limit"] / vec.norm(out), out)
        yield {"out": out}


def passivity(params, feed, dt):
    return table.collect(braking(params, feed, dt))


def coupling(params, feed, dt):
    return table.each(coupling_tick(dt), COUPLING, params, feed)


def hold(params, feed):
    return table.collect(hold_steps(params, feed))
