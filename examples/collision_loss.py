r"""A body as a collision loss: points slide to their targets and stay 2 mm outside, by gradient descent in numpy.

    targets  x . . . x          loss = sum |p - target|^2  +  weight * sum max(0, 2 mm - d(p))^2
               \_|_/            its second part has the gradient -2 weight max(0, 2 mm - d) normal,
               body             which body.contacts(points) gives with one call for all points

    python3 collision_loss.py body.bodice [page.html]      a page: the loss of each step, the points before and after
"""

import pathlib
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


def scatter(points, inside):
    """Points from the front as SVG: red inside the body, blue outside."""
    low, high = points.min(axis=0), points.max(axis=0)
    scale = 400.0 / (high[1] - low[1])
    dots = "".join(f'<circle cx="{(x - low[0]) * scale + 5:.1f}" cy="{(high[1] - y) * scale + 5:.1f}" r="1.5" '
                   f'fill="{"#c33" if is_in else "#27c"}"/>' for (x, y, _), is_in in zip(points, inside))
    return f'<svg width="{(high[0] - low[0]) * scale + 10:.0f}" height="410">{dots}</svg>'


def curve(losses):
    """The loss over the steps as SVG, logarithmic."""
    y = np.log(losses)
    y = (y - y.min()) / max(1e-12, y.max() - y.min())
    steps = " ".join(f"{5 + 400.0 * i / len(y):.1f},{205 - 200 * v:.1f}" for i, v in enumerate(y))
    return f'<svg width="410" height="210"><polyline points="{steps}" fill="none" stroke="#333" stroke-width="2"/></svg>'


def page(body, start, points, losses):
    views = [f"<figure>{scatter(p, d < 0.0)}<figcaption>{when}: {int((d < 0.0).sum())} of {len(p)} points inside"
             "</figcaption></figure>" for when, p, d in (("before", start, body.signed_distance(start)),
                                                         ("after", points, body.signed_distance(points)))]
    return ("<!doctype html><meta charset='utf-8'><title>A body as a collision loss</title><style>body{font:15px sans-serif;"
            "margin:2rem}main{display:flex;gap:2rem;flex-wrap:wrap}figure{margin:0}</style><h1>A body as a collision loss"
            f"</h1><main>{''.join(views)}<figure>{curve(losses)}<figcaption>loss, logarithmic: {losses[0]:.3g} to "
            f"{losses[-1]:.3g} in {len(losses)} steps</figcaption></figure></main>\n")


if __name__ == "__main__":
    body = bodice.load(sys.argv[1])
    random = np.random.default_rng(0)
    center = body.ellipsoids()["center"].mean(axis=0)
    targets = center + random.normal(0.0, 0.2, (2000, 3))
    start = targets + random.normal(0.0, 0.02, targets.shape)
    points, losses = descend(body, start, targets)
    inside = [int((body.signed_distance(p) < 0.0).sum()) for p in (start, points)]
    print(f"loss {losses[0]:.4f} -> {losses[-1]:.4f}, points inside {inside[0]} -> {inside[1]}")
    if len(sys.argv) > 2:
        pathlib.Path(sys.argv[2]).write_text(page(body, start, points, losses), encoding="utf8")
    sys.exit(0 if losses[-1] < losses[0] and inside[1] < inside[0] else 1)
