#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes small.onnx: simulates stands, trains the network on them, and says what it is worth on
stands that it has not seen. Needs NumPy only; about twenty minutes on one core.

    model/train.py build/bin/cambium small.onnx
"""

import argparse
import tempfile
from pathlib import Path

import network
import numpy as np
import scans


def load(program, folder, seeds, headings, rng):
    """(stand, position, images) of all scans."""
    stands, positions, pictures = [], [], []
    for seed in seeds:
        where, what = scans.images(scans.simulate(program, folder, seed), headings, rng)
        stands += [seed] * len(where)
        positions.append(where)
        pictures.append(what)
        print(f"stand {seed}: {len(where)} scans", flush=True)
    return np.array(stands), np.concatenate(positions), np.concatenate(pictures)


def distances(stands, positions, rows):
    """Metres from scans `rows` to all; other stands are infinitely far."""
    d = np.linalg.norm(positions[rows][:, None] - positions[None], axis=2)
    return np.where(stands[rows][:, None] == stands[None], d, np.inf)


def spoil(images, rng):
    """Some sectors are hidden, some bins empty: operators, foliage, other sensors."""
    out = images * (rng.random(images.shape) > 0.1)
    start, width = rng.integers(0, network.SECTORS, len(out)), rng.integers(0, 16, len(out))
    hidden = (np.arange(network.SECTORS)[None] - start[:, None]) % network.SECTORS < width[:, None]
    return (out * ~hidden[:, None]).astype(np.float32)


def step(p, stands, positions, pictures, rng, batch=96, near=5.0, far=10.0, temperature=0.07):
    """Loss and gradients of one batch: each scan among all others finds one of less than `near`."""
    anchors = rng.choice(len(stands), batch, replace=False)
    d = distances(stands, positions, anchors)
    d[np.arange(batch), anchors] = np.inf
    partners = np.array([rng.choice(np.flatnonzero(row < near)) if (row < near).any() else a
                         for a, row in zip(anchors, d)])
    rows = np.concatenate([anchors, partners])
    view = rng.integers(0, pictures.shape[1], len(rows))
    y, kept = network.forward(p, spoil(pictures[rows, view], rng))
    a, b = y[:batch], y[batch:]
    logits = a @ b.T / temperature
    between = distances(stands, positions, anchors)[:, partners]
    neither = (between < far) & ~np.eye(batch, dtype=bool)  # not the partner, not elsewhere
    logits[neither] = -1e9
    soft = np.exp(logits - logits.max(1, keepdims=True))
    soft /= soft.sum(1, keepdims=True)
    loss = -np.log(soft[np.arange(batch), np.arange(batch)] + 1e-12).mean()
    d_logits = (soft - np.eye(batch)) / batch / temperature
    return loss, network.backward(p, kept, np.concatenate([d_logits @ b, d_logits.T @ a]))


def train(p, data, steps, rng, rate=2e-3):
    """Adam (Kingma, Ba 2015) with a rate that falls to zero along a cosine."""
    m = {k: np.zeros_like(v) for k, v in p.items()}
    v = {k: np.zeros_like(w) for k, w in p.items()}
    for i in range(1, steps + 1):
        loss, gradients = step(p, *data, rng)
        lr = rate * 0.5 * (1 + np.cos(np.pi * i / steps))
        for k, g in gradients.items():
            m[k] += 0.1 * (g - m[k])
            v[k] += 0.001 * (g * g - v[k])
            p[k] -= lr * ((m[k] / (1 - 0.9**i)) / (np.sqrt(v[k] / (1 - 0.999**i)) + 1e-8)
                          + 1e-4 * p[k]).astype(np.float32)
        if i % 250 == 0:
            print(f"step {i}: loss {loss:.3f}", flush=True)


def recall(p, stands, positions, pictures, right=5.0):
    """Of the scans, those whose best other scan of 3 m or more along the path is within `right`."""
    y, _ = network.forward(p, pictures[:, 0])
    z, _ = network.forward(p, pictures[:, -1])
    same = (np.arange(len(y))[:, None] - np.arange(len(y))[None])
    similar = np.where(np.abs(same) < 15, -np.inf, y @ z.T)  # not the scan's own neighbours
    best = similar.argmax(1)
    d = distances(stands, positions, np.arange(len(y)))
    able = np.where(np.abs(same) < 15, np.inf, d).min(1) < right
    return (d[np.arange(len(y)), best] < right)[able].mean(), able.sum()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", help="the program cambium")
    arguments.add_argument("out", type=Path, help="the ONNX file to write")
    arguments.add_argument("--stands", type=int, default=24)
    arguments.add_argument("--steps", type=int, default=6000)
    a = arguments.parse_args()
    rng = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as folder:
        data = load(a.program, Path(folder), range(1, a.stands + 1), 4, rng)
        unseen = load(a.program, Path(folder), range(1001, 1005), 2, rng)
    p = network.initial(seed=1)
    print(f"untrained: recall at 1 {recall(p, *unseen)[0]:.3f}")
    train(p, data, a.steps, rng)
    a.out.write_bytes(network.to_onnx(p))
    share, queries = recall(p, *unseen)
    print(f"unseen stands: recall at 1 {share:.3f} of {queries} scans; {a.out.stat().st_size} bytes")


if __name__ == "__main__":
    main()
