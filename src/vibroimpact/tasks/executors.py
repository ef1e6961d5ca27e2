"""Choose where tasks run: on threads, on processes, or on a dask cluster."""

from __future__ import annotations

import importlib
import importlib.util
from typing import Any

from vibroimpact.errors import InputError, shown
from vibroimpact.model.argument_types import whole
from vibroimpact.tasks.cluster import Cluster
from vibroimpact.tasks.processes import Processes, may_start
from vibroimpact.tasks.threads import Workers

THREADS = "threads"
"""This process's own."""
PROCESSES = "processes"
"""Of this machine: each has an interpreter of its own."""
_PATIENCE = "10s"
"""For a scheduler to answer."""
_MARKS = ("tcp://", "tls://", "ucx://", "ws://", "wss://", "inproc://")


def workers_for(threads: int | None, where: Any = THREADS) -> Workers:
    """Return where tasks run: threads or processes (default: one per processor), or a cluster.

    A cluster is a `distributed.Client`, or a scheduler's address such as ``"tcp://10.0.0.1:8786"``.

    Raises
    ------
    InputError
        If the cluster does not exist, or dask is not installed.
    """
    if isinstance(where, str) and where in (THREADS, PROCESSES):
        number = None if threads is None else whole(threads, "threads")
        if where == THREADS:
            return number
        if not may_start():
            raise InputError(
                "where: 'processes' is not possible in a process that may not start others, such "
                "as a worker of a cluster; pass 'threads'"
            )
        return Processes(number)
    if threads is not None:
        raise InputError(
            f"threads: {threads} has no effect with where={shown(where)}, because each worker of a "
            "cluster sets its own number of threads; leave threads out, or pass where='threads' or "
            "'processes'"
        )
    if importlib.util.find_spec("distributed") is None:
        raise InputError(
            f"where: {shown(where)} is neither 'threads' nor 'processes', and a cluster requires "
            "dask, which is not installed; pass one of the two, or install dask with: "
            "pip install distributed"
        )
    client = importlib.import_module("distributed").Client
    if isinstance(where, client):
        if where.status in ("closing", "closed"):
            raise InputError("where: this client is closed; pass a connected client")
        return Cluster(where)
    if not (isinstance(where, str) and where.startswith(_MARKS)):
        raise InputError(
            f"where: {shown(where)} is unknown; pass 'threads', 'processes', a dask Client, or the "
            "address of a scheduler, such as tcp://10.0.0.1:8786"
        )
    try:
        return Cluster(client(where, timeout=_PATIENCE, set_as_default=False))
    except (OSError, ValueError) as error:
        raise InputError(
            f"where: no scheduler answers at {where} ({error}); start the scheduler, or pass the "
            "address of a running one"
        ) from error
