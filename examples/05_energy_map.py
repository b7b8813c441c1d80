"""A shape becomes a carbon shell; matplotlib shows where its energy sits.

    python3 05_energy_map.py [MESH]
"""

import sys

import matplotlib

matplotlib.use("Agg")  # a file, no window
import matplotlib.pyplot as plt

import trivalent

shape = sys.argv[1] if len(sys.argv) > 1 else "torus"
shell = trivalent.build(shape, atoms=2000, effort="quick")
excess = 1000 * (shell.energies - trivalent.graphene_energy)  # [meV] above graphene

figure, (map_axes, histogram_axes) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
x, y, z = shell.positions.T
front = z > z.mean()
points = map_axes.scatter(x[front], y[front], c=excess[front], s=6, cmap="Reds", vmin=0, vmax=200)
map_axes.set(aspect="equal", xlabel="x [Å]", ylabel="y [Å]", title=f"{len(shell)} atoms")
figure.colorbar(points, label="energy above graphene [meV]")
histogram_axes.hist(excess, bins=60)
histogram_axes.set(xlabel="energy above graphene [meV]", ylabel="atoms", yscale="log")
figure.savefig("energy_map.png", dpi=150)

print(f"{len(shell)} atoms, {excess.mean():.1f} meV/atom above graphene, at most {excess.max():.0f} meV")
assert trivalent.check(shell)["sound"]
