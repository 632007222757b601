/* A watch on calls that take long: whether they are to go on. Other threads, and handlers of signals, change it while a call looks, and
 * Fortran has no atomic variables for that, nor a clock that nobody sets. Kept by the caller; see base/watch.f90. */
#define _POSIX_C_SOURCE 199309L
#include <stdatomic.h>
#include <stdint.h>
#include <time.h>

/* As watch_type of gapbeam_watch */
struct watch {
    _Atomic(int64_t) ended, asked;   /* not 0: calls are to end; when ask was called last, nanoseconds */
    int64_t until;                   /* when they are to end */
    int (*ask)(void *data);          /* or when this says something else than 0 */
    void *data;
};

enum { NEVER_LONGER = 10 * 1000 * 1000 };   /* nanoseconds between two questions, at least */

static int64_t now(void)
{
    struct timespec time;
    return clock_gettime(CLOCK_MONOTONIC, &time) ? 0 : (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

void gb_watch_begin(struct watch *watch, int (*ask)(void *), void *data, double seconds)
{
    const double latest = 9e9;   /* what the clock can hold */
    watch->ask = ask;
    watch->data = data;
    watch->until = seconds < latest ? now() + (int64_t)(1e9 * (seconds > 0.0 ? seconds : 0.0)) : INT64_MAX;
    atomic_store(&watch->asked, INT64_MIN / 2);
    atomic_store(&watch->ended, 0);
}

void gb_watch_end(struct watch *watch)
{
    atomic_store(&watch->ended, 1);
}

int gb_watch_look(struct watch *watch)
{
    if (!watch)
        return 0;
    if (atomic_load_explicit(&watch->ended, memory_order_relaxed))
        return 1;
    if (!watch->ask && watch->until == INT64_MAX)
        return 0;
    const int64_t time = now();
    int ends = time >= watch->until;
    if (!ends && watch->ask && time - atomic_load_explicit(&watch->asked, memory_order_relaxed) >= NEVER_LONGER) {
        atomic_store_explicit(&watch->asked, time, memory_order_relaxed);
        ends = watch->ask(watch->data) != 0;
    }
    if (ends)
        atomic_store(&watch->ended, 1);
    return ends;
}
