/* Out of memory is a status: a beam is prepared, solved, certified and followed under all limits of the address space from too
 * little to enough. Each time in a process of its own, which must end with a solution or with GAPBEAM_NO_MEMORY, silently.
 * Reports in the Test Anything Protocol. Linux only. The address sanitizer needs terabytes of addresses: there large arrays are
 * refused after so many bytes of them (tests/meson.build has the linker put what is here before malloc and realloc). */
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gapbeam.h"

#if !defined(__linux__)
int main(void)
{
    printf("1..0 # SKIP limits of the address space cannot be set here\n");
    return 0;
}
#else

enum { SPANS = 1500, ON_GROUND = 200, SHAPES = 5 };
enum { SOLVED, REFUSED, WRONG };

#ifdef __SANITIZE_ADDRESS__
enum { STEPS = 40, LARGE = 16384 };
static size_t taken, most;

void *__real_malloc(size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_realloc(void *old, size_t size);

static int refused(size_t size)
{
    if (size >= LARGE)
        taken += size;
    return size >= LARGE && most && taken > most;
}

void *__wrap_malloc(size_t size)
{
    return refused(size) ? NULL : __real_malloc(size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return refused(size) ? NULL : __real_realloc(old, size);
}

static int set_limit(size_t limit)
{
    most = limit;
    return 0;
}
#else
enum { STEPS = 60 };

static int set_limit(size_t limit)
{
    struct rlimit space = {limit, limit};
    return setrlimit(RLIMIT_AS, &space);
}

/* Addresses in use, bytes */
static size_t in_use(void)
{
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file) {
        if (fscanf(file, "%ld", &pages) != 1)
            pages = 0;
        fclose(file);
    }
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}
#endif

static double length[SPANS], EI[SPANS], gap[SPANS + 1], stiffness[SPANS + 1], hinge[SPANS], load_x[2], load_to[2], value[2];
static double reaction[SPANS + 1], factor[4 * SPANS];
static int node[SPANS + 1], side[SPANS + 1], undecided[SPANS + 1];

/* 0: a one-sided elastic base under a force; 1: rigid supports with gaps that cannot stand without each other; 2: hinges;
 * 3: nothing but a force at a rigid support: all others are at zero, which quadruple precision decides;
 * 4: no support but one-sided ground with a law, pressed down in the middle of a heavy beam that lifts off beside it */
static gapbeam_model describe(int shape)
{
    static const int ground_of[] = {0, 0}, from_below[] = {GAPBEAM_BELOW};
    static const double way[] = {0.002, 0.004}, push[] = {0.1, 0.15};
    static const int kind[] = {GAPBEAM_DISTRIBUTED, GAPBEAM_FORCE}, load_case[] = {GAPBEAM_DEAD, GAPBEAM_LIVE};
    gapbeam_model model;
    gapbeam_model_init(&model, sizeof model);
    for (int i = 0; i < SPANS; i++) {
        length[i] = 1.0;
        EI[i] = 1e4;
        hinge[i] = i + 0.5;
    }
    for (int i = 0; i <= SPANS; i++) {
        node[i] = i;
        side[i] = GAPBEAM_BELOW;
        gap[i] = shape == 1 ? 1e-5 * (i * 37 % 101) : 0.0;
        stiffness[i] = shape % 2 ? gapbeam_infinity() : 50.0;
    }
    load_to[0] = SPANS;
    load_x[1] = shape == 3 ? SPANS / 2 : SPANS / 2 + 0.25;
    value[0] = shape == 3 ? 0.0 : 0.1;
    value[1] = shape == 2 ? 1.0 : 40.0;
    model.spans = SPANS;
    model.length = length;
    model.EI = EI;
    model.supports = SPANS + 1;
    model.support_node = node;
    model.support_side = side;
    model.support_gap = gap;
    model.support_stiffness = stiffness;
    if (shape == 2) {
        model.hinges = SPANS / 4;
        model.hinge_x = hinge;
    }
    if (shape == 4) {
        model.spans = ON_GROUND;
        model.supports = 0;
        model.foundations = 1;
        model.foundation_side = from_below;
        model.ground_law_points = 2;
        model.ground_law_foundation = ground_of;
        model.ground_law_displacement = way;
        model.ground_law_force = push;
        load_to[0] = ON_GROUND;
        load_x[1] = ON_GROUND / 2 + 0.25;
    }
    model.loads = 2;
    model.load_kind = kind;
    model.load_case = load_case;
    model.load_x = load_x;
    model.load_to = load_to;
    model.load_value = value;
    return model;
}

/* Everything under a limit; how it ended */
static int attempt(const gapbeam_model *model, size_t limit)
{
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    gapbeam_certificate certificate = {.size = sizeof certificate};
    double extreme[GAPBEAM_FIELDS][2], place[GAPBEAM_FIELDS][2];
    char message[200];
    int number = 0;

    if (limit && set_limit(limit))
        return WRONG;
    int status = gapbeam_prepare(model, &beam, message, sizeof message);
    if (!status)
        status = gapbeam_new_state(&state);
    if (!status)
        status = gapbeam_solve(beam, 1.0, NULL, state, message, sizeof message);
    if (!status)
        status = gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL);
    if (!status)
        status = gapbeam_get_extremes(beam, state, extreme, place);
    if (!status)
        status = gapbeam_get_certificate(beam, state, &certificate, undecided);
    if (!status && !model->foundations)
        status = gapbeam_follow(beam, 1.0, NULL, 4 * SPANS, factor, NULL, NULL, &number, state, message, sizeof message);
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    return status == GAPBEAM_SOLVED ? SOLVED : status == GAPBEAM_NO_MEMORY ? REFUSED : WRONG;
}

/* The same in a process of its own, whatever becomes of it */
static int in_a_process(const gapbeam_model *model, size_t limit)
{
    int ended = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0)
        _exit(attempt(model, limit));
    if (child < 0 || waitpid(child, &ended, 0) < 0 || !WIFEXITED(ended) || WEXITSTATUS(ended) > WRONG)
        return WRONG;
    return WEXITSTATUS(ended);
}

int main(void)
{
    int failures = 0;

    /* Let the run-time library take what it takes once */
    gapbeam_status_message(0);
    for (int shape = 0; shape < SHAPES; shape++) {
        gapbeam_model model = describe(shape);
#ifdef __SANITIZE_ADDRESS__
        taken = 0;
        int good = attempt(&model, 0) == SOLVED;
        const size_t base = 1, enough = taken + STEPS;
        taken = 0;
#else
        int good = in_a_process(&model, 0) == SOLVED;
        const size_t base = in_use(), enough = shape == 4 ? (size_t)ON_GROUND * 60000 : (size_t)SPANS * 18000;
#endif
        int ends[3] = {0, 0, 0};
        for (int step = 0; step <= STEPS; step++)
            ends[in_a_process(&model, base + enough / STEPS * step)]++;
        good = good && ends[WRONG] == 0 && ends[SOLVED] > 0 && ends[REFUSED] > STEPS / 10;
        failures += !good;
        printf("%s %d - shape %d: %d solved, %d refused, %d otherwise\n", good ? "ok" : "not ok", shape + 1, shape, ends[SOLVED],
               ends[REFUSED], ends[WRONG]);
    }
    printf("1..%d\n", SHAPES);
    return failures > 0;
}
#endif
