/* Many cases through the C interface: what is refused, and cases beside beams of their own. Reports in the Test Anything Protocol;
 * tests/languages/test_language_cases.py holds the digits against Python. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gapbeam.h"

static int checks, failures;

static void check(int good, const char *name)
{
    checks++;
    failures += !good;
    printf("%s %d - %s\n", good ? "ok" : "not ok", checks, name);
}

enum { CASES = 300, SUPPORTS = 3, LOADS = 2 };

int main(void)
{
    const double length[] = {2.0, 2.0}, EI[] = {100.0, 100.0}, x[] = {0.0, 1.0}, to[] = {4.0, 0.0}, value[] = {3.0, 5.0};
    const int node[] = {0, 1, 2}, side[] = {GAPBEAM_BOTH, GAPBEAM_BELOW, GAPBEAM_BOTH};
    const int kind[] = {GAPBEAM_DISTRIBUTED, GAPBEAM_FORCE};
    static double factors[CASES][LOADS], gaps[CASES][SUPPORTS], reaction[CASES][SUPPORTS], w[CASES][3], left[CASES][3], right[CASES][3];
    static int status[CASES], condition[CASES][SUPPORTS];
    double places[3], moved[SUPPORTS], once[SUPPORTS], own_gap[SUPPORTS] = {0.0, 0.0, 0.0};
    int nodes[SUPPORTS], state_of[SUPPORTS], wrong = 0, opens = 0;
    char message[200];
    gapbeam_model model;
    gapbeam_beam *beam = NULL, *alone = NULL;
    gapbeam_state *state = NULL;
    gapbeam_cases *cases = NULL;

    gapbeam_model_init(&model, sizeof model);
    model.spans = 2;
    model.length = length;
    model.EI = EI;
    model.supports = SUPPORTS;
    model.support_node = node;
    model.support_side = side;
    model.loads = LOADS;
    model.load_kind = kind;
    model.load_x = x;
    model.load_to = to;
    model.load_value = value;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_SOLVED && gapbeam_new_state(&state) == 0, "a beam");
    check(gapbeam_get_nodes(beam, places, nodes) == GAPBEAM_SOLVED && places[1] == 2.0 && nodes[2] == 2, "its nodes");
    check(gapbeam_get_nodes(beam, NULL, NULL) == GAPBEAM_SOLVED && gapbeam_get_nodes(NULL, places, nodes) == GAPBEAM_NOT_PREPARED,
          "or none");
    check(gapbeam_prepare_cases(NULL, &cases, message, sizeof message) == GAPBEAM_NOT_PREPARED && !cases, "cases of no beam");
    check(gapbeam_prepare_cases(beam, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "no place for cases");
    check(gapbeam_prepare_cases(beam, &cases, message, sizeof message) == GAPBEAM_SOLVED && cases && !*message, "cases");

    for (int i = 0; i < CASES; i++) {
        factors[i][0] = 1.0 - 0.01 * (i % 250);
        factors[i][1] = 0.02 * (i % 97);
        gaps[i][0] = gaps[i][2] = 0.0;
        gaps[i][1] = 0.0005 * (i % 13);
    }
    check(gapbeam_solve_cases(beam, cases, CASES, factors[0], NULL, gaps[0], NULL, NULL, status, reaction[0], condition[0], w[0],
                              left[0], right[0], message, sizeof message) == GAPBEAM_SOLVED,
          "solved");
    for (int i = 0; i < CASES; i++) {
        /* A beam of its own: the gap in the model, the factors as a combination */
        own_gap[1] = gaps[i][1];
        model.support_gap = own_gap;
        gapbeam_beam *prepared = NULL;
        wrong += gapbeam_prepare(&model, &prepared, NULL, 0) || gapbeam_combine_loads(prepared, factors[i], NULL, &alone, NULL, 0);
        wrong += gapbeam_solve(alone, 1.0, NULL, state, NULL, 0) != status[i];
        wrong += gapbeam_get_supports(alone, state, once, moved, NULL, NULL, state_of) != GAPBEAM_SOLVED;
        for (int k = 0; k < SUPPORTS; k++) {
            wrong += fabs(once[k] - reaction[i][k]) > 1e-13 * 20.0 || fabs(moved[k] - w[i][k]) > 1e-13 * 0.01;
            wrong += state_of[k] != condition[i][k];
        }
        opens += condition[i][1] == GAPBEAM_OPEN;
        gapbeam_free_beam(alone);
        gapbeam_free_beam(prepared);
    }
    check(wrong == 0, "as beams of their own");
    check(opens > 20 && opens < CASES - 20, "open and closed");

    status[0] = -7;
    check(gapbeam_solve_cases(beam, cases, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0) == 0, "none");
    check(gapbeam_solve_cases(beam, cases, -1, factors[0], NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, message,
                              sizeof message) == GAPBEAM_BAD_INPUT && !strcmp(message, "count is negative"), "less than none");
    check(gapbeam_solve_cases(beam, cases, 1, NULL, NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, message,
                              sizeof message) == GAPBEAM_BAD_INPUT && !strcmp(message, "factors or status is NULL"), "no factors");
    check(gapbeam_solve_cases(beam, NULL, 1, factors[0], NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, NULL, 0)
          == GAPBEAM_NOT_PREPARED, "no cases");
    check(gapbeam_solve_cases(NULL, cases, 1, factors[0], NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, NULL, 0)
          == GAPBEAM_NOT_PREPARED, "no beam");
    check(gapbeam_solve_cases(beam, (gapbeam_cases *)beam, 1, factors[0], NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL,
                              NULL, NULL, 0) == GAPBEAM_NOT_PREPARED, "another handle");
    gaps[1][0] = 0.5;
    check(gapbeam_solve_cases(beam, cases, 2, factors[0], NULL, gaps[0], NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, message,
                              sizeof message) == GAPBEAM_BAD_INPUT
              && strstr(message, "case 2, support 1 of 3: gap: expected 0, as only a support of side below or above has a gap"),
          "a gap of a support that holds both ways");
    check(status[0] == -7, "nothing was written");
    check(gapbeam_solve_cases(beam, cases, 1, factors[0], NULL, NULL, NULL, NULL, status, NULL, NULL, NULL, NULL, NULL, NULL, 0) == 0
              && status[0] == GAPBEAM_SOLVED, "statuses alone");

    gapbeam_free_cases(cases);
    gapbeam_free_cases(NULL);
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    printf("1..%d\n", checks);
    return failures != 0;
}
