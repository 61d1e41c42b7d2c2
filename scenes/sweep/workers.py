"""Points solved by several processes at a time.

`concurrent.futures` with new interpreters (spawn): a point then meets no state of MPI, PETSc or gmsh of another, a
process that dies takes no others with it, and nothing has to be installed. The pool of mpi4py has the same interface,
but the solvers work together on all ranks of one communicator: under mpirun all ranks solve each point together.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process

from hydroelastic.scenes.errors import Problem, SceneError
from hydroelastic.scenes.sweep.point import PointOptions, SolvedPoint, Task, solve_point


def solved_tasks(tasks: Sequence[Task], options: PointOptions, jobs: int) -> Iterator[tuple[Task, SolvedPoint]]:
    """Solve tasks, and yield each as soon as it is solved."""
    if jobs == 1 or len(tasks) < 2:
        for task in tasks:
            yield task, solve_point(task, options)
        return
    if parent_process() is not None:
        raise SceneError(Problem(key="jobs", wrong="a process of a sweep cannot start another sweep with more"))
    left = list(tasks)
    while left:
        suspects = []
        for task, point in _pooled(tuple(left), options, min(jobs, len(left))):
            if point is None:
                suspects.append(task)
            else:
                left.remove(task)
                yield task, point
        if not suspects:
            return
        # A process died, and took the others of its pool with it: what they were solving is solved one at a time.
        for task in suspects[: jobs + 1]:
            left.remove(task)
            ((_, point),) = _pooled([task], options, 1)
            yield task, point or _died()


def _died() -> SolvedPoint:
    reason = "the process that solved it ended without a result, for example because the memory was used up"
    return SolvedPoint(status="failed", reasons=(reason,))


def _pooled(tasks: Sequence[Task], options: PointOptions, jobs: int) -> Iterator[tuple[Task, SolvedPoint | None]]:
    """Yield each task with its point, or with ``None`` where a process died."""
    pool = ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_end_with_parent)
    try:
        try:
            pool.submit(os.getpid).result()
        except BrokenProcessPool as error:
            raise SceneError(
                Problem(
                    key="jobs",
                    wrong="the processes of the sweep could not be started",
                    remedy='In a script, call the sweep below `if __name__ == "__main__":`',
                )
            ) from error
        running: dict[Future[SolvedPoint], Task] = {}
        for task in tasks:
            try:
                running[pool.submit(solve_point, task, options)] = task
            except BrokenProcessPool:
                yield task, None
            if len(running) > jobs:
                yield from _finished(running)
        while running:
            yield from _finished(running)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        # Without results to wait for, those that still solve are ended.
        for process in list((pool._processes or {}).values()):
            process.terminate()


def _finished(
    running: dict[Future[SolvedPoint], Task],
) -> Iterator[tuple[Task, SolvedPoint | None]]:
    """Wait for some of the running tasks, and yield and remove them."""
    for future in wait(running, return_when=FIRST_COMPLETED).done:
        task = running.pop(future)
        yield task, None if isinstance(future.exception(), BrokenProcessPool) else future.result()


def _end_with_parent() -> None:
    """Let this process end with the one that started it, however that ends, and leave Ctrl-C to it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    assert parent is not None

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
