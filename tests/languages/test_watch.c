/* Calls that take long end from outside: by a question that they ask, by another thread, by a time limit. Then the beam is as it was.
 * Reports in the Test Anything Protocol. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "gapbeam.h"

enum { SPANS = 2000, ON_GROUND = 400, CASES = 200000, TIMES = 30000 };

static int tests, failures;

static void check(int good, const char *what)
{
    tests++;
    failures += !good;
    printf("%s %d - %s\n", good ? "ok" : "not ok", tests, what);
}

static double now(void)
{
    struct timespec time;
    timespec_get(&time, TIME_UTC);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double length[SPANS], EI[SPANS], gap[SPANS + 1], stiffness[SPANS + 1], load_x[2], load_to[2], value[2];
static int node[SPANS + 1], side[SPANS + 1];

/* Many one-sided supports with gaps, or one-sided ground with a curve for a law, below weight and a force */
static gapbeam_beam *prepare(int on_ground)
{
    static const double parameter[] = {50.0, 0.3, 0.0};
    static const int below[] = {GAPBEAM_BELOW}, law[] = {GAPBEAM_LAW_TANH};
    static const int kind[] = {GAPBEAM_DISTRIBUTED, GAPBEAM_FORCE}, load_case[] = {GAPBEAM_DEAD, GAPBEAM_LIVE};
    const int spans = on_ground ? ON_GROUND : SPANS;
    gapbeam_model model;
    gapbeam_beam *beam = NULL;
    gapbeam_model_init(&model, sizeof model);
    for (int i = 0; i < spans; i++) {
        length[i] = 1.0;
        EI[i] = 1e4;
    }
    for (int i = 0; i <= spans; i++) {
        node[i] = i;
        side[i] = GAPBEAM_BELOW;
        gap[i] = 1e-4 * (i * 37 % 101);
        stiffness[i] = 5e3;
    }
    load_to[0] = spans;
    load_x[1] = spans / 2 + 0.25;
    value[0] = 0.1;
    value[1] = 400.0;
    model.spans = spans;
    model.length = length;
    model.EI = EI;
    if (on_ground) {
        model.foundations = 1;
        model.foundation_side = below;
        model.foundation_law = law;
        model.foundation_parameter = parameter;
        value[1] = 20.0;
    } else {
        model.supports = spans + 1;
        model.support_node = node;
        model.support_side = side;
        model.support_gap = gap;
        model.support_stiffness = stiffness;
    }
    model.loads = 2;
    model.load_kind = kind;
    model.load_case = load_case;
    model.load_x = load_x;
    model.load_to = load_to;
    model.load_value = value;
    if (gapbeam_prepare(&model, &beam, NULL, 0))
        exit(1);
    return beam;
}

/* Calls that take long, again and again; the status of the first that is ended, or 0 */
enum call { SOLVE, FOLLOW, HISTORY, ON_THE_GROUND, FOLLOW_ON_THE_GROUND, TRAIN, TRAIN_EXTREMES, MANY_CASES, CERTIFICATE, CALLS };
static const char *const names[] = {"solve", "follow the load", "follow a history", "solve on the ground",
    "follow the load on the ground", "follow a train", "extremes of a train", "many cases", "certificate"};

static int make(enum call call, gapbeam_beam *beam)
{
    const double factors[] = {1.0, 0.0, 1.0}, distance[] = {0.0, 3.0, 7.5}, force[] = {30.0, 30.0, 20.0};
    const double from = SPANS / 2, to = SPANS / 2 + 2.0;
    gapbeam_certificate certificate = {.size = sizeof certificate};
    gapbeam_state *state = NULL;
    gapbeam_history *history = NULL;
    gapbeam_passing *passing = NULL;
    gapbeam_cases *cases = NULL;
    double *shares = NULL;
    int *ends = NULL, status = gapbeam_new_state(&state);
    if (call == CERTIFICATE && !status)
        status = gapbeam_solve(beam, 1.0, NULL, state, NULL, 0);
    if (call == TRAIN_EXTREMES && !status)
        status = gapbeam_follow_train(beam, 3, distance, force, 0.0, 0, &from, &to, &passing, NULL, 0);
    if (call == MANY_CASES) {
        shares = calloc(2 * CASES, sizeof *shares);
        ends = calloc(CASES, sizeof *ends);
        for (int i = 0; shares && i < 2 * CASES; i++)
            shares[i] = 1.0 + 1e-3 * (i % 7);
        status = shares && ends ? gapbeam_prepare_cases(beam, &cases, NULL, 0) : GAPBEAM_NO_MEMORY;
    }
    for (int i = 0; i < TIMES && !status; i++) {
        switch (call) {
        case SOLVE: case ON_THE_GROUND:
            status = gapbeam_solve(beam, 1.0 + 1e-3 * (i % 13), NULL, state, NULL, 0);
            break;
        case FOLLOW:
            status = gapbeam_follow(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, state, NULL, 0);
            break;
        case HISTORY:
            gapbeam_free_history(history);
            status = gapbeam_follow_history(beam, 3, factors, GAPBEAM_LIMIT_STOP, &history, NULL, 0);
            break;
        case FOLLOW_ON_THE_GROUND:
            status = gapbeam_follow_ground(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, state, NULL, 0);
            break;
        case TRAIN:
            gapbeam_free_passing(passing);
            status = gapbeam_follow_train(beam, 3, distance, force, 0.0, 0, NULL, NULL, &passing, NULL, 0);
            break;
        case TRAIN_EXTREMES:
            status = gapbeam_get_train_extremes(beam, passing, NULL, NULL);
            break;
        case MANY_CASES:
            status = gapbeam_solve_cases(beam, cases, CASES, shares, NULL, NULL, NULL, NULL, ends, NULL, NULL, NULL, NULL, NULL,
                                         NULL, 0);
            break;
        default:
            status = gapbeam_get_certificate(beam, state, &certificate, NULL);
        }
    }
    free(ends);
    free(shares);
    gapbeam_free_cases(cases);
    gapbeam_free_passing(passing);
    gapbeam_free_history(history);
    gapbeam_free_state(state);
    return status;
}

static int asked;
static double last_asked;

static int after_some(void *data)
{
    last_asked = now();
    return ++asked > *(int *)data;
}

static void *stop_soon(void *beam)
{
    const struct timespec soon = {0, 200000000};
    nanosleep(&soon, NULL);
    last_asked = now();
    gapbeam_stop(beam);
    return NULL;
}

int main(void)
{
    gapbeam_beam *on_supports = prepare(0), *on_ground = prepare(1);
    char text[100];
    int some = 12;

    for (int call = 0; call < CALLS; call++) {
        gapbeam_beam *beam = call == ON_THE_GROUND || call == FOLLOW_ON_THE_GROUND ? on_ground : on_supports;
        asked = 0;
        gapbeam_set_watch(beam, after_some, &some, INFINITY);
        int status = make(call, beam);
        double late = now() - last_asked;
        snprintf(text, sizeof text, "%s: ended by a question (%d, after %.3f s)", names[call], status, late);
        check(status == GAPBEAM_STOPPED && asked == some + 1 && late < 1.0, text);
        status = make(call, beam);
        snprintf(text, sizeof text, "%s: and so it stays (%d)", names[call], status);
        check(status == GAPBEAM_STOPPED, text);
        gapbeam_set_watch(beam, NULL, NULL, 0.2);
        const double begin = now();
        status = make(call, beam);
        late = now() - begin - 0.2;
        snprintf(text, sizeof text, "%s: ended by a time limit (%d, after %.3f s)", names[call], status, late);
        check(status == GAPBEAM_STOPPED && late > -0.05 && late < 1.0, text);
    }

    /* By another thread; then all is as before */
    pthread_t thread;
    gapbeam_state *state = NULL;
    double before[SPANS + 1], after[SPANS + 1];
    gapbeam_new_state(&state);
    gapbeam_set_watch(on_supports, NULL, NULL, INFINITY);
    check(gapbeam_solve(on_supports, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved");
    gapbeam_get_supports(on_supports, state, before, NULL, NULL, NULL, NULL);
    pthread_create(&thread, NULL, stop_soon, on_supports);
    int status = make(FOLLOW, on_supports);
    double late = now() - last_asked;
    pthread_join(thread, NULL);
    check(status == GAPBEAM_STOPPED && late < 1.0, "ended by another thread");
    check(gapbeam_solve(on_supports, 1.0, NULL, state, text, sizeof text) == GAPBEAM_STOPPED, text);
    check(gapbeam_get_supports(on_supports, state, after, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "its state is none");
    gapbeam_set_watch(on_supports, NULL, NULL, INFINITY);
    check(gapbeam_solve(on_supports, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved again");
    gapbeam_get_supports(on_supports, state, after, NULL, NULL, NULL, NULL);
    int same = 1;
    for (int i = 0; i <= SPANS; i++)
        same = same && before[i] >= after[i] && before[i] <= after[i];
    check(same, "to the last digit");

    /* What is refused */
    check(gapbeam_set_watch(NULL, NULL, NULL, 1.0) == GAPBEAM_NOT_PREPARED, "no beam");
    check(gapbeam_set_watch(on_supports, NULL, NULL, -1.0) == GAPBEAM_BAD_INPUT, "a negative time");
    check(gapbeam_set_watch(on_supports, NULL, NULL, NAN) == GAPBEAM_BAD_INPUT, "a time that is none");
    gapbeam_stop(NULL);

    gapbeam_free_state(state);
    gapbeam_free_beam(on_supports);
    gapbeam_free_beam(on_ground);
    printf("1..%d\n", tests);
    return failures > 0;
}
