/* The C interface: what is refused and how, closed forms, other loads, events, motion, and that the caller's floating-point
 * environment is as it was. Reports in the Test Anything Protocol. */
#define _GNU_SOURCE /* feenableexcept */
#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gapbeam.h"

static int checks, failures;

static void check(int good, const char *name)
{
    checks++;
    failures += !good;
    printf("%s %d - %s\n", good ? "ok" : "not ok", checks, name);
}

static void check_close(double found, double expected, const char *name)
{
    int good = fabs(found - expected) <= 1e-13 * fabs(expected);
    if (!good)
        fprintf(stderr, "%s: %.17g, expected %.17g\n", name, found, expected);
    check(good, name);
}

/* Spans of 2 and 2, EI 100; simple supports at the ends, one from below with a gap in the middle */
static const double length[] = {2.0, 2.0}, EI[] = {100.0, 100.0}, gap[] = {0.0, 0.001, 0.0}, x3[] = {0.0, 2.0, 4.0};
static const int node[] = {0, 1, 2}, side[] = {GAPBEAM_BOTH, GAPBEAM_BELOW, GAPBEAM_BOTH};
static const int distributed[] = {GAPBEAM_DISTRIBUTED};
static const double zero[] = {0.0}, four[] = {4.0}, three[] = {3.0};

static gapbeam_model two_spans(void)
{
    gapbeam_model model;
    gapbeam_model_init(&model, sizeof model);
    model.spans = 2;
    model.length = length;
    model.EI = EI;
    model.supports = 3;
    model.support_node = node;
    model.support_side = side;
    model.support_gap = gap;
    model.loads = 1;
    model.load_kind = distributed;
    model.load_x = zero;
    model.load_to = four;
    model.load_value = three;
    return model;
}

static int prepare(const gapbeam_model *model, gapbeam_beam **beam)
{
    char message[200];
    int status = gapbeam_prepare(model, beam, message, sizeof message);
    if (status != GAPBEAM_SOLVED)
        fprintf(stderr, "%s\n", message);
    return status;
}

static void refused_arguments(void)
{
    gapbeam_model model = two_spans(), other = model;
    gapbeam_options options, old;
    gapbeam_info info = {0};
    gapbeam_certificate certificate = {0};
    gapbeam_beam *beam = (gapbeam_beam *)&model;
    gapbeam_state *state = NULL;
    char message[200] = "?";
    double r[3] = {7.0, 7.0, 7.0}, fields[6];

    check(gapbeam_model_init(NULL, sizeof model) == GAPBEAM_BAD_INPUT, "no model");
    check(gapbeam_model_init(&other, sizeof model - 8) == GAPBEAM_OTHER_VERSION, "model of another size");
    check(other.spans == 2 && other.length == length && other.loads == 1, "and left as it is");
    check(gapbeam_options_init(NULL, sizeof options) == GAPBEAM_BAD_INPUT, "no options");
    check(gapbeam_options_init(&options, 4) == GAPBEAM_OTHER_VERSION, "options of another size");
    check(gapbeam_options_init(&options, sizeof options) == GAPBEAM_SOLVED && options.rule == GAPBEAM_RULE_BLOCK, "options");
    check(gapbeam_prepare(NULL, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && !beam, "prepare: no model");
    check(strstr(message, "NULL") != NULL, "and says so");
    check(gapbeam_prepare(&model, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "prepare: no handle");
    other.size = 0;
    check(gapbeam_prepare(&other, &beam, NULL, 0) == GAPBEAM_OTHER_VERSION && !beam, "prepare: model not initialised");
    other = model;
    other.spans = -1;
    check(gapbeam_prepare(&other, &beam, NULL, 0) == GAPBEAM_BAD_INPUT, "prepare: negative number");
    other = model;
    other.load_value = NULL;
    check(gapbeam_prepare(&other, &beam, NULL, 0) == GAPBEAM_BAD_INPUT, "prepare: an array is missing");
    other.load_value = three;
    other.load_to = zero;
    check(gapbeam_prepare(&other, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "prepare: a stretch without length");
    check(!strncmp(message, "load 1 of 1: ", 13), "names the load");
    check(gapbeam_prepare(&other, &beam, message, 5) == GAPBEAM_BAD_INPUT && !strcmp(message, "load"), "a short message");
    check(gapbeam_prepare(&other, &beam, message, 0) == GAPBEAM_BAD_INPUT && !strcmp(message, "load"), "no room for one");

    check(gapbeam_new_state(NULL) == GAPBEAM_BAD_INPUT, "new state: no handle");
    check(gapbeam_new_state(&state) == GAPBEAM_SOLVED, "new state");
    check(gapbeam_solve(NULL, 1.0, NULL, state, NULL, 0) == GAPBEAM_NOT_PREPARED, "solve: no beam");
    check(gapbeam_solve((gapbeam_beam *)state, 1.0, NULL, state, NULL, 0) == GAPBEAM_NOT_PREPARED, "solve: state for beam");
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "prepare");
    check(gapbeam_solve(beam, 1.0, NULL, NULL, NULL, 0) == GAPBEAM_NOT_PREPARED, "solve: no state");
    check(gapbeam_solve(beam, NAN, NULL, state, NULL, 0) == GAPBEAM_BAD_INPUT, "solve: factor is no number");
    old = options;
    old.size = 3;
    check(gapbeam_solve(beam, 1.0, &old, state, NULL, 0) == GAPBEAM_OTHER_VERSION, "solve: options of another size");
    options.rule = 5;
    check(gapbeam_solve(beam, 1.0, &options, state, message, sizeof message) == GAPBEAM_BAD_INPUT, "solve: no such rule");
    check(strstr(message, "got 5") != NULL, "names the value");
    check(gapbeam_follow(beam, 0.0, NULL, 0, NULL, NULL, NULL, NULL, state, NULL, 0) == GAPBEAM_BAD_INPUT, "follow: to 0");
    info.size = sizeof info;
    check(gapbeam_get_info(state, &info) == GAPBEAM_NOT_PREPARED, "info: nothing solved");
    check(gapbeam_get_info(state, NULL) == GAPBEAM_BAD_INPUT, "info: no structure");
    check(gapbeam_get_supports(beam, state, r, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "supports: nothing solved");
    check(r[0] == 7.0 && r[1] == 7.0 && r[2] == 7.0, "and nothing written");
    check(gapbeam_get_motion(beam, state, r, r) == GAPBEAM_NOT_PREPARED, "motion: nothing solved");
    check(gapbeam_solve(beam, 1.0, NULL, state, message, sizeof message) == GAPBEAM_SOLVED && !message[0], "solve");
    info.size = 1;
    check(gapbeam_get_info(state, &info) == GAPBEAM_OTHER_VERSION, "info: another size");
    check(gapbeam_get_certificate(beam, state, &certificate, NULL) == GAPBEAM_OTHER_VERSION, "certificate: no size");
    check(gapbeam_get_certificate(beam, state, NULL, NULL) == GAPBEAM_BAD_INPUT, "certificate: no structure");
    check(gapbeam_get_motion(beam, state, r, r) == GAPBEAM_NOT_PREPARED, "motion: it does not move");
    check(gapbeam_get_fields(beam, state, 1, &x3[2], 0, fields, NULL, 0) == GAPBEAM_SOLVED, "fields");
    fields[0] = 5.0;
    const double off = 4.1;
    check(gapbeam_get_fields(beam, state, 1, &off, 0, fields, message, sizeof message) == GAPBEAM_BAD_INPUT, "off the beam");
    check(fields[0] == 5.0 && strstr(message, "4.1") != NULL, "nothing written, place named");
    check(gapbeam_get_fields(beam, state, -1, x3, 0, fields, NULL, 0) == GAPBEAM_BAD_INPUT, "fields: negative number");
    check(gapbeam_get_fields(beam, state, 1, NULL, 0, fields, NULL, 0) == GAPBEAM_BAD_INPUT, "fields: no places");
    check(gapbeam_solve(beam, INFINITY, NULL, state, NULL, 0) == GAPBEAM_BAD_INPUT, "solve: infinite factor");
    check(gapbeam_get_fields(beam, state, 1, x3, 0, fields, NULL, 0) == GAPBEAM_NOT_PREPARED, "and no old result is shown");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    gapbeam_free_state(NULL);
    gapbeam_free_beam(NULL);
    check(gapbeam_count_supports(NULL) == 0 && gapbeam_count_nodes(NULL) == 0, "counts of nothing");
}

/* Two spans with a gap in the middle: the deflection without the support is 5 q L^4 / 384 EI = 0.1 at factor 1 */
static void closed_form(void)
{
    gapbeam_model model = two_spans();
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    double reaction[3], opening[3], deflection[3], fields[6], at = 0.0;
    int condition[3], support = -1, what = -1, number = -1, undecided[3];
    const double free_deflection = 5.0 * 3.0 * 256.0 / (384.0 * 100.0), flexibility = 64.0 / (48.0 * 100.0);
    const double middle = (free_deflection - 0.001) / flexibility;

    check(prepare(&model, &beam) == GAPBEAM_SOLVED && gapbeam_new_state(&state) == GAPBEAM_SOLVED, "two spans");
    check(gapbeam_count_supports(beam) == 3 && gapbeam_count_nodes(beam) == 3, "counts");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved");
    check(gapbeam_get_supports(beam, state, reaction, deflection, opening, NULL, condition) == GAPBEAM_SOLVED, "supports");
    check_close(reaction[1], middle, "reaction past the gap");
    check_close(reaction[0], (12.0 - middle) / 2.0, "reaction at the end");
    check_close(deflection[1], 0.001, "the gap is closed");
    check(condition[0] == GAPBEAM_BILATERAL && condition[1] == GAPBEAM_CLOSED && opening[1] == 0.0, "condition");
    gapbeam_get_fields(beam, state, 1, &x3[1], 1, fields, NULL, 0);
    check_close(fields[GAPBEAM_SHEAR], reaction[0] - 6.0, "shear left of the support");
    gapbeam_get_fields(beam, state, 1, &x3[1], 0, fields, NULL, 0);
    check_close(fields[GAPBEAM_SHEAR], reaction[0] - 6.0 + reaction[1], "shear right of it");
    check_close(fields[GAPBEAM_MOMENT], 2.0 * reaction[0] - 6.0, "moment");
    gapbeam_certificate certificate = {.size = sizeof certificate};
    check(gapbeam_get_certificate(beam, state, &certificate, undecided) == GAPBEAM_SOLVED, "certificate");
    check(certificate.known && certificate.deflection_bound < 1e-12 && certificate.equilibrium < 1e-14, "its numbers");
    check(!undecided[0] && !undecided[1] && !undecided[2], "nothing undecided");
    check(gapbeam_follow(beam, 1.0, NULL, 1, &at, &support, &what, &number, state, NULL, 0) == GAPBEAM_SOLVED, "follow");
    check(number == 1 && support == 1 && what == GAPBEAM_CLOSED, "one event");
    check_close(at, 0.001 / free_deflection, "its load factor");

    /* Other values, then other places: the same as a beam prepared with them */
    const double six[] = {6.0};
    model.load_value = six;
    model.load_value_to = zero;
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "other values");
    check(gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "a state of the old ones");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved again");
    gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL);
    check_close(reaction[1], middle, "a triangle of twice the height does the same in the middle");
    const double one[] = {1.0}, force[] = {25.0};
    const int at_x[] = {GAPBEAM_FORCE};
    model.load_kind = at_x;
    model.load_x = one;
    model.load_value = force;
    model.load_value_to = NULL;
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "another load elsewhere");
    check(gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "old state refused");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved with it");
    gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL);
    /* P a (3 L^2 - 4 a^2) / 48 EI in the middle */
    check_close(reaction[1], (25.0 * (3.0 * 16.0 - 4.0) / 4800.0 - 0.001) / flexibility, "force beside the middle");
    model.load_x = x3 + 2;
    model.load_kind = (const int[]){77};
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_BAD_INPUT, "a bad load");
    double again[3];
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "the beam has its old loads");
    gapbeam_get_supports(beam, state, again, NULL, NULL, NULL, NULL);
    check(!memcmp(again, reaction, sizeof again), "to the last digit");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
}

/* Beyond the last support the places of loads are nodes, so other loads may make more or fewer of them */
static void counts_after_other_loads(void)
{
    const int force[] = {GAPBEAM_FORCE};
    const double places[] = {3.0, 4.0, 1.0};
    const int nodes[] = {4, 3, 3};
    gapbeam_model model = two_spans();
    gapbeam_beam *beam = NULL;

    model.supports = 2;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED && gapbeam_count_nodes(beam) == 3, "ends and supports");
    model.load_kind = force;
    for (int k = 0; k < 3; k++) {
        model.load_x = &places[k];
        check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "a force elsewhere");
        check(gapbeam_count_nodes(beam) == nodes[k] && gapbeam_count_supports(beam) == 2, "its node, the same supports");
    }
    gapbeam_free_beam(beam);
}

/* A plank on two supports from below, pushed down beyond the right one */
static void no_equilibrium(void)
{
    const int below[] = {GAPBEAM_BELOW, GAPBEAM_BELOW}, nodes[] = {0, 1}, kinds[] = {GAPBEAM_DISTRIBUTED, GAPBEAM_FORCE};
    const int cases[] = {GAPBEAM_DEAD, GAPBEAM_LIVE};
    const double start[] = {0.0, 4.0}, end[] = {4.0, 0.0}, value[] = {1.0, 10.0};
    double x[3], motion[3], reaction[2] = {7.0, 7.0};
    gapbeam_model model = two_spans();
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    gapbeam_info info = {.size = sizeof info};

    model.supports = 2;
    model.support_node = nodes;
    model.support_side = below;
    model.support_gap = NULL;
    model.loads = 2;
    model.load_kind = kinds;
    model.load_case = cases;
    model.load_x = start;
    model.load_to = end;
    model.load_value = value;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED && gapbeam_new_state(&state) == GAPBEAM_SOLVED, "a plank");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_NO_EQUILIBRIUM, "tips");
    check(gapbeam_get_motion(beam, state, x, motion) == GAPBEAM_SOLVED, "motion");
    check(x[0] == 0.0 && x[1] == 2.0 && x[2] == 4.0 && motion[0] == -1.0 && motion[1] == 0.0 && motion[2] == 1.0,
          "about the right support");
    check(gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "no reactions");
    check(reaction[0] == 7.0, "nothing written");
    check(gapbeam_follow(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, state, NULL, 0) == GAPBEAM_NO_EQUILIBRIUM, "followed");
    check(gapbeam_get_info(state, &info) == GAPBEAM_SOLVED && info.status == GAPBEAM_NO_EQUILIBRIUM, "info");
    check(fabs(info.factor) <= 1e-15, "the plank balances on its middle, so it tips from the start");
    check(gapbeam_solve_model(&model, 1.0, NULL, reaction, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, 0)
              == GAPBEAM_NO_EQUILIBRIUM, "in one call");
    check(reaction[0] == 7.0, "nothing written either");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
}

/* Cantilevers and simple beams, all loads, in one call each */
static void all_loads(void)
{
    const int kinds[] = {GAPBEAM_FORCE, GAPBEAM_COUPLE, GAPBEAM_DISTRIBUTED, GAPBEAM_DISTRIBUTED,
                                             GAPBEAM_CURVATURE, GAPBEAM_AXIAL_FORCE};
    const double rigid[] = {INFINITY, 0.0}, l[] = {3.0}, ei[] = {50.0}, ga[] = {20.0}, ea[] = {40.0}, tip[] = {3.0};
    const double begin[] = {3.0, 3.0, 0.0, 0.0, 0.0, 3.0};
    const double value[] = {2.0, 5.0, 4.0, 0.0, 0.01, 8.0}, value_to[] = {0.0, 0.0, 4.0, 6.0, 0.0, 0.0};
    const double expected[] = {2.0 * 27 / (3 * 50.0) + 2.0 * 3 / 20.0, 5.0 * 9 / (2 * 50.0),
                               4.0 * 81 / (8 * 50.0) + 4.0 * 9 / (2 * 20.0), 11 * 6.0 * 81 / (120 * 50.0) + 6.0 * 9 / (3 * 20.0),
                               0.01 * 9 / 2, 8.0 * 3 / 40.0};
    const char *names[] = {"force", "couple", "uniform", "triangle", "curvature", "axial"};
    const int both_nodes[] = {0, 0}, directions[] = {GAPBEAM_NORMAL, GAPBEAM_AXIAL};
    double reaction[2], couple[2], fields[6];

    for (int k = 0; k < 6; k++) {
        gapbeam_model model;
        gapbeam_model_init(&model, sizeof model);
        model.spans = 1;
        model.length = l;
        model.EI = ei;
        model.GA = ga;
        model.EA = ea;
        model.supports = 2;
        model.support_node = both_nodes;
        model.support_rotation = rigid;
        model.support_direction = directions;
        model.loads = 1;
        model.load_kind = kinds + k;
        model.load_x = begin + k;
        model.load_to = l;
        model.load_value = value + k;
        model.load_value_to = value_to + k;
        check(gapbeam_solve_model(&model, 1.0, NULL, reaction, NULL, NULL, couple, NULL, 1, tip, fields, NULL, 0)
                  == GAPBEAM_SOLVED, names[k]);
        check_close(fields[k == 5 ? GAPBEAM_AXIAL_DISPLACEMENT : GAPBEAM_DEFLECTION], expected[k], "at the tip");
        if (k == 0)
            check_close(couple[0], -6.0, "couple of the clamp");
        if (k == 5)
            check_close(reaction[1], -8.0, "axial reaction");
    }
}

/* The caller's traps, rounding and flags survive, also where numbers leave the range; nothing is raised in between */
static void environment(void)
{
    gapbeam_model model = two_spans();
    const double huge[] = {1e300, 1e300}, large[] = {1e305};
    double reaction[3], usual[3];
    int status;

    check(gapbeam_solve_model(&model, 1.0, NULL, usual, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, 0) == 0, "usual");
    model.load_value = large;
    model.length = huge;
    model.load_to = huge;
    fesetround(FE_UPWARD);
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    const int traps = fegetexcept(); /* none under valgrind */
    status = gapbeam_solve_model(&model, 1.0, NULL, reaction, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, 0);
    check(status > 10, "numbers out of range are an error");
    check(fegetexcept() == traps, "traps are as they were");
    check(fegetround() == FE_UPWARD, "rounding is as it was");
    check(fetestexcept(FE_ALL_EXCEPT) == 0, "no flags are raised");
    model = two_spans();
    status = gapbeam_solve_model(&model, 1.0, NULL, reaction, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, 0);
    fedisableexcept(FE_ALL_EXCEPT);
    fesetround(FE_TONEAREST);
    check(status == 0 && !memcmp(reaction, usual, sizeof usual), "the same digits whatever the caller's rounding");
}

static void names_and_sizes(void)
{
    int major = -1, minor = -1, patch = -1;
    char text[40];
    gapbeam_get_version(&major, &minor, &patch);
    gapbeam_get_version(NULL, NULL, NULL);
    snprintf(text, sizeof text, "%d.%d.%d", major, minor, patch);
    check(!strcmp(text, gapbeam_version_text()) && !strcmp(text, GAPBEAM_VERSION), "version");
    check(major == GAPBEAM_VERSION_MAJOR && minor == GAPBEAM_VERSION_MINOR && patch == GAPBEAM_VERSION_PATCH, "its numbers");
    check(!strcmp(gapbeam_status_message(GAPBEAM_SOLVED), "solved"), "a status in words");
    check(!strcmp(gapbeam_status_message(-5), "unknown status"), "an unknown one");
    check(isinf(gapbeam_infinity()) && gapbeam_infinity() > 0.0, "infinity");
    /* The init functions compare the sizes of two structures, the get functions those of the others */
    _Static_assert(sizeof(gapbeam_model) == 200 || sizeof(void *) != 8, "gapbeam_model is part of the ABI");
    _Static_assert(sizeof(gapbeam_options) == 16 || sizeof(void *) != 8, "gapbeam_options is part of the ABI");
    _Static_assert(sizeof(gapbeam_info) == 40 || sizeof(void *) != 8, "gapbeam_info is part of the ABI");
    _Static_assert(sizeof(gapbeam_certificate) == 88 || sizeof(void *) != 8, "gapbeam_certificate is part of the ABI");
}

int main(void)
{
    refused_arguments();
    closed_form();
    counts_after_other_loads();
    no_equilibrium();
    all_loads();
    environment();
    names_and_sizes();
    printf("1..%d\n", checks);
    return failures > 0;
}
