"""Rigid bodies of a URDF whose links form one chain: the forces that a motion needs (recursive Newton-Euler), for many samples at once.

Used by the regressions of this repository. Quantities are in the world's frame; q, v, a have one row for each sample, one column for each
joint in the chain's order.
"""

import xml.etree.ElementTree as xml

import numpy as np

NEXT, LAST = [1, 2, 0], [2, 0, 1]


def numbers(text):
    return np.array([float(x) for x in text.split()])


class Chain:
    def __init__(self, path, gravity):
        root = xml.parse(path).getroot()
        links = {link.get("name"): link for link in root.findall("link")}
        by_parent = {joint.find("parent").get("link"): joint for joint in root.findall("joint")}
        self.gravity = np.array([0.0, 0.0, -gravity])
        self.joints, self.bodies, at = [], [], "world"
        while at in by_parent:
            joint = by_parent[at]
            at = joint.find("child").get("link")
            self.joints.append((joint.get("name"), joint.get("type") == "prismatic", numbers(joint.find("axis").get("xyz")),
                                numbers(joint.find("origin").get("xyz")), from_roll_pitch_yaw(joint.find("origin").get("rpy"))))
            self.bodies.append(self.body(at, links[at].find("inertial")))
        self.names = [joint[0] for joint in self.joints]

    @staticmethod
    def body(name, inertial):
        if inertial is None:
            return {"name": name, "mass": 0.0, "center": np.zeros(3), "inertia": np.zeros((3, 3))}
        inertia = {k: float(v) for k, v in inertial.find("inertia").attrib.items()}
        matrix = np.array([[inertia["ixx"], inertia["ixy"], inertia["ixz"]], [inertia["ixy"], inertia["iyy"], inertia["iyz"]],
                           [inertia["ixz"], inertia["iyz"], inertia["izz"]]])
        return {"name": name, "mass": float(inertial.find("mass").get("value")),
                "center": numbers(inertial.find("origin").get("xyz")), "inertia": matrix}

    def poses(self, q):
        """Rotation, origin and axis of each link's frame."""
        rotation, origin, out = np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3)), []
        for j, (_, slides, axis, offset, mounting) in enumerate(self.joints):
            origin = origin + rotation @ offset
            rotation = rotation @ mounting
            world_axis = rotation @ axis
            if slides:
                origin = origin + world_axis * q[:, j:j + 1]
            else:
                rotation = rotation @ turn(axis, q[:, j])
            out.append((rotation, origin, world_axis))
        return out

    def point(self, q, link, point):
        """Where a point of a link is."""
        names = [body["name"] for body in self.bodies]
        rotation, origin, _ = self.poses(q)[names.index(link)]
        return origin + rotation @ np.array(point)

    def needed(self, q, v, a, bodies=None):
        """Generalised forces that the motion needs."""
        bodies = bodies or self.bodies
        poses, zero = self.poses(q), np.zeros((len(q), 3))
        omega, alpha, acceleration, previous, loads = zero, zero, zero - self.gravity, zero, []
        for j, ((_, slides, *_), body) in enumerate(zip(self.joints, bodies)):
            rotation, origin, axis = poses[j]
            arm = origin - previous
            acceleration = acceleration + cross(alpha, arm) + cross(omega, cross(omega, arm))
            speed, rate = axis * v[:, j:j + 1], axis * a[:, j:j + 1]
            if slides:
                acceleration = acceleration + rate + 2.0 * cross(omega, speed)
            else:
                alpha = alpha + rate + cross(omega, speed)
                omega = omega + speed
            previous = origin
            center = rotation @ body["center"]
            force = body["mass"] * (acceleration + cross(alpha, center) + cross(omega, cross(omega, center)))
            inertia = rotation @ body["inertia"] @ np.swapaxes(rotation, 1, 2)
            moment = times(inertia, alpha) + cross(omega, times(inertia, omega))
            loads.append((force, moment + cross(origin + center, force)))
        return self.at_joints(poses, loads)

    def at_joints(self, poses, loads):
        """Sums forces and moments (about the world's origin) from the tip, and takes each joint's part."""
        out, force, moment = [], 0.0, 0.0
        for j in reversed(range(len(self.joints))):
            _, origin, axis = poses[j]
            force, moment = force + loads[j][0], moment + loads[j][1]
            part = force if self.joints[j][1] else moment - cross(origin, force)
            out.append(np.sum(axis * part, axis=1))
        return np.stack(out[::-1], axis=1)

    def changed(self, link, mass=0.0, moment=None, inertia=0.0):
        """needed() is linear in mass, mass times centre and inertia about the joint: bodies that have only the given ones."""
        out = []
        for body in self.bodies:
            mine = body["name"] == link
            center = np.zeros(3) if moment is None or not mine or not mass else np.array(moment) / mass
            out.append({"name": body["name"], "mass": mass if mine else 0.0, "center": center,
                        "inertia": inertia * np.eye(3) if mine else np.zeros((3, 3))})
        return out


def cross(one, other):
    return one[:, NEXT] * other[:, LAST] - one[:, LAST] * other[:, NEXT]


def times(matrices, vectors):
    return np.einsum("tij,tj->ti", matrices, vectors)


def from_roll_pitch_yaw(text):
    """Of a URDF's origin: turns about the fixed x, y and z axes, in this order."""
    roll, pitch, yaw = numbers(text) if text else np.zeros(3)
    x, y, z = (turn(axis, np.array([angle]))[0] for axis, angle in zip(np.eye(3), (roll, pitch, yaw)))
    return z @ y @ x


def turn(axis, angles):
    """Rotations about an axis (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    s, c = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + s * cross + (1.0 - c) * (cross @ cross)
