"""Flies the runs of a plan on the workers of Dask.distributed: its scheduler, which gives the work of a worker that died to another."""
import itertools
import threading

from .flight import Flyer
from .workers import died_row

BATCH_LIMIT = 1000     # runs of one task
BATCHES_PER_THREAD = 8
_own = threading.local()


def _plan(plan):
    """A task of its own: where its result is lost with a worker, the scheduler makes it again."""
    return plan


def _fly(plan, batch):
    key = plan.fingerprint_text
    if getattr(_own, "key", None) != key:
        _own.key, _own.flyer = key, Flyer(plan)
    return [row for group in _own.flyer.groups(batch) for row in _own.flyer.rows(group)]


def _version():
    from .. import version
    return version


def _import_distributed():
    try:
        import distributed
    except ImportError:
        raise ValueError("--scheduler: needs Dask.distributed (python3-distributed), which is not here; without --scheduler all cores of "
                         "this machine are used, and --shard needs no scheduler") from None
    return distributed


def fly(plan, waiting, address, on_rows):
    """Until all is flown.

    :param waiting: rows of the design. :param address: of a scheduler, tcp://HOST:PORT. :param on_rows: called with rows of results.
    :raises ValueError: without Dask.distributed, a scheduler or a worker, or if workers have another version.
    """
    distributed = _import_distributed()
    try:
        client = distributed.Client(address, timeout=20)
    except (OSError, ValueError) as error:
        raise ValueError(f"--scheduler {address}: {error}") from None
    with client:
        _check_versions(client, address)
        threads = sum(client.nthreads().values())
        size = max(1, min(BATCH_LIMIT, len(waiting) // (BATCHES_PER_THREAD * max(1, threads))))
        sent = client.submit(_plan, plan, pure=False)
        todo = [waiting[i:i + size] for i in range(0, len(waiting), size)]
        _gather(distributed, client, sent, todo, (plan, on_rows, 4 * threads))


def _check_versions(client, address):
    try:
        client.wait_for_workers(1, timeout=60)
    except Exception as error:
        raise ValueError(f"--scheduler {address}: no worker came: {error}") from None
    versions = client.run(_version)
    if set(versions.values()) != {_version()}:
        raise ValueError(f"--scheduler {address}: each worker must have {_version()}: " +
                         ", ".join(f"{worker} has {version}" for worker, version in sorted(versions.items())))


def _gather(distributed, client, sent, todo, target):
    """Keeps a bounded number of tasks under way. :param target: (plan, on_rows, how many)."""
    plan, on_rows, most = target
    rest = iter(todo)
    batches = {}

    def submit(batch):
        future = client.submit(_fly, sent, batch, pure=False)
        batches[future] = batch
        return future

    done = distributed.as_completed([submit(batch) for batch in itertools.islice(rest, most)])
    for future in done:
        batch = batches.pop(future)
        if future.status == "finished":
            on_rows(future.result())
            following = list(itertools.islice(rest, 1))
        elif len(batch) == 1:
            on_rows([died_row(plan, batch[0], f"its workers died: {type(future.exception()).__name__}")])
            following = list(itertools.islice(rest, 1))
        else:
            following = [[cells] for cells in batch]  # to see which one it was
        for one in following:
            done.add(submit(one))
