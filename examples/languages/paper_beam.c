/* The paper's beam in C: prepared once, solved in ten load steps, followed from event to event.
 *
 *     cc paper_beam.c $(pkg-config --cflags --libs gapbeam) -o paper_beam
 *
 * The programs beside it do the same in Fortran, Fortran 77 and Python and print the same digits. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "gapbeam.h"

static void row(const char *name, const double *values, int count, int stride)
{
    printf("%-12s", name);
    for (int k = 0; k < count; k++)
        printf("%25.16E", values[k * stride]);
    printf("\n");
}

/* End of the program: free what there is, say what was wrong. */
static int quit(gapbeam_beam *beam, gapbeam_state *state, int status, const char *message)
{
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    if (status != GAPBEAM_SOLVED)
        fprintf(stderr, "%s: %s\n", gapbeam_status_message(status), message);
    return status == GAPBEAM_SOLVED ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(void)
{
    /* A clamped beam of three spans, in tf and m; the middle one of its one-sided supports lifts off */
    const double length[] = {2.0, 2.0, 2.0}, EI[] = {44.5, 44.5, 44.5};
    const int node[] = {0, 1, 2, 3};
    const int side[] = {GAPBEAM_BOTH, GAPBEAM_ABOVE, GAPBEAM_BELOW, GAPBEAM_BELOW};
    const double rotation[] = {INFINITY, 0.0, 0.0, 0.0};
    const int kind[] = {GAPBEAM_FORCE, GAPBEAM_FORCE, GAPBEAM_FORCE}, load_node[] = {1, 2, 3};
    const double force[] = {0.70707, -4.3597, 2.1155};
    const double x[] = {1.0, 3.0, 5.0};

    char message[256] = "";
    double reaction[4], deflection[4], opening[4], couple[4], fields[3][GAPBEAM_FIELDS];
    double value[GAPBEAM_FIELDS][2], place[GAPBEAM_FIELDS][2];
    int condition[4], events = 0;
    gapbeam_model model;
    gapbeam_certificate certificate = {.size = sizeof certificate};
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;

    int status = gapbeam_model_init(&model, sizeof model);
    model.spans = 3;
    model.length = length;
    model.EI = EI;
    model.supports = 4;
    model.support_node = node;
    model.support_side = side;
    model.support_rotation = rotation;
    model.loads = 3;
    model.load_kind = kind;
    model.load_node = load_node;
    model.load_value = force;
    if (status == GAPBEAM_SOLVED)
        status = gapbeam_prepare(&model, &beam, message, sizeof message);
    if (status == GAPBEAM_SOLVED)
        status = gapbeam_new_state(&state);
    for (int step = 1; step <= 10 && status == GAPBEAM_SOLVED; step++)
        status = gapbeam_solve(beam, step / 10.0, NULL, state, message, sizeof message);
    if (status != GAPBEAM_SOLVED)
        return quit(beam, state, status, message);

    gapbeam_get_supports(beam, state, reaction, deflection, opening, couple, condition);
    row("reaction", reaction, 4, 1);
    row("deflection", deflection, 4, 1);
    row("opening", opening, 4, 1);
    row("couple", couple, 4, 1);
    printf("%-12s%4d%4d%4d%4d\n", "condition", condition[0], condition[1], condition[2], condition[3]);
    gapbeam_get_fields(beam, state, 3, x, 0, &fields[0][0], message, sizeof message);
    row("moment", &fields[0][GAPBEAM_MOMENT], 3, GAPBEAM_FIELDS);
    row("shear", &fields[0][GAPBEAM_SHEAR], 3, GAPBEAM_FIELDS);
    row("rotation", &fields[0][GAPBEAM_ROTATION], 3, GAPBEAM_FIELDS);
    gapbeam_get_extremes(beam, state, value, place);
    row("largest", value[GAPBEAM_DEFLECTION], 2, 1);
    row("at", place[GAPBEAM_DEFLECTION], 2, 1);
    gapbeam_get_certificate(beam, state, &certificate, NULL);
    const double good[] = {certificate.equilibrium, certificate.compatibility, certificate.deflection_bound,
                           certificate.reaction_bound};
    row("certificate", good, 4, 1);
    status = gapbeam_follow(beam, 1.0, NULL, 0, NULL, NULL, NULL, &events, state, message, sizeof message);
    printf("%-12s%4d\n", "events", events);
    return quit(beam, state, status, message);
}
