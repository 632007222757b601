/* Many threads solve different beams, and the same prepared beam, at once; every digit is that of one thread alone. Reports in
 * the Test Anything Protocol. Usage: test_threads [ROUNDS] */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gapbeam.h"

enum { THREADS = 8, BEAMS = 24, MOST = 40, EVENTS = 200 };

/* A beam on supports from below with gaps that differ from beam to beam, and all that was found of it */
typedef struct {
    int spans;
    double length[MOST], EI[MOST], gap[MOST + 1], value[2], x[2], to[2];
    int node[MOST + 1], side[MOST + 1];
    int status, events, failed;
    double reaction[MOST + 1], opening[MOST + 1], field[6], factor[EVENTS], bound, extreme[6][2], place[6][2];
} problem;

static void describe(problem *p, int number)
{
    memset(p, 0, sizeof *p);
    p->spans = 3 + (7 * number) % (MOST - 3);
    for (int i = 0; i < p->spans; i++) {
        p->length[i] = 2.0 + 0.1 * ((i * 13 + number) % 17);
        p->EI[i] = 100.0 + (i * 5 + number) % 11;
    }
    for (int i = 0; i <= p->spans; i++) {
        p->node[i] = i;
        p->side[i] = i % 4 == 3 ? GAPBEAM_ABOVE : GAPBEAM_BELOW;
        p->gap[i] = 1e-4 * ((i * 29 + number * 3) % 23);
    }
    p->side[0] = p->side[p->spans] = GAPBEAM_BOTH;
    p->gap[0] = p->gap[p->spans] = 0.0;
    p->value[0] = 3.0 + number;
    p->value[1] = 40.0 - number;
    p->x[1] = 3.0;
    for (int i = 0; i < p->spans; i++)
        p->to[0] += p->length[i];
    p->to[0] *= 0.999;
}

static int prepare(const problem *p, gapbeam_beam **beam)
{
    static const int kind[] = {GAPBEAM_DISTRIBUTED, GAPBEAM_FORCE};
    gapbeam_model model;
    gapbeam_model_init(&model, sizeof model);
    model.spans = p->spans;
    model.length = p->length;
    model.EI = p->EI;
    model.supports = p->spans + 1;
    model.support_node = p->node;
    model.support_side = p->side;
    model.support_gap = p->gap;
    model.loads = 2;
    model.load_kind = kind;
    model.load_x = p->x;
    model.load_to = p->to;
    model.load_value = p->value;
    return gapbeam_prepare(&model, beam, NULL, 0);
}

/* Solve with a beam of its own, or with one that others use as well */
static void solve(problem *p, const gapbeam_beam *shared)
{
    const double place = 1.5;
    gapbeam_beam *own = NULL;
    gapbeam_state *state = NULL;
    gapbeam_certificate certificate = {.size = sizeof certificate};

    p->failed = !shared && prepare(p, &own);
    const gapbeam_beam *beam = shared ? shared : own;
    p->failed |= gapbeam_new_state(&state);
    p->status = gapbeam_solve(beam, 1.0, NULL, state, NULL, 0);
    p->failed |= gapbeam_get_supports(beam, state, p->reaction, NULL, p->opening, NULL, NULL);
    p->failed |= gapbeam_get_fields(beam, state, 1, &place, 0, p->field, NULL, 0);
    p->failed |= gapbeam_get_extremes(beam, state, p->extreme, p->place);
    p->failed |= gapbeam_get_certificate(beam, state, &certificate, NULL);
    p->bound = certificate.reaction_bound;
    p->failed |= gapbeam_follow(beam, 1.0, NULL, EVENTS, p->factor, NULL, NULL, &p->events, state, NULL, 0);
    /* An error on the way, and its message, disturb nobody */
    p->failed |= gapbeam_solve(beam, gapbeam_infinity(), NULL, state, NULL, 0) != GAPBEAM_BAD_INPUT;
    gapbeam_free_state(state);
    gapbeam_free_beam(own);
}

static problem alone[BEAMS];
static gapbeam_beam *common;

typedef struct {
    int first, rounds, different;
} work;

static void *run(void *argument)
{
    work *w = argument;
    problem *p = malloc(sizeof *p);
    for (int k = 0; k < w->rounds * BEAMS; k++) {
        int number = (w->first + k) % BEAMS;
        describe(p, number);
        solve(p, number == 0 ? common : NULL);
        w->different += memcmp(p, &alone[number], sizeof *p) != 0;
    }
    free(p);
    return NULL;
}

int main(int count, char **arguments)
{
    const int rounds = count > 1 ? atoi(arguments[1]) : 20;
    pthread_t threads[THREADS];
    work works[THREADS];
    int failed = 0, different = 0, events = 0;

    for (int i = 0; i < BEAMS; i++) {
        describe(&alone[i], i);
        solve(&alone[i], NULL);
        failed += alone[i].failed || alone[i].status != GAPBEAM_SOLVED;
        events += alone[i].events;
    }
    failed += prepare(&alone[0], &common);
    for (int i = 0; i < THREADS; i++) {
        works[i] = (work){.first = 5 * i, .rounds = rounds};
        failed += pthread_create(&threads[i], NULL, run, &works[i]);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        different += works[i].different;
    }
    gapbeam_free_beam(common);
    printf("%s 1 - alone, all are solved\n", failed ? "not ok" : "ok");
    printf("%s 2 - and have events\n", events > BEAMS ? "ok" : "not ok");
    printf("%s 3 - in %d threads %d solves have the same digits\n", different ? "not ok" : "ok", THREADS,
           THREADS * rounds * BEAMS);
    printf("1..3\n");
    return failed || different || events <= BEAMS;
}
