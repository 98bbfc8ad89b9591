r"""A body becomes a proxy, its bones move it, and another body takes over while frames run, in Python.

    vertices, faces --fit--> body --pose(matrices)--> body in a pose --resolve(points)--> points outside
                                                  begin_fit(...) beside the frames ----> the next body

    python3 fit_and_pose.py [body.obj]
"""

import sys

import numpy as np

import bodice


def cloud(body, count=2000):
    """Points around the body, repeatable."""
    low, high = body.skin.vertices.min(axis=0), body.skin.vertices.max(axis=0)
    return np.random.default_rng(1).uniform(low, high, (count, 3))


def main(path=None):
    skin = bodice.load_skin(path, find_rig=True) if path else bodice.built_in(find_rig=True)
    body = skin.fit("solid")
    print(f"{skin.stature:.2f} m tall, waist {skin.measurements['waist']:.2f} m; {len(body)} ellipsoids, "
          f"{len(body.joints)} joints")
    error = body.signed_distance(skin.vertices) - body.signed_distance(skin.vertices, exact=True)
    print(f"{np.abs(error).mean() * 1e3:.1f} mm from the skin on average")

    saved = body.to_bytes()                      # what a file would hold; bodice.load() reads files
    again = bodice.Body(saved)
    assert again.hash == body.hash

    matrices = body.bind_matrices()              # (joints, 3, 4): the pose that the body is in
    for frame in range(30):                      # and moves forward, one millimeter a frame
        moved = matrices.copy()
        moved[:, 2, 3] += 0.001 * frame
        body.pose(moved, dt=1 / 60)
    points = cloud(body)
    contacts = body.resolve(points, thickness=0.002)
    outside = body.signed_distance(points).min()

    ticket = bodice.begin_fit(skin.vertices * 1.1, skin.faces, "solid")  # a taller one, beside the frames
    frames = 0
    while not ticket.done:
        body.resolve(points)
        frames += 1
    body = ticket.result()
    print(f"{contacts} contacts; {frames} frames ran until a body of {body.skin.stature:.2f} m took over")
    return contacts > 100 and outside > 0.001 and body.skin.stature > 1.05 * skin.stature


if __name__ == "__main__":
    sys.exit(0 if main(*sys.argv[1:]) else 1)
