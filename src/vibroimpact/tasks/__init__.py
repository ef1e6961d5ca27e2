"""Run many independent tasks on threads, processes or a dask cluster, with progress."""
