r"""A body as a collision loss: points slide to their targets and stay 2 mm outside, by gradient descent in numpy.

    targets  x . . . x          loss = sum |p - target|^2  +  weight * sum max(0, 2 mm - d(p))^2
               \_|_/            its second part has the gradient -2 weight max(0, 2 mm - d) normal,
               body             which body.contacts(points) gives with one call for all points

    python3 collision_loss.py body.bodice
"""

import sys

import numpy as np

import bodice


def descend(body, points, targets, clearance=0.002, weight=50.0, steps=400, rate=0.01):
    """Moves the points (n, 3); returns them and the loss of every step."""
    losses = []
    for _ in range(steps):
        contacts = body.contacts(points)
        lack = np.maximum(0.0, clearance - contacts.distance)
        losses.append(np.sum((points - targets) ** 2) + weight * np.sum(lack**2))
        gradient = 2.0 * (points - targets) - 2.0 * weight * lack[:, None] * contacts.normal
        points = points - rate * gradient
    return points, losses


if __name__ == "__main__":
    body = bodice.load(sys.argv[1])
    random = np.random.default_rng(0)
    center = body.ellipsoids()["center"].mean(axis=0)
    targets = center + random.normal(0.0, 0.2, (2000, 3))
    start = targets + random.normal(0.0, 0.02, targets.shape)
    points, losses = descend(body, start, targets)
    inside = [int((body.signed_distance(p) < 0.0).sum()) for p in (start, points)]
    print(f"loss {losses[0]:.4f} -> {losses[-1]:.4f}, points inside {inside[0]} -> {inside[1]}")
    sys.exit(0 if losses[-1] < losses[0] and inside[1] < inside[0] else 1)
