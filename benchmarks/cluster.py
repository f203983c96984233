"""`python -m benchmarks.cluster`: a list on a Dask cluster of two workers, and how far that carries; extra `cluster`.

CPU of the workers, and of client and scheduler, which share a process, a loop; the start of the cluster; bytes of a
result. From these, with every worker a core and nothing else on it,

    time of N loops on W cores = start + N max(of a worker/W, of client and scheduler)
"""

import pickle
import time

from benchmarks.many import plant_list
from benchmarks.recompute import keep
from simc_core import tune_many

LOOPS, WORKERS, CHUNK = 10_000, 2, 1000
MILLION, CORES = 1_000_000, (2, 4, 16, 64)


def main() -> None:
    """Print what was measured and the model's times, and write the JSON."""
    from distributed import Client, LocalCluster

    rows, begun = plant_list(LOOPS), time.perf_counter()
    with (
        LocalCluster(n_workers=WORKERS, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        start = time.perf_counter() - begun
        list(tune_many(rows[: 2 * CHUNK], client, CHUNK))  # the workers have imported everything
        before, own = client.run(time.process_time), time.process_time()
        results = list(tune_many(rows, client, CHUNK))
        own, after = time.process_time() - own, client.run(time.process_time)
        peak = max(client.run(_megabytes).values())
    assert [result.tag for result in results] == [row["tag"] for row in rows]
    worker = sum(after[each] - before[each] for each in after) / LOOPS
    size = len(pickle.dumps(results[:CHUNK])) / CHUNK
    found = {"start": start, "worker": worker, "client": own / LOOPS, "bytes": size, "MB": peak}
    print("\n| start, s | worker CPU, ms a loop | client and scheduler, ms a loop | bytes a result | MB a worker |")
    print("|---|---|---|---|---|")
    print(f"| {start:.1f} | {1e3 * worker:.2f} | {1e3 * found['client']:.3f} | {size:.0f} | {peak:.0f} |")
    print("\n| cores | minutes for a million, by the model |\n|---|---|")
    for cores in CORES:
        print(f"| {cores} | {(start + MILLION * max(worker / cores, found['client'])) / 60:.1f} |")
    keep("cluster", [found])


def _megabytes() -> float:
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main()
