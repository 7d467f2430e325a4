"""What the quadruped is asked to do: targets of its twelve joints, from motions of its trunk over its feet."""

import numpy as np

from generator import quadruped as robot

SECONDS = {"train": 6.0, "validation": 6.0, "test": 2.0}
HEIGHT, DROP = 0.28, 0.002  # m, of the trunk's middle while it stands; of the feet's air at the start
FULL = np.array([0.013, 0.011, 0.015, 0.05, 0.05, 0.07])  # m and rad: x, y, height, roll, pitch, yaw
# By motion: shares of FULL, lowest and highest frequency (Hz), pattern of steps, seconds of a step, height of a lifted foot (m).
MOTIONS = {"sway": ((1.0, 1.0, 0.6, 0.6, 0.6, 0.4), 0.3, 1.6, (), 0.0, 0.0), "bow": ((0.4, 0.6, 1.0, 0.5, 1.0, 0.9), 0.4, 2.2, (), 0.0, 0.0),
           "steps": ((0.4, 0.4, 0.3, 0.3, 0.3, 0.5), 0.3, 1.2, ((0,), (3,), (1,), (2,)), 0.5, 0.03),
           "trot": ((0.15, 0.15, 0.15, 0.15, 0.15, 0.3), 0.3, 1.0, ((0, 3), (1, 2)), 0.25, 0.03)}
PLAN = (("train_1", "train", "sway"), ("train_2", "train", "steps"), ("validation_1", "validation", "bow"), ("test_1", "test", "bow"),
        ("test_2", "test", "trot"))


def waves(rng, t, lowest, highest):
    """A sum of four sines that rises from rest."""
    parts = [np.sin(2.0 * np.pi * f * t + rng.uniform(0.0, 2.0 * np.pi)) for f in rng.uniform(lowest, highest, 4)]
    return np.sum(parts, axis=0) / 2.0 * np.clip((t - 0.2) / 0.5, 0.0, 1.0)


def feet_at_rest():
    """Centres of the feet under the hips, legs x 3; a little outside."""
    out = []
    for leg in robot.LEGS:
        (x, y, _), (_, offset, _), _, _ = robot.mounts(leg)
        out.append([x - 0.01, y + 1.1 * offset, robot.RADIUS])
    return np.array(out)


def swings(t, pattern, seconds, lift):
    """Heights of the four feet above where they stand, samples x 4, and the shift of the trunk away from a single foot that is lifted."""
    heights, shift = np.zeros((len(t), 4)), np.zeros((len(t), 2))
    if not pattern:
        return heights, shift
    since = t - 0.6
    number, phase = np.floor(since / seconds).astype(int), np.mod(since, seconds) / seconds
    places = feet_at_rest()
    for k, legs in enumerate(pattern):
        mine = (since > 0.0) & (number % len(pattern) == k)
        for leg in legs:
            heights[mine, leg] = lift * np.sin(np.pi * np.clip((phase[mine] - 0.25) / 0.5, 0.0, 1.0)) ** 2
        if len(legs) == 1:
            shift += np.outer(mine * np.sin(np.pi * phase) ** 2, -0.2 * places[legs[0]][:2])
    return heights, shift


def joint_targets(body, heights):
    """Joint positions that hold the feet where they are wanted, samples x 12. body: x, y, height, roll, pitch, yaw of the trunk."""
    x, y, z, roll, pitch, yaw = body.T
    cr, sr, cp, sp, cy, sy = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
    turn = np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])
    columns = []
    for i, (leg, place) in enumerate(zip(robot.LEGS, feet_at_rest())):
        hip, (_, out, _), _, _ = robot.mounts(leg)
        wanted = np.stack([place[0] - x, place[1] - y, place[2] + heights[:, i] - z])
        f = np.einsum("jik,jk->ik", turn, wanted) - np.array(hip)[:, None]  # from the hip, in the trunk's axes
        down = np.sqrt(np.maximum(f[1] ** 2 + f[2] ** 2 - out ** 2, 1e-6))
        side = np.arctan2(f[1], -f[2]) - np.arctan2(out, down)
        length = np.clip(np.hypot(f[0], down), 0.1, 0.395)
        knee = -2.0 * np.arccos(0.5 * length / robot.THIGH)  # thigh and shin are equally long
        columns += [side, np.arctan2(-f[0], down) - 0.5 * knee, knee]
    return np.stack(columns, axis=1)


def targets(rng, motion, seconds):
    """Samples x 12, rounded as they are written."""
    shares, lowest, highest, pattern, step, lift = MOTIONS[motion]
    t = np.arange(round(seconds / robot.PERIOD)) * robot.PERIOD
    body = np.stack([share * full * waves(rng, t, lowest, highest) for share, full in zip(shares, FULL)], axis=1)
    heights, shift = swings(t, pattern, step, lift)
    body[:, :2] += shift
    body[:, 2] += HEIGHT
    return np.round(joint_targets(body, heights), 5)


def start(first):
    """The robot as it is let go: level, joints at their first targets, the feet a little in the air."""
    return {"position": [0.0, 0.0, HEIGHT + DROP], "orientation": [1.0, 0.0, 0.0, 0.0], "joints": [float(q) for q in first]}


def recordings(rng):
    """[(name, role, targets, start)]"""
    out = []
    for name, role, motion in PLAN:
        wanted = targets(rng, motion, SECONDS[role])
        out.append((name, role, wanted, start(wanted[0])))
    return out
