#!/usr/bin/env python3
"""Makes robots/mabel/meshes/*.obj: MABEL's links as closed surfaces, for pictures only.

Lengths between joints are the paper's (thigh 0.5 m, shin 0.5 m, boom 2.25 m); everything across is drawn to look
like the robot and measured nowhere (robots/mabel/sources.md). No argument; writes the same bytes each time.
"""

import math
import pathlib

SIDES = 24  # of a circle


class Mesh:
    """Points and triangles, counter-clockwise seen from outside."""

    def __init__(self):
        self.points = []
        self.triangles = []

    def add(self, points, faces):
        first = len(self.points)
        self.points += points
        for face in faces:
            for k in range(1, len(face) - 1):
                self.triangles.append(tuple(first + i for i in (face[0], face[k], face[k + 1])))

    def write(self, path, words):
        lines = ["# " + words, "# made by scripts/make_mabel_meshes.py; m"]
        lines += ["v %.5g %.5g %.5g" % tuple(0.0 if abs(c) < 1e-9 else c for c in p) for p in self.points]
        lines += ["f %d %d %d" % tuple(i + 1 for i in t) for t in self.triangles]
        path.write_text("\n".join(lines) + "\n")


def prism(mesh, outline, low, high, axis="y"):
    """An outline (counter-clockwise in its plane) extruded along an axis from low to high, edges rounded off."""
    place = {"y": lambda u, v, w: (u, -w, v), "z": lambda u, v, w: (u, v, w)}[axis]
    if axis == "y":
        low, high = -high, -low
    bevel = min(0.004, 0.25 * (high - low))
    inner = shrunk(outline, bevel)
    rings = [(inner, low), (outline, low + bevel), (outline, high - bevel), (inner, high)]
    n = len(outline)
    points = [place(u, v, w) for ring, w in rings for u, v in ring]
    lid = ears(inner)
    faces = [t[::-1] for t in lid] + [tuple(3 * n + i for i in t) for t in lid]
    for r in range(3):
        for k in range(n):
            m = (k + 1) % n
            faces.append((r * n + k, r * n + m, (r + 1) * n + m, (r + 1) * n + k))
    mesh.add(points, faces)


def ears(outline):
    """Triangles of a simple polygon, counter-clockwise, by cutting off ears."""

    def cross(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    left = list(range(len(outline)))
    triangles = []
    while len(left) > 3:
        for k in range(len(left)):
            i, j, m = left[k - 1], left[k], left[(k + 1) % len(left)]
            a, b, c = outline[i], outline[j], outline[m]
            inside = any(cross(a, b, outline[o]) >= 0 and cross(b, c, outline[o]) >= 0 and cross(c, a, outline[o]) >= 0
                         for o in left if o not in (i, j, m))
            if cross(a, b, c) > 0 and not inside:
                triangles.append((i, j, m))
                del left[k]
                break
    return triangles + [tuple(left)]


def shrunk(outline, by):
    """Every corner moved inward along the bisector of its edges."""
    result = []
    n = len(outline)
    for k in range(n):
        a, b, c = outline[k - 1], outline[k], outline[(k + 1) % n]
        normal = [0.0, 0.0]
        for p, q in ((a, b), (b, c)):
            length = math.hypot(q[0] - p[0], q[1] - p[1])
            normal[0] -= (q[1] - p[1]) / length
            normal[1] += (q[0] - p[0]) / length
        size = math.hypot(*normal)
        result.append((b[0] + by * normal[0] / size, b[1] + by * normal[1] / size))
    return result


def circle(radius, u=0.0, v=0.0):
    return [(u + radius * math.cos(2 * math.pi * k / SIDES), v + radius * math.sin(2 * math.pi * k / SIDES))
            for k in range(SIDES)]


def bone(radius_top, radius_low, length, waist):
    """Two round ends joined by a waist, hanging from the origin; an outline in (x, z)."""
    half = SIDES // 2
    top = [(radius_top * math.cos(math.pi * k / half), radius_top * math.sin(math.pi * k / half))
           for k in range(half + 1)]
    low = [(radius_low * math.cos(math.pi + math.pi * k / half), -length + radius_low * math.sin(math.pi + math.pi * k / half))
           for k in range(half + 1)]
    left = [(-waist, -0.32 * length), (-waist, -0.75 * length)]
    right = [(waist, -0.75 * length), (waist, -0.32 * length)]
    return top + left + low + right


def turned(mesh, profile, axis):
    """A profile of (way along the axis, radius), closed at both ends, turned about x, y or z."""
    place = {
        "x": lambda s, a, b: (s, a, b),
        "y": lambda s, a, b: (b, s, a),
        "z": lambda s, a, b: (a, b, s),
    }[axis]
    points = [place(profile[0][0], 0.0, 0.0)]
    for s, r in profile:
        points += [place(s, a, b) for a, b in circle(r)]
    points.append(place(profile[-1][0], 0.0, 0.0))
    last = len(points) - 1
    faces = []
    for k in range(SIDES):
        m = (k + 1) % SIDES
        faces.append((0, 1 + m, 1 + k))
        for ring in range(len(profile) - 1):
            a = 1 + ring * SIDES
            faces.append((a + k, a + m, a + SIDES + m, a + SIDES + k))
        end = 1 + (len(profile) - 1) * SIDES
        faces.append((end + k, end + m, last))
    mesh.add(points, faces)


def disc(mesh, radius, low, high, x=0.0, z=0.0):
    """A wheel about the y axis."""
    prism(mesh, circle(radius, x, z), low, high)


def torso():
    """Two side plates, the drives between them and a mast; the hip axis is the origin."""
    mesh = Mesh()
    plate = [(-0.10, 0.05), (-0.055, -0.045), (0.055, -0.045), (0.10, 0.05), (0.125, 0.30), (0.085, 0.44),
             (-0.075, 0.44), (-0.115, 0.30)]
    for y in (-0.048, 0.034):
        prism(mesh, plate, y, y + 0.014)
    box = [(-0.085, 0.215), (0.095, 0.215), (0.105, 0.40), (-0.09, 0.40)]
    prism(mesh, box, -0.034, 0.034)
    for x, z, radius in ((-0.045, 0.10, 0.055), (0.06, 0.13, 0.045)):
        disc(mesh, radius, -0.034, 0.034, x, z)
    for side in (-1.0, 1.0):
        for x, z, radius in ((0.0, 0.325, 0.062), (-0.055, 0.065, 0.030), (0.055, 0.065, 0.030)):
            near, far = sorted((side * 0.048, side * 0.055))
            disc(mesh, radius, near, far, x, z)
            near, far = sorted((side * 0.055, side * 0.058))
            disc(mesh, 0.3 * radius, near, far, x, z)
    turned(mesh, [(0.44, 0.020), (0.56, 0.018), (0.57, 0.012)], "z")
    turned(mesh, [(-0.068, 0.030), (-0.062, 0.036), (0.062, 0.036), (0.068, 0.030)], "y")
    return mesh


def thigh():
    mesh = Mesh()
    prism(mesh, bone(0.062, 0.046, 0.5, 0.034), -0.024, 0.024)
    disc(mesh, 0.040, 0.024, 0.032)
    disc(mesh, 0.040, -0.032, -0.024)
    disc(mesh, 0.028, 0.024, 0.031, 0.0, -0.5)
    disc(mesh, 0.028, -0.031, -0.024, 0.0, -0.5)
    return mesh


def shin():
    mesh = Mesh()
    turned(mesh, [(-0.482, 0.012), (-0.47, 0.016), (-0.30, 0.020), (-0.10, 0.023), (-0.052, 0.024)], "z")
    disc(mesh, 0.052, -0.022, 0.022)
    turned(mesh, [(-0.030, 0.010), (-0.026, 0.018), (0.026, 0.018), (0.030, 0.010)], "y")
    toe = mesh.points[-2 - 4 * SIDES:]
    for k, point in enumerate(toe):
        mesh.points[len(mesh.points) - len(toe) + k] = (point[0], point[1], point[2] - 0.482)
    return mesh


def lever(radius, length, thick):
    mesh = Mesh()
    prism(mesh, bone(radius, 0.4 * radius, length, 0.35 * radius), -0.5 * thick, 0.5 * thick)
    return mesh


def boom():
    """From the tower's pivot along -y to the hip."""
    mesh = Mesh()
    turned(mesh, [(-2.16, 0.014), (-2.15, 0.020), (-0.06, 0.026), (-0.05, 0.020)], "y")
    turned(mesh, [(0.05, 0.030), (0.055, 0.055), (0.30, 0.055), (0.305, 0.045)], "y")
    return mesh


def tower():
    """Under the boom's pivot, 1 m high."""
    mesh = Mesh()
    turned(mesh, [(-1.0, 0.27), (-0.985, 0.28), (-0.97, 0.27), (-0.955, 0.10), (-0.90, 0.060), (-0.12, 0.050),
                  (-0.11, 0.075), (-0.062, 0.075), (-0.058, 0.06)], "z")
    for y in (-0.050, 0.030):
        prism(mesh, [(-0.045, -0.058), (0.045, -0.058), (0.045, 0.02), (0.02, 0.05), (-0.02, 0.05),
                     (-0.045, 0.02)], y, y + 0.018)
    return mesh


def main():
    folder = pathlib.Path(__file__).resolve().parent.parent / "robots" / "mabel" / "meshes"
    folder.mkdir(exist_ok=True)
    for name, mesh, words in (
        ("torso", torso(), "torso: plates, drives, mast; hip axis at the origin"),
        ("thigh", thigh(), "thigh: 0.5 m from hip to knee"),
        ("shin", shin(), "shin: 0.5 m from knee to toe"),
        ("cspring", lever(0.040, 0.22, 0.018), "C_Spring: a lever that hangs from its pivot"),
        ("cshin", lever(0.036, 0.17, 0.018), "C_Shin: a lever that hangs from its pivot"),
        ("boom", boom(), "boom: from the tower's pivot to the hip, with a counterweight"),
        ("tower", tower(), "tower: under the boom's pivot"),
    ):
        mesh.write(folder / (name + ".obj"), "MABEL, " + words)


if __name__ == "__main__":
    main()
