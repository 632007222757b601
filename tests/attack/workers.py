"""Cases judged in processes that may hang, run out of time or end otherwise without harm to the command."""

import multiprocessing
import time
from dataclasses import dataclass
from multiprocessing.connection import wait


@dataclass
class Ended:
    """How a process ended that did not answer.

    Attributes
    ----------
    outcome : str
        hang or aborted.
    how : str
        In words.
    """

    outcome: str
    how: str


def work(judge, pipe):
    """Judge what comes through a pipe until nothing does."""
    while (task := pipe.recv()) is not None:
        pipe.send(judge(task))


class Worker:
    """A process that judges one case at a time."""

    def __init__(self, judge):
        self.judge, self.task, self.since = judge, None, 0.0
        self.start()

    def start(self):
        self.pipe, theirs = multiprocessing.Pipe()
        self.process = multiprocessing.get_context("fork").Process(target=work, args=(self.judge, theirs), daemon=True)
        self.process.start()
        theirs.close()

    def give(self, task):
        self.task, self.since = task, time.monotonic()
        self.pipe.send(task)

    def take(self):
        """The answer to the case that it had, whatever became of the process."""
        task, self.task = self.task, None
        try:
            return task, self.pipe.recv()
        except EOFError:
            self.process.join()
            how = self.process.exitcode
            self.start()
            return task, Ended("aborted", f"the process ended with {'signal' if how < 0 else 'status'} {abs(how)}")

    def kill(self, limit):
        """End a case that takes too long."""
        task, self.task = self.task, None
        self.process.kill()
        self.process.join()
        self.start()
        return task, Ended("hang", f"no answer within {limit:g} s")

    def stop(self):
        if self.task is None:
            self.pipe.send(None)
        else:
            self.process.kill()
        self.process.join()


def judge_all(judge, tasks, jobs, limit, until=float("inf")):
    """Judge cases in several processes.

    Parameters
    ----------
    judge : callable
        From a task to an answer that can be pickled.
    tasks : iterable
    jobs : int
    limit : float
        Seconds for one case.
    until : float
        Monotonic time after which no new case begins.

    Yields
    ------
    task
    answer
        What `judge` gave, or `Ended`.
    """
    tasks, workers = iter(tasks), [Worker(judge) for _ in range(jobs)]
    try:
        while True:
            for worker in workers:
                if worker.task is None and time.monotonic() < until:
                    task = next(tasks, None)
                    if task is None:
                        until = 0.0
                    else:
                        worker.give(task)
            busy = [worker for worker in workers if worker.task is not None]
            if not busy:
                return
            ready = wait([worker.pipe for worker in busy], timeout=1.0)
            for worker in busy:
                if worker.pipe in ready:
                    yield worker.take()
                elif time.monotonic() - worker.since > limit:
                    yield worker.kill(limit)
    finally:
        for worker in workers:
            worker.stop()
