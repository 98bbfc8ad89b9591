r"""The loss of collision_loss.py in torch: the distance to a body is a function that autograd differentiates.

    points --body.contacts--> distance --max(0, 2 mm - d)^2--> loss
       ^                        normal                          |
       +---- dloss/dd * normal <--------------------------------+   backward, without another query

    python3 collision_loss_torch.py body.bodice
"""

import sys

import numpy as np
import torch

import bodice


class SignedDistance(torch.autograd.Function):
    """(n, 3) points -> (n,) meters to the surface of a body, negative inside; its gradient is the outward normal.
    The body is on the CPU: points of another device are copied to it and back."""

    @staticmethod
    def forward(ctx, points, body):
        contacts = body.contacts(points.detach().cpu().numpy())
        ctx.save_for_backward(torch.from_numpy(contacts.normal).to(points))
        return torch.from_numpy(contacts.distance).to(points)

    @staticmethod
    def backward(ctx, gradient):
        (normal,) = ctx.saved_tensors
        return gradient[:, None] * normal, None  # the body has no gradient


def descend(body, points, targets, clearance=0.002, weight=50.0, steps=200, rate=0.01):
    """Moves the points (n, 3), tensors, by the optimizer Adam; returns them and the loss of every step."""
    points = points.clone().requires_grad_(True)
    optimizer = torch.optim.Adam([points], lr=rate)
    losses = []
    for _ in range(steps):
        optimizer.zero_grad()
        lack = torch.relu(clearance - SignedDistance.apply(points, body))
        loss = torch.sum((points - targets) ** 2) + weight * torch.sum(lack**2)
        loss.backward()
        optimizer.step()
        losses.append(loss.item())
    return points.detach(), losses


if __name__ == "__main__":
    body = bodice.load(sys.argv[1])
    random = np.random.default_rng(0)
    targets = torch.from_numpy(body.ellipsoids()["center"].mean(axis=0) + random.normal(0.0, 0.2, (2000, 3)))
    start = targets + torch.from_numpy(random.normal(0.0, 0.02, (2000, 3)))
    points, losses = descend(body, start, targets)
    inside = [int((SignedDistance.apply(p, body) < 0.0).sum()) for p in (start, points)]
    print(f"loss {losses[0]:.4f} -> {losses[-1]:.4f}, points inside {inside[0]} -> {inside[1]}")
    sys.exit(0 if losses[-1] < losses[0] and inside[1] < inside[0] else 1)
