"""The machines of the benchmark: equations of motion by hand, in SI units.

Every machine gives  M(q) a + h(q, v) = f : the mass matrix of its links, h with the forces of inertia and of gravity, and f, what
drives, friction, springs and the ground put on the joints. Rotors are added by the world (world.py): a rotor of inertia J behind a
ratio N has the kinetic energy (N v)^2 J / 2 with the joint's speed v.

Links hang down (-z) at q = 0 and turn about +y. Gravity g points along -z; a tilt turns it by an angle about y.
"""

import math

GRAVITY = 9.80665  # m/s^2


def with_payload(link, mass, distance):
    """A link with a point mass at a distance from its joint: masses add, moments add, Huygens and Steiner for the inertia."""
    total = link["mass"] + mass
    center = (link["mass"] * link["center"] + mass * distance) / total
    inertia = (link["inertia"] + link["mass"] * (link["center"] - center) ** 2 + mass * (distance - center) ** 2)
    return dict(link, mass=total, center=center, inertia=inertia)


class Pendulum:
    """One link on a geared drive.

    Lagrange: T = (I + m c^2) v^2 / 2, V = -m g c cos(q + tilt)  =>  (I + m c^2) a + m g c sin(q + tilt) = f.
    """

    name = "pendulum"
    title = "A pendulum on a geared drive"
    joints = ("shoulder",)
    links = {"shoulder": "arm"}
    sliding = ()
    stated = {
        "links": {"arm": {"mass": 1.1, "center": 0.22, "inertia": 0.016, "length": 0.4}},
        "drives": {"shoulder": {"ratio": 40.0, "rotor_inertia": 2.5e-5, "damping": 0.06}},
    }

    def __init__(self, numbers, tilt=0.0):
        arm = numbers["links"]["arm"]
        self.inertia = arm["inertia"] + arm["mass"] * arm["center"] ** 2
        self.moment = arm["mass"] * arm["center"] * GRAVITY
        self.tilt = tilt

    def equations(self, q, v):
        return ((self.inertia,),), (self.moment * math.sin(q[0] + self.tilt),)

    def energy(self, q, v):
        return 0.5 * self.inertia * v[0] ** 2 - self.moment * math.cos(q[0] + self.tilt)


class Arm:
    """Two links in a vertical plane, each on a geared drive. q2 is the angle of the elbow, relative to the upper arm.

    Centres of mass move with  p1' = c1 v1  and  p2'^2 = L^2 v1^2 + c2^2 (v1 + v2)^2 + 2 L c2 cos(q2) v1 (v1 + v2). Hence
    M11 = I1 + m1 c1^2 + I2 + m2 (L^2 + c2^2 + 2 L c2 cos q2),  M12 = I2 + m2 (c2^2 + L c2 cos q2),  M22 = I2 + m2 c2^2,
    h1 = -m2 L c2 sin(q2) (2 v1 v2 + v2^2) + (m1 c1 + m2 L) g sin(q1 + tilt) + m2 c2 g sin(q1 + q2 + tilt),
    h2 =  m2 L c2 sin(q2) v1^2 + m2 c2 g sin(q1 + q2 + tilt).
    """

    name = "arm"
    title = "A geared arm of two joints in a vertical plane"
    joints = ("shoulder", "elbow")
    links = {"shoulder": "upper", "elbow": "fore"}
    sliding = ()
    stated = {
        "links": {"upper": {"mass": 1.6, "center": 0.14, "inertia": 0.014, "length": 0.3},
                  "fore": {"mass": 0.9, "center": 0.13, "inertia": 0.007, "length": 0.28}},
        "drives": {"shoulder": {"ratio": 50.0, "rotor_inertia": 3.0e-5, "damping": 0.12},
                   "elbow": {"ratio": 30.0, "rotor_inertia": 2.0e-5, "damping": 0.05}},
    }

    def __init__(self, numbers, tilt=0.0):
        upper, fore = numbers["links"]["upper"], numbers["links"]["fore"]
        self.tilt = tilt
        self.m22 = fore["inertia"] + fore["mass"] * fore["center"] ** 2
        self.coupling = fore["mass"] * upper["length"] * fore["center"]
        self.m11 = (upper["inertia"] + upper["mass"] * upper["center"] ** 2 + fore["mass"] * upper["length"] ** 2 + self.m22)
        self.moment1 = GRAVITY * (upper["mass"] * upper["center"] + fore["mass"] * upper["length"])
        self.moment2 = GRAVITY * fore["mass"] * fore["center"]

    def equations(self, q, v):
        cosine, sine = self.coupling * math.cos(q[1]), self.coupling * math.sin(q[1])
        weight2 = self.moment2 * math.sin(q[0] + q[1] + self.tilt)
        m12 = self.m22 + cosine
        h1 = -sine * (2.0 * v[0] * v[1] + v[1] ** 2) + self.moment1 * math.sin(q[0] + self.tilt) + weight2
        return ((self.m11 + 2.0 * cosine, m12), (m12, self.m22)), (h1, sine * v[0] ** 2 + weight2)

    def energy(self, q, v):
        mass, _ = self.equations(q, v)
        kinetic = 0.5 * (mass[0][0] * v[0] ** 2 + 2.0 * mass[0][1] * v[0] * v[1] + mass[1][1] * v[1] ** 2)
        return (kinetic - self.moment1 * math.cos(q[0] + self.tilt) - self.moment2 * math.cos(q[0] + q[1] + self.tilt))


class Hopper:
    """A body on a vertical rail (z, up) and a foot on a leg (s, down from the body), with a spring beside the leg's drive.

    T = mb z'^2 / 2 + mf (z' - s')^2 / 2, V = mb g z + mf g (z - s)  =>  M = [[mb + mf, -mf], [-mf, mf]],
    h = [(mb + mf) g, -mf g]. The toe is at z - length - s; the ground's force F is F on z and -F on s.
    """

    name = "hopper"
    title = "A hopper on a vertical rail, with a driven leg and a spring beside the drive"
    joints = ("rail", "leg")
    links = {"rail": "body", "leg": "foot"}
    sliding = ("rail", "leg")
    stated = {
        "links": {"body": {"mass": 5.0}, "foot": {"mass": 0.5}},
        "drives": {"leg": {"ratio": 50.0, "rotor_inertia": 1.0e-4, "damping": 12.0}},
        "springs": {"leg": {"stiffness": 3000.0, "rest": 0.018}},
        "ground": {"toe": {"stiffness": 1.0e6, "damping": 3.0e5, "exponent": 1.5, "length": 0.4}},
    }

    def __init__(self, numbers, tilt=0.0):
        self.body, self.foot = (numbers["links"][name]["mass"] for name in ("body", "foot"))
        self.ground = numbers["ground"]["toe"]
        self.cosine = math.cos(tilt)

    def equations(self, q, v):
        weight = GRAVITY * self.cosine
        return (((self.body + self.foot, -self.foot), (-self.foot, self.foot)),
                ((self.body + self.foot) * weight, -self.foot * weight))

    def ground_force(self, q, v):
        """Hunt and Crossley: depth^n (k + c rate), never pulling."""
        depth = self.ground["length"] + q[1] - q[0] + self.ground.get("height", 0.0)
        if depth <= 0.0:
            return 0.0
        rate = v[1] - v[0]
        return max(0.0, depth ** self.ground["exponent"] * (self.ground["stiffness"] + self.ground["damping"] * rate))

    def ground_forces(self, q, v):
        normal = self.ground_force(q, v)
        return [normal, -normal]

    def energy(self, q, v):
        kinetic = 0.5 * self.body * v[0] ** 2 + 0.5 * self.foot * (v[0] - v[1]) ** 2
        return kinetic + GRAVITY * self.cosine * (self.body * q[0] + self.foot * (q[0] - q[1]))


class Cube:
    """A cube that is dropped onto a table, in a vertical plane: x (along), z (up) of its middle, and its angle.

    The centre of mass is c below the middle: X = x - c sin(turn), Z = z - c cos(turn). With T = m (X'^2 + Z'^2) / 2 + I turn'^2 / 2 and
    gravity g (sin(tilt), -cos(tilt)):  M = [[m, 0, -m c cos], [0, m, m c sin], [-m c cos, m c sin, I + m c^2]],
    h = [m c sin turn'^2 - m g sin(tilt), m c cos turn'^2 + m g cos(tilt), m g c sin(turn + tilt)].

    A corner at r = (rx, rz) from the middle has the speed (x' + turn' rz, z' - turn' rx). The table's force on it is the normal force
    N = depth^n (k + d rate), never pulling, and -mu N tanh(slip / slip_scale) along the table.
    """

    name = "cube"
    title = "A cube that is dropped onto a table, in a vertical plane"
    joints = ("along", "up", "turn")
    links = {"along": "slide", "up": "lift", "turn": "cube"}
    sliding = ("along", "up")
    half = 0.0524
    stated = {
        "links": {"cube": {"mass": 0.37, "center": 0.0, "inertia": 6.8e-4}},
        "drives": {},
        "ground": {"table": {"stiffness": 2.0e5, "damping": 1.2e5, "exponent": 1.5, "friction": 0.3, "slip_scale": 0.02}},
    }

    def __init__(self, numbers, tilt=0.0):
        cube = numbers["links"]["cube"]
        self.mass, self.center, self.inertia = cube["mass"], cube["center"], cube["inertia"]
        self.ground = numbers["ground"]["table"]
        self.tilt = tilt

    @classmethod
    def corners(cls):
        return [(sx * cls.half, sz * cls.half) for sx in (-1, 1) for sz in (-1, 1)]

    def equations(self, q, v):
        moment = self.mass * self.center
        sine, cosine = moment * math.sin(q[2]), moment * math.cos(q[2])
        mass = ((self.mass, 0.0, -cosine), (0.0, self.mass, sine), (-cosine, sine, self.inertia + moment * self.center))
        return mass, (sine * v[2] ** 2 - self.mass * GRAVITY * math.sin(self.tilt),
                      cosine * v[2] ** 2 + self.mass * GRAVITY * math.cos(self.tilt),
                      moment * GRAVITY * math.sin(q[2] + self.tilt))

    def ground_forces(self, q, v):
        """Generalised forces of the table on all corners."""
        ground, out = self.ground, [0.0, 0.0, 0.0]
        sine, cosine = math.sin(q[2]), math.cos(q[2])
        for px, pz in self.corners():
            rx, rz = px * cosine + pz * sine, pz * cosine - px * sine
            depth = ground.get("height", 0.0) - q[1] - rz
            if depth > 0.0:
                rate = rx * v[2] - v[1]
                normal = max(0.0, depth ** ground["exponent"] * (ground["stiffness"] + ground["damping"] * rate))
                friction = -ground["friction"] * normal * math.tanh((v[0] + rz * v[2]) / ground["slip_scale"])
                out = [out[0] + friction, out[1] + normal, out[2] + friction * rz - normal * rx]
        return out

    def energy(self, q, v):
        mass, _ = self.equations(q, v)
        kinetic = 0.5 * sum(v[i] * mass[i][j] * v[j] for i in range(3) for j in range(3))
        height = (q[1] - self.center * math.cos(q[2])) * math.cos(self.tilt) - (q[0] - self.center * math.sin(q[2])) * math.sin(self.tilt)
        return kinetic + self.mass * GRAVITY * height

    def stored(self, q):
        """Of the table's springs."""
        n = self.ground["exponent"] + 1.0
        depths = (-q[1] + px * math.sin(q[2]) - pz * math.cos(q[2]) for px, pz in self.corners())
        return sum(self.ground["stiffness"] * max(0.0, depth) ** n / n for depth in depths)


class Leg:
    """A leg on a bench: hip and knee on geared drives, a foot on an ankle with a spring and no drive, in a vertical plane.

    With the links' angles against the vertical a1 = q1, a2 = q1 + q2, a3 = q1 + q2 + q3 and what hangs below each joint,
    A_ii = I_i + m_i c_i^2 + L_i^2 (sum of m below),  A_ij = L_i (m_j c_j + L_j (sum of m below j)) for i < j,  B_i = m_i c_i + L_i (sum of m below):
    T = sum A_ij cos(a_i - a_j) a_i' a_j' / 2, V = -g sum B_i cos(a_i + tilt). Lagrange in the angles gives
    sum_j A_ij (cos(a_i - a_j) a_j'' + sin(a_i - a_j) a_j'^2) + g B_i sin(a_i + tilt) = f_i, and a joint moves its own link and all below:
    row i of M and h in the joints is the sum of the rows i, i + 1, ... , and so are the columns of M.
    """

    name = "leg"
    title = "A leg on a bench: hip and knee on geared drives, a springy ankle"
    joints = ("hip", "knee", "ankle")
    links = {"hip": "thigh", "knee": "shin", "ankle": "foot"}
    sliding = ()
    stated = {
        "links": {"thigh": {"mass": 1.8, "center": 0.11, "inertia": 0.012, "length": 0.24},
                  "shin": {"mass": 0.8, "center": 0.1, "inertia": 0.005, "length": 0.24},
                  "foot": {"mass": 0.25, "center": 0.05, "inertia": 5.0e-4, "length": 0.1}},
        "drives": {"hip": {"ratio": 40.0, "rotor_inertia": 3.0e-5, "damping": 0.1},
                   "knee": {"ratio": 36.0, "rotor_inertia": 2.5e-5, "damping": 0.07}},
        "springs": {"ankle": {"stiffness": 1.2, "rest": 0.1}},
    }

    def __init__(self, numbers, tilt=0.0):
        links = [numbers["links"][self.links[joint]] for joint in self.joints]
        below = [sum(link["mass"] for link in links[i + 1:]) for i in range(3)]
        self.tilt = tilt
        self.moments = [link["mass"] * link["center"] + link["length"] * rest for link, rest in zip(links, below)]
        self.couplings = [[links[i]["length"] * self.moments[j] for j in range(3)] for i in range(3)]
        for i, link in enumerate(links):
            self.couplings[i][i] = link["inertia"] + link["mass"] * link["center"] ** 2 + link["length"] ** 2 * below[i]
            for j in range(i):
                self.couplings[i][j] = self.couplings[j][i]

    def equations(self, q, v):
        a = (q[0], q[0] + q[1], q[0] + q[1] + q[2])
        w = (v[0], v[0] + v[1], v[0] + v[1] + v[2])
        M = [[self.couplings[i][j] * math.cos(a[i] - a[j]) for j in range(3)] for i in range(3)]
        h = [sum(self.couplings[i][j] * math.sin(a[i] - a[j]) * w[j] ** 2 for j in range(3))
             + GRAVITY * self.moments[i] * math.sin(a[i] + self.tilt) for i in range(3)]
        rows = [[sum(M[k][j] for k in range(i, 3)) for j in range(3)] for i in range(3)]
        return ([[sum(row[k] for k in range(j, 3)) for j in range(3)] for row in rows], [sum(h[i:]) for i in range(3)])

    def energy(self, q, v):
        mass, _ = self.equations(q, v)
        kinetic = 0.5 * sum(v[i] * mass[i][j] * v[j] for i in range(3) for j in range(3))
        a = (q[0], q[0] + q[1], q[0] + q[1] + q[2])
        return kinetic - GRAVITY * sum(moment * math.cos(angle + self.tilt) for moment, angle in zip(self.moments, a))


MACHINES = {machine.name: machine for machine in (Pendulum, Arm, Hopper, Cube, Leg)}
