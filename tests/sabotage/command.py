"""The command: which changes are tried, in how many copies, and what is printed."""

import argparse
import queue
import threading
import time
from collections import Counter
from pathlib import Path

from .change import TOP, read_changes
from .workshop import Workshop

SHARE = 0.95  # of all changes, to be killed


def main(arguments=None):
    """The command; its exit status is 1 if a change survives that is not said to, or cannot be tried."""
    parser = argparse.ArgumentParser("python tests/sabotage", description=__doc__.splitlines()[0])
    parser.add_argument("--only", action="append", default=[], metavar="TEXT", help="changes with this in room, file or line")
    parser.add_argument("--jobs", type=int, default=1, help="copies that are built and tested at the same time (default 1)")
    parser.add_argument("--list", action="store_true", help="say which there are, and try nothing")
    parser.add_argument("--folder", type=Path, default=TOP / ".venv" / "sabotage", help="where the copies are (.venv/sabotage)")
    chosen = parser.parse_args(arguments)
    changes = [one for one in read_changes() if all(text in f"{one.file} {one.old} {one.new}" for text in chosen.only)]
    if chosen.list:
        for one in changes:
            print(f"{one.file}: {one.old}  ->  {one.new}  ({' '.join(one.tests)})")
        print(f"{len(changes)} changes in {len({one.room for one in changes})} rooms")
        return 0
    begin, found = time.monotonic(), try_all(changes, chosen)
    return said(changes, found, time.monotonic() - begin)


def try_all(changes, chosen):
    """Outcome and reason of every change."""
    waiting, found = queue.SimpleQueue(), {}
    for change in changes:
        waiting.put(change)
    lock = threading.Lock()

    def work(number):
        shop = Workshop(chosen.folder / str(number), any(not one.is_python for one in changes))
        while not waiting.empty():
            try:
                change = waiting.get_nowait()
            except queue.Empty:
                return
            begin = time.monotonic()
            outcome, what = shop.tried(change)
            seconds = time.monotonic() - begin
            with lock:
                found[change] = outcome, what
                print(f"{outcome:8} {seconds:5.1f} s  {change.file}: {change.old}  ->  {change.new}", flush=True)
                print(f"{'':18}{what or change.survives}", flush=True)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(chosen.jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


def said(changes, found, seconds):
    """Print the table by room; the exit status."""
    rooms = {}
    for change in changes:
        rooms.setdefault(change.room, Counter())[found.get(change, ("broken", ""))[0]] += 1
    print(f"\n{'room':24} killed survived broken")
    for room, count in sorted(rooms.items()):
        print(f"{room:24} {count['killed']:6} {count['survived']:8} {count['broken']:6}")
    total = sum(rooms.values(), Counter())
    print(f"{'all':24} {total['killed']:6} {total['survived']:8} {total['broken']:6}  in {seconds:.0f} s")
    silent = [one for one in changes if found.get(one, ("broken", ""))[0] == "survived" and not one.survives]
    for change in silent:
        print(f"survived: {change.file}: {change.old}  ->  {change.new}")
    enough = total["killed"] >= SHARE * total.total()
    return 1 if silent or total["broken"] or not enough else 0
