"""A notebook in a file: cells begin with `# %%`, and the last one shows a picture."""

# %% One second of the full bench: tire and seat on a rough road
from contact_sim_pkg import load_scene, run, series

bag = run(load_scene("car_full_bench", "duration=1.0"))
tire, seat = series(bag, "tire/force"), series(bag, "seat/force")
print(f"tire {tire['normal'].mean():.0f} N, seat {seat['normal'].mean():.0f} N on average")

# %% As a table, where pandas is installed
try:
    print(tire.to_pandas()[["normal", "tangential"]].describe().round(1))
except ImportError:
    print("pandas is not installed")

# %% As a picture
import matplotlib.pyplot as plt  # noqa: E402

figure, axes = plt.subplots(2, 2, figsize=(9.0, 5.0), width_ratios=(2.0, 1.0), layout="constrained")
for row, (name, force) in enumerate((("tire", tire), ("seat", seat))):
    axes[row, 0].plot(force.time, force["normal"])
    axes[row, 0].set(xlabel="time in s", ylabel=f"{name}: normal force in N")
    patch = bag.columns(f"{name}/patch", ("pressure", "rows", "cols"))
    last = patch["pressure"][-1].reshape(patch["rows"][-1], patch["cols"][-1])
    axes[row, 1].imshow(1e-3 * last, origin="lower", aspect="auto", cmap="viridis")
    axes[row, 1].set(title=f"{1e-3 * last.max():.0f} kPa at most", xticks=(), yticks=())
figure.savefig("seat_and_tire.png", dpi=110)
plt.show()
