"""What a person does by hand: least squares of the torques with friction, rotor inertia, gain and offset of every drive.

Positions are smoothed and differentiated, the rigid bodies' forces follow by recursive Newton-Euler from the URDF as it is, and
    W' (g u - I a - f v - c sign(v) - b) = forces(q, v, a) + passive friction
is solved for the gains g, inertias I, friction f and c, and offsets b by numpy. W: motors' positions by joint. Nothing of Plumbline is used.
"""

import xml.etree.ElementTree as xml

import numpy as np


def numbers(text):
    return np.array([float(x) for x in text.split()])


def rotation(rpy):
    r, p, y = rpy
    about = [np.array([[1, 0, 0], [0, np.cos(r), -np.sin(r)], [0, np.sin(r), np.cos(r)]]),
             np.array([[np.cos(p), 0, np.sin(p)], [0, 1, 0], [-np.sin(p), 0, np.cos(p)]]),
             np.array([[np.cos(y), -np.sin(y), 0], [np.sin(y), np.cos(y), 0], [0, 0, 1]])]
    return about[2] @ about[1] @ about[0]


def pose(element):
    origin = element.find("origin") if element is not None else None
    if origin is None:
        return np.eye(3), np.zeros(3)
    return rotation(numbers(origin.get("rpy", "0 0 0"))), numbers(origin.get("xyz", "0 0 0"))


class Chain:
    """Links of a URDF in a row; what hangs on fixed joints is carried by the link before."""

    def __init__(self, path, gravity=9.80665):
        root = xml.parse(path).getroot()
        self.gravity = np.array([0.0, 0.0, gravity])
        self.names, self.axes, self.slides, self.frames, self.bodies = [], [], [], [], []
        links = {link.get("name"): link for link in root.findall("link")}
        children = {}
        for joint in root.findall("joint"):
            children.setdefault(joint.find("parent").get("link"), []).append(joint)
        moved = {joint.find("child").get("link") for joint in root.findall("joint")}
        root_link = next(name for name in [*links, *children] if name not in moved)  # a world may be named by joints alone
        self._walk(root_link, links, children, np.eye(3), np.zeros(3))

    def _walk(self, link, links, children, turned, offset):
        inertial = links[link].find("inertial") if link in links else None
        if self.names and inertial is not None:
            frame, center = pose(inertial)
            i = {key: float(value) for key, value in inertial.find("inertia").attrib.items()}
            inertia = np.array([[i["ixx"], i["ixy"], i["ixz"]], [i["ixy"], i["iyy"], i["iyz"]], [i["ixz"], i["iyz"], i["izz"]]])
            frame = turned @ frame
            self.bodies[-1].append((float(inertial.find("mass").get("value")), offset + turned @ center, frame @ inertia @ frame.T))
        for joint in children.get(link, []):
            frame, origin = pose(joint)
            child = joint.find("child").get("link")
            if joint.get("type") == "fixed":
                self._walk(child, links, children, turned @ frame, offset + turned @ origin)
                continue
            self.names.append(joint.get("name"))
            self.axes.append(numbers(joint.find("axis").get("xyz")))
            self.slides.append(joint.get("type") == "prismatic")
            self.frames.append((turned @ frame, offset + turned @ origin))
            self.bodies.append([])
            self._walk(child, links, children, np.eye(3), np.zeros(3))

    def forces(self, q, v, a):
        """Generalised forces, samples x joints, in the links' own frames (Featherstone 2008, 5.3)."""
        n = len(q)
        omega, alpha, linear, kept = np.zeros((n, 3)), np.zeros((n, 3)), np.tile(self.gravity, (n, 1)), []
        for j, axis in enumerate(self.axes):
            frame, origin = self.frames[j]
            turn = np.eye(3)[None] if self.slides[j] else turns(axis, q[:, j])
            to_parent = frame @ turn
            arm = origin + (frame @ axis) * q[:, j:j + 1] * self.slides[j]
            linear = linear + np.cross(alpha, arm) + np.cross(omega, np.cross(omega, arm))
            back = np.broadcast_to(np.swapaxes(to_parent, 1, 2), (n, 3, 3))
            omega, alpha, linear = (np.einsum("nij,nj->ni", back, x) for x in (omega, alpha, linear))
            speed, rate = axis * v[:, j:j + 1], axis * a[:, j:j + 1]
            if self.slides[j]:
                linear = linear + rate + 2.0 * np.cross(omega, speed)
            else:
                alpha = alpha + rate + np.cross(omega, speed)
                omega = omega + speed
            force, moment = np.zeros((n, 3)), np.zeros((n, 3))
            for mass, center, inertia in self.bodies[j]:
                f = mass * (linear + np.cross(alpha, center) + np.cross(omega, np.cross(omega, center)))
                force = force + f
                moment = moment + np.cross(center, f) + alpha @ inertia.T + np.cross(omega, omega @ inertia.T)
            kept.append((np.broadcast_to(to_parent, (n, 3, 3)), arm, force, moment))
        out = np.zeros((n, len(self.axes)))
        force, moment = np.zeros((n, 3)), np.zeros((n, 3))
        for j in reversed(range(len(self.axes))):
            to_parent, arm, own_force, own_moment = kept[j]
            force, moment = force + own_force, moment + own_moment
            out[:, j] = (force if self.slides[j] else moment) @ self.axes[j]
            force, moment = (np.einsum("nij,nj->ni", to_parent, x) for x in (force, moment))
            moment = moment + np.cross(arm, force)
        return out


def turns(axis, angles):
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + s * k + (1.0 - c) * (k @ k)


def smoothed(x, period, cutoff):
    """Columns low-passed without delay: a Gaussian whose gain is a half at the cutoff (Hz)."""
    sigma = np.sqrt(2.0 * np.log(2.0)) / (2.0 * np.pi * cutoff * period)
    reach = int(np.ceil(4.0 * sigma))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    padded = np.pad(x, ((reach, reach), (0, 0)), mode="edge")
    return np.stack([np.convolve(padded[:, i], weights / weights.sum(), mode="valid") for i in range(x.shape[1])], axis=1)


def identify(chain, motors, trials, cutoff=10.0):
    """motors: {motor: {joint: ratio}}; trials: [(period, positions {joint or motor: array}, commands {motor: array, SI})].

    Gives {motor: {"gain": g, "inertia": I, "viscous": f, "coulomb": c, "bias": -b}} and {passive joint: {"viscous", "coulomb"}}.
    """
    names = list(motors)
    W = np.array([[motors[m].get(j, 0.0) for j in chain.names] for m in names])
    passive = [j for j, joint in enumerate(chain.names) if not np.any(W[:, j])]
    rows = [[] for _ in chain.names]
    for period, positions, commands in trials:
        read = np.array([W[names.index(key)] if key in names else np.eye(len(chain.names))[chain.names.index(key)] for key in positions])
        raw = np.linalg.lstsq(read, np.array(list(positions.values())), rcond=None)[0].T
        q = smoothed(raw, period, cutoff)
        v = np.gradient(q, period, axis=0)
        a = np.gradient(v, period, axis=0)
        needed, u = chain.forces(q, v, a), np.array([commands[m] for m in names]).T
        speeds, rates = v @ W.T, a @ W.T
        columns = [[u[:, m], -rates[:, m], -speeds[:, m], -np.sign(speeds[:, m]), -np.ones(len(q))] for m in range(len(names))]
        edge = int(np.ceil(1.0 / cutoff / period))
        keep = slice(edge, len(q) - edge, max(1, int(0.25 / cutoff / period)))
        for j in range(len(chain.names)):
            parts = [W[m, j] * column for m in range(len(names)) for column in columns[m]]
            for p in passive:
                parts += [-v[:, p] * (p == j), -np.sign(v[:, p]) * (p == j)]
            table = smoothed(np.stack(parts + [needed[:, j]], axis=1), period, cutoff)[keep]
            rows[j].append(table)
    tables = [np.concatenate(one) for one in rows]
    # Where the rigid bodies need no force at all (a point mass on the axis) all values at zero would fit: the gain is one there.
    stated = [m for m in range(len(names)) if all(np.std(tables[j][:, -1]) < 1e-9 * np.std(tables[j][:, 5 * m]) for j in np.flatnonzero(W[m]))]
    for table in tables:
        for m in stated:
            table[:, -1] -= table[:, 5 * m]
            table[:, 5 * m] = 0.0
    weights = [1.0 / max(np.std(table[:, -1]), 1e-12) for table in tables]
    for _ in range(3):
        stacked = np.concatenate([w * table for w, table in zip(weights, tables)])
        values = np.linalg.lstsq(stacked[:, :-1], stacked[:, -1], rcond=None)[0]
        values[[5 * m for m in stated]] = 1.0
        weights = [1.0 / max(np.std(t[:, :-1] @ values - t[:, -1]), 1e-12) for t in tables]
    found = {m: dict(zip(["gain", "inertia", "viscous", "coulomb", "bias"], values[5 * i:5 * i + 5])) for i, m in enumerate(names)}
    for one in found.values():
        one["bias"] = -one["bias"]
    rest = values[5 * len(names):]
    loose = {chain.names[p]: {"viscous": rest[2 * i], "coulomb": rest[2 * i + 1]} for i, p in enumerate(passive)}
    return found, loose
