/* The C interface: what is refused and how, closed forms, other loads, events, motion, and that the caller's floating-point
 * environment is as it was. Reports in the Test Anything Protocol. */
#define _GNU_SOURCE /* feenableexcept */
#include <fenv.h>
#include <limits.h>
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
    other.N_grows = -1;
    check(gapbeam_prepare(&other, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT
          && !strcmp(message, "model: N_grows: expected 0 or 1, got -1"), "prepare: no flag");
    other = model;
    other.with_trains = 3;
    check(gapbeam_prepare(&other, &beam, NULL, 0) == GAPBEAM_BAD_INPUT, "prepare: nor that one");
    other = model;
    other.load_value = NULL;
    check(gapbeam_prepare(&other, &beam, NULL, 0) == GAPBEAM_BAD_INPUT, "prepare: an array is missing");
    other.load_value = three;
    other.load_x = three;
    other.load_to = zero;
    check(gapbeam_prepare(&other, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "prepare: a stretch that ends before it begins");
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
    check(gapbeam_get_fields(beam, state, 1, x3, 7, fields, message, sizeof message) == GAPBEAM_BAD_INPUT
          && !strcmp(message, "from_left: expected 0 or 1, got 7"), "fields: no side");
    check(gapbeam_get_pressure(beam, state, 1, x3, -1, fields, NULL, 0) == GAPBEAM_BAD_INPUT, "pressure: no side");
    check(gapbeam_solve(beam, INFINITY, NULL, state, NULL, 0) == GAPBEAM_BAD_INPUT, "solve: infinite factor");
    check(gapbeam_get_fields(beam, state, 1, x3, 0, fields, NULL, 0) == GAPBEAM_NOT_PREPARED, "and no old result is shown");
    info.size = sizeof info;
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved again");
    check(gapbeam_solve(beam, 1.0, &old, state, NULL, 0) == GAPBEAM_OTHER_VERSION, "options of another size");
    check(gapbeam_get_info(state, &info) == GAPBEAM_NOT_PREPARED, "leave none either");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved again");
    check(gapbeam_follow(NULL, 1.0, NULL, 0, NULL, NULL, NULL, NULL, state, NULL, 0) == GAPBEAM_NOT_PREPARED, "nor does no beam");
    check(gapbeam_get_info(state, &info) == GAPBEAM_NOT_PREPARED, "leave one");
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

    /* A combination is a beam of its own: twice the load, then the support moved out of the way */
    {
        gapbeam_beam *combined;
        double two = 2.0, far[3] = {0.0, 1.0, 0.0}, once[3], twice[3];
        char message[200];

        gapbeam_get_supports(beam, state, once, NULL, NULL, NULL, NULL);
        check(gapbeam_combine_loads(beam, &two, NULL, &combined, NULL, 0) == GAPBEAM_SOLVED, "a combination");
        check(gapbeam_solve(combined, 0.5, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "half of twice the load");
        gapbeam_get_supports(combined, state, twice, NULL, NULL, NULL, NULL);
        check_close(twice[1], once[1], "is the load");
        gapbeam_free_beam(combined);
        check(gapbeam_combine_loads(beam, &two, far, &combined, NULL, 0) == GAPBEAM_SOLVED, "a support far below");
        check(gapbeam_solve(combined, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "is left alone");
        gapbeam_get_supports(combined, state, twice, NULL, NULL, NULL, NULL);
        check_close(twice[1], 0.0, "without reaction");
        gapbeam_free_beam(combined);
        two = INFINITY;
        check(gapbeam_combine_loads(beam, &two, NULL, &combined, message, sizeof message) == GAPBEAM_BAD_INPUT && !combined,
              "no factor");
        check(strstr(message, "factors[0]") != NULL, "which one");
        check(gapbeam_combine_loads(NULL, &two, NULL, &combined, NULL, 0) == GAPBEAM_NOT_PREPARED, "no beam");
        check(gapbeam_combine_loads(beam, NULL, NULL, &combined, NULL, 0) == GAPBEAM_BAD_INPUT, "no factors");
        check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "as before");
    }

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

/* A simple beam of stiffness 1 in the middle over a support that breaks at a displacement of 0.1 and a force of 1, a load of 2.2 on
 * it */
static gapbeam_model over_law(void)
{
    static const double ei[] = {4.0 / 3.0, 4.0 / 3.0}, load[] = {2.2}, displacement[] = {0.1, 0.1, 1.0}, force[] = {1.0, 0.0, 0.0};
    static const int kind[] = {GAPBEAM_FORCE}, support[] = {1, 1, 1};
    gapbeam_model model = two_spans();

    model.EI = ei;
    model.support_gap = NULL;
    model.load_kind = kind;
    model.load_x = &x3[1];
    model.load_value = load;
    model.law_points = 3;
    model.law_support = support;
    model.law_displacement = displacement;
    model.law_force = force;
    return model;
}

/* The load stops where the support breaks, or jumps on; a support that keeps a set; the structure of version 0.2 */
static void laws_and_histories(void)
{
    const double one[] = {1.0, 0.0}, yield_d[] = {0.1, 1.0}, yield_f[] = {1.0, 1.0};
    const int plastic[] = {GAPBEAM_ELASTIC, GAPBEAM_PLASTIC, GAPBEAM_ELASTIC};
    gapbeam_model model = over_law();
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    gapbeam_history *history = (gapbeam_history *)&model;
    gapbeam_history_info info = {.size = sizeof info - 4};
    char message[400];
    double factor[8], w[3], r[3], gap_left[3], from[8], to[8], x[3];
    int what[8], change[8], support[8], stretch[8], kind[1], landing[1], before[1], leg[8], direction[8], stable[8], skipped[8];
    int condition[3];

    check(prepare(&model, &beam) == GAPBEAM_SOLVED && gapbeam_new_state(&state) == GAPBEAM_SOLVED, "a support that breaks");
    check(gapbeam_solve(beam, 0.1, NULL, state, message, sizeof message) == GAPBEAM_BAD_INPUT, "solve refuses it");
    check(strstr(message, "follow_history") != NULL, "and says what to call");
    check(gapbeam_follow_history(NULL, 1, one, 0, &history, NULL, 0) == GAPBEAM_NOT_PREPARED && !history, "no beam");
    check(gapbeam_follow_history(beam, 1, one, 0, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "no handle");
    check(gapbeam_follow_history(beam, 0, one, 0, &history, NULL, 0) == GAPBEAM_BAD_INPUT, "no factors");
    check(gapbeam_follow_history(beam, 1, NULL, 0, &history, NULL, 0) == GAPBEAM_BAD_INPUT, "nor where they are");
    check(gapbeam_follow_history(beam, 1, one, 7, &history, message, sizeof message) == GAPBEAM_BAD_INPUT, "no such limit");
    check(strstr(message, "got 7") != NULL, "names the value");
    check(gapbeam_get_history_info(NULL, &info) == GAPBEAM_OTHER_VERSION, "info of another size");
    info.size = sizeof info;
    check(gapbeam_get_history_info(NULL, &info) == GAPBEAM_NOT_PREPARED, "info of nothing");
    check(gapbeam_get_history_info(NULL, NULL) == GAPBEAM_BAD_INPUT, "no info");
    check(gapbeam_get_stretches(NULL, from, to, leg, direction, stable, NULL, NULL, skipped) == GAPBEAM_NOT_PREPARED
              && gapbeam_get_events(NULL, factor, support, what, change, stretch) == GAPBEAM_NOT_PREPARED
              && gapbeam_get_limits(NULL, factor, kind, leg, before, landing) == GAPBEAM_NOT_PREPARED
              && gapbeam_get_history_motion(NULL, x, w) == GAPBEAM_NOT_PREPARED, "nothing of no history");
    check(gapbeam_solve_on_path(beam, NULL, -1, 0.5, state, NULL, 0) == GAPBEAM_NOT_PREPARED, "no state on it");
    check(gapbeam_get_released_energy(beam, NULL, 0, w, NULL, 0) == GAPBEAM_NOT_PREPARED, "no energy either");

    check(gapbeam_follow_history(beam, 1, one, GAPBEAM_LIMIT_STOP, &history, NULL, 0) == GAPBEAM_SOLVED, "followed");
    check(gapbeam_get_history_info(history, &info) == GAPBEAM_SOLVED && info.ending == GAPBEAM_PATH_ENDED, "it stops");
    check(info.limits == 1 && info.events == 1 && info.nodes == 0 && info.solves > 0, "at one limit");
    check(gapbeam_get_limits(history, factor, kind, leg, before, landing) == GAPBEAM_SOLVED, "limits");
    check_close(factor[0], 0.5, "its factor");
    check(kind[0] == GAPBEAM_LIMIT_POINT && leg[0] == 0 && before[0] == 0 && landing[0] > 0, "what it is");
    check(gapbeam_get_events(history, factor, support, what, change, stretch) == GAPBEAM_SOLVED, "events");
    check_close(factor[0], 0.5, "the support breaks there");
    check(support[0] == 1 && what[0] == GAPBEAM_BRANCH + 2 && change[0] == GAPBEAM_BREAKS && stretch[0] == 1, "that one");
    check(gapbeam_get_history_motion(history, x, w) == GAPBEAM_NOT_PREPARED, "no free motion");
    check(gapbeam_get_released_energy(beam, history, 1, w, message, sizeof message) == GAPBEAM_BAD_INPUT
          && !strcmp(message, "limit: expected 0 to 0, got 1"), "no such limit");
    check(gapbeam_get_released_energy(beam, history, INT_MAX, w, NULL, 0) == GAPBEAM_BAD_INPUT, "nor that one");
    check(gapbeam_get_released_energy(beam, history, 0, w, NULL, 0) == GAPBEAM_SOLVED, "energy");
    check_close(w[0], 0.5, "that the beam sets free");
    check(gapbeam_get_stretches(history, from, to, leg, direction, stable, NULL, NULL, skipped) == GAPBEAM_SOLVED, "stretches");
    check(from[0] == 0.0 && fabs(to[0] - 0.5) < 1e-15 && leg[0] == 0 && direction[0] == 1 && stable[0] && !skipped[0], "the first");
    check(direction[1] == -1 && !stable[1] && skipped[1], "the second");
    check(gapbeam_solve_on_path(beam, history, landing[0], 0.5, state, NULL, 0) == GAPBEAM_SOLVED, "the landing");
    gapbeam_get_supports(beam, state, r, w, NULL, NULL, condition);
    check_close(w[1], 1.1, "without the support");
    check(condition[1] == GAPBEAM_BRANCH + 3 && r[1] == 0.0, "which is broken");
    check(gapbeam_solve_on_path(beam, history, 99, 0.5, state, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "stretch: expected -1 to ") && strstr(message, ", got 99"), "no such stretch");
    check(gapbeam_solve_on_path(beam, history, INT_MAX, 0.5, state, NULL, 0) == GAPBEAM_BAD_INPUT, "nor that one");
    check(gapbeam_solve_on_path(beam, history, 1, 0.9, state, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "on stretch 1"), "a stretch as it counts here");
    check(gapbeam_solve_on_path(beam, history, -1, 0.9, state, message, sizeof message) == GAPBEAM_BAD_INPUT, "not on the path");
    check(strstr(message, "0.9") != NULL, "names the factor");
    gapbeam_free_history(history);
    check(gapbeam_follow_history(beam, 1, one, GAPBEAM_LIMIT_JUMP, &history, NULL, 0) == GAPBEAM_SOLVED, "jumps");
    check(gapbeam_solve_on_path(beam, history, -1, 1.0, state, NULL, 0) == GAPBEAM_SOLVED, "to the end");
    gapbeam_get_supports(beam, state, NULL, w, NULL, NULL, NULL);
    check_close(w[1], 2.2, "the beam alone");
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "the same loads again");
    check(gapbeam_solve_on_path(beam, history, -1, 1.0, state, NULL, 0) == GAPBEAM_SOLVED, "change nothing");
    model.load_value = three;
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "other loads");
    check(gapbeam_solve_on_path(beam, history, -1, 1.0, state, NULL, 0) == GAPBEAM_NOT_PREPARED, "have another history");
    gapbeam_free_history(history);
    gapbeam_free_history(NULL);
    gapbeam_free_beam(beam);

    model = over_law();
    model.law_points = 2;
    model.law_displacement = yield_d;
    model.law_force = yield_f;
    model.support_unloading = plastic;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "a support that keeps a set");
    check(gapbeam_follow_history(beam, 2, one, GAPBEAM_LIMIT_STOP, &history, NULL, 0) == GAPBEAM_SOLVED, "there and back");
    gapbeam_get_history_info(history, &info);
    check(info.ending == GAPBEAM_ARRIVED && info.events == 3 && info.limits == 0, "three events");
    gapbeam_get_events(history, NULL, NULL, NULL, change, stretch);
    check(change[0] == GAPBEAM_YIELDS && change[1] == GAPBEAM_UNLOADS && change[2] == GAPBEAM_OPENS, "their names");
    check(gapbeam_solve_on_path(beam, history, stretch[2], 0.25, state, NULL, 0) == GAPBEAM_SOLVED, "on the way back");
    gapbeam_get_supports(beam, state, r, w, gap_left, NULL, condition);
    check_close(gap_left[1], 0.55, "a gap is left");
    check(condition[1] == GAPBEAM_OPEN && r[1] == 0.0, "open");
    gapbeam_free_history(history);
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);

    model.law_force = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "a law without forces");
    model.law_force = yield_d;
    model.law_support = &side[2];
    model.law_points = -1;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "fewer points than none");

    /* As compiled with the header of version 0.2: nothing behind its structure is written or read */
    const size_t old_size = offsetof(gapbeam_model, support_unloading);
    gapbeam_model *old = malloc(old_size);
    check(old && gapbeam_model_init(old, old_size) == GAPBEAM_SOLVED, "the structure of version 0.2");
    memcpy(&model, old, old_size);
    check(model.size == old_size && model.spans == 0 && !model.load_value_to, "is empty");
    model = two_spans();
    model.size = old_size;
    memcpy(old, &model, old_size);
    check(prepare(old, &beam) == GAPBEAM_SOLVED && gapbeam_count_supports(beam) == 3, "goes on");
    gapbeam_free_beam(beam);
    free(old);
}

/* A rigid beam of 12 on ground that pushes up only, a force of 30 at a distance of 2 from its left end: contact over three times
 * that, the pressure there 2 F/(3 e) */
static gapbeam_model tipped(void)
{
    static const double twelve[] = {12.0}, k[] = {5.0}, two[] = {2.0}, thirty[] = {30.0};
    static const int below[] = {GAPBEAM_BELOW}, kind[] = {GAPBEAM_FORCE};
    static double rigid[1];
    gapbeam_model model;
    rigid[0] = gapbeam_infinity();
    gapbeam_model_init(&model, sizeof model);
    model.spans = 1;
    model.length = twelve;
    model.EI = rigid;
    model.foundations = 1;
    model.foundation_side = below;
    model.foundation_k = k;
    model.loads = 1;
    model.load_kind = kind;
    model.load_x = two;
    model.load_value = thirty;
    return model;
}

/* A rigid beam of 12 on ground whose law and load both grow threefold along it: 8 tanh(20 w/8) = 6 at its left end */
static void curved_ground(void)
{
    gapbeam_model model = tipped();
    gapbeam_beam *beam;
    gapbeam_state *state;
    const int tanh_law[] = {GAPBEAM_LAW_TANH}, no_law[] = {GAPBEAM_LAW_CUBIC + 1}, linear[] = {GAPBEAM_DISTRIBUTED};
    const double no_k[] = {0.0}, left[] = {20.0, 8.0, 0.0}, right[] = {60.0, 24.0, 0.0}, negative[] = {20.0, -8.0, 0.0};
    const double from[] = {0.0}, six[] = {6.0}, eighteen[] = {18.0}, places[] = {5.0};
    double fields[6], force[1], value[2], x[2];
    int condition[1], number = 0;
    char message[200];

    model.foundation_k = no_k;
    model.foundation_law = tanh_law;
    model.foundation_parameter = left;
    model.foundation_parameter_to = right;
    model.load_kind = linear;
    model.load_x = from;
    model.load_value = six;
    model.load_value_to = eighteen;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "ground with a curve");
    gapbeam_new_state(&state);
    check(gapbeam_solve(beam, 1.0, NULL, state, message, sizeof message) == GAPBEAM_SOLVED, "solved");
    check(gapbeam_get_fields(beam, state, 1, places, 0, fields, NULL, 0) == GAPBEAM_SOLVED, "fields");
    check_close(fields[GAPBEAM_DEFLECTION], 0.4*atanh(0.75), "the deflection");
    gapbeam_get_contact(beam, state, 1, NULL, NULL, NULL, condition, force, &number);
    check(number == 1 && condition[0] == GAPBEAM_CLOSED, "one zone");
    check_close(force[0], 144.0, "its force");
    gapbeam_get_pressure_extremes(beam, state, value, x);
    check_close(value[0], 18.0, "the largest pressure");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    model.foundation_parameter = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "foundation_parameter"),
          "a law without parameters");
    model.foundation_law = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "foundation_parameter_to"),
          "parameters at the right end alone");
    model.foundation_parameter = left;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "foundation_law"),
          "parameters without a law");
    model.foundation_law = no_law;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "got 6"), "no such law");
    model.foundation_law = tanh_law;
    model.foundation_parameter = negative;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "foundation 1 of 1: law.limit"), "a limit below 0");
}

static void foundations(void)
{
    gapbeam_model model = tipped(), half;
    gapbeam_certificate certificate = {.size = sizeof certificate};
    gapbeam_info info = {.size = sizeof info};
    gapbeam_history *history;
    gapbeam_beam *beam;
    gapbeam_state *state;
    const double places[] = {0.0, 3.0, 9.0}, off[] = {13.0}, one[] = {1.0}, sixty[] = {60.0};
    double from[2], to[2], force[2] = {7.0, 7.0}, sag[1], pressure[3] = {7.0, 7.0, 7.0}, value[2], x[2], fields[6], most[6][2], at[6][2];
    static const int two[] = {GAPBEAM_OF_PRESSURE, GAPBEAM_OF_CURVATURE}, none[] = {-1};
    double both[3][2];
    int foundation[2] = {7, 7}, condition[2], number = -1;
    char message[200];

    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "prepared");
    gapbeam_new_state(&state);
    check(gapbeam_get_contact(beam, state, 0, NULL, NULL, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "nothing solved");
    check(gapbeam_solve(beam, 1.0, NULL, state, message, sizeof message) == GAPBEAM_SOLVED && !*message, "solved");
    check(gapbeam_get_contact(beam, state, 2, foundation, from, to, condition, force, &number) == GAPBEAM_SOLVED, "contact");
    check(number == 1 && foundation[0] == 0 && condition[0] == GAPBEAM_CLOSED && from[0] == 0.0, "one zone");
    check(foundation[1] == 7 && force[1] == 7.0, "nothing is written behind it");
    check_close(to[0], 6.0, "its end");
    check_close(force[0], 30.0, "its force");
    number = -1;
    force[0] = 7.0;
    check(gapbeam_get_contact(beam, state, 0, NULL, NULL, NULL, NULL, force, &number) == 0 && number == 1 && force[0] == 7.0,
          "how many");
    check(gapbeam_get_free_spans(beam, state, 1, foundation, from, to, sag, &number) == 0 && number == 1, "a free span");
    check_close(from[0], 6.0, "where it begins");
    check_close(to[0], 12.0, "where it ends");
    check_close(sag[0], 2.0, "how far it is");
    check(gapbeam_get_pressure(beam, state, 3, places, 0, pressure, NULL, 0) == GAPBEAM_SOLVED, "pressure");
    check_close(pressure[0], 10.0, "at the edge");
    check_close(pressure[1], 5.0, "in the middle");
    check(pressure[2] == 0.0, "in the air");
    check(gapbeam_get_pressure(beam, state, 1, off, 0, pressure, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "outside the beam"), "off the beam");
    check(gapbeam_get_pressure(beam, state, 1, NULL, 0, pressure, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "x or pressure is NULL"), "no places");
    check(gapbeam_get_pressure(beam, state, -1, places, 0, pressure, NULL, 0) == GAPBEAM_BAD_INPUT, "fewer than none");
    check(gapbeam_get_pressure_extremes(beam, state, value, x) == GAPBEAM_SOLVED && x[0] == 0.0 && value[1] == 0.0, "extremes");
    check_close(value[0], 10.0, "of it");
    check(gapbeam_get_pressure_extremes(beam, state, NULL, NULL) == GAPBEAM_SOLVED, "for nobody");
    check(gapbeam_get_extremes(beam, state, most, at) == GAPBEAM_SOLVED, "extremes of the fields");
    check_close(most[GAPBEAM_DEFLECTION][0], 2.0, "of the deflection");
    check(gapbeam_get_quantities(beam, state, 2, two, 3, places, 0, both[0], NULL, 0) == GAPBEAM_SOLVED, "quantities");
    check(both[0][0] == pressure[0] && both[2][0] == pressure[2], "pressure is one of them");
    check(gapbeam_get_quantity_extremes(beam, state, 2, two, both, at, NULL, 0) == GAPBEAM_SOLVED, "extremes of quantities");
    check(both[0][0] == value[0] && both[0][1] == value[1] && at[0][1] == x[1], "of the pressure");
    check(gapbeam_get_quantity_extremes(beam, state, 2, two, NULL, NULL, NULL, 0) == GAPBEAM_SOLVED, "for nobody");
    check(gapbeam_get_quantities(beam, state, 1, none, 1, places, 0, both[0], message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "from 0 to 8, got -1"), "no such quantity");
    check(gapbeam_get_quantities(beam, state, 1, NULL, 1, places, 0, both[0], NULL, 0) == GAPBEAM_BAD_INPUT, "which");
    check(gapbeam_get_quantities(beam, state, 0, two, 1, places, 0, both[0], NULL, 0) == GAPBEAM_BAD_INPUT, "none");
    check(gapbeam_get_quantities(beam, state, 2, two, 1, NULL, 0, both[0], NULL, 0) == GAPBEAM_BAD_INPUT, "no places");
    check(gapbeam_get_certificate(beam, state, &certificate, NULL) == 0 && certificate.known && certificate.field_bound[0] < 1e-12,
          "certificate");
    check(gapbeam_get_info(state, &info) == GAPBEAM_SOLVED && info.solves > 1, "rounds");
    check(gapbeam_follow(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, state, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "follow_ground"), "its events are found otherwise");
    check(gapbeam_follow_history(beam, 1, one, GAPBEAM_LIMIT_STOP, &history, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "both ways"), "no history");
    check(gapbeam_follow_ground(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL, &number, state, NULL, 0) == GAPBEAM_SOLVED
          && number == 0, "zones that do not depend on the load");
    check(gapbeam_follow_ground(beam, 0.0, NULL, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, state, NULL, 0) == GAPBEAM_BAD_INPUT,
          "no way to go");
    model.load_value = sixty;
    check(gapbeam_replace_loads(beam, &model, NULL, 0) == GAPBEAM_SOLVED, "twice the load");
    check(gapbeam_get_pressure_extremes(beam, state, value, x) == GAPBEAM_NOT_PREPARED, "for which nothing is solved");
    gapbeam_solve(beam, 0.5, NULL, state, NULL, 0);
    gapbeam_get_contact(beam, state, 1, NULL, NULL, to, NULL, force, NULL);
    check_close(to[0], 6.0, "half of that");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);

    /* A profile and a law: two layers of ground, the upper one 1/4 below the beam, with a knee */
    static const int sides[] = {GAPBEAM_BELOW, GAPBEAM_BELOW}, of_profile[] = {0}, of_law[] = {1, 1};
    static const double right[] = {12.0, 12.0}, k2[] = {2.0, 0.0}, profile_x[] = {5.0}, gaps[] = {0.25}, d[] = {0.5, 1.5},
                        f[] = {1.0, 2.0}, uniform[] = {8.0};
    model = tipped();
    model.foundations = 2;
    model.foundation_side = sides;
    model.foundation_to = right;
    model.foundation_k = k2;
    model.foundation_k_to = k2;
    model.profile_points = 1;
    model.profile_foundation = of_profile;
    model.profile_x = profile_x;
    model.profile_gap = gaps;
    model.ground_law_points = 2;
    model.ground_law_foundation = of_law;
    model.ground_law_displacement = d;
    model.ground_law_force = f;
    model.load_kind = distributed;
    model.load_x = zero;
    model.load_value = uniform;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "a profile and a law");
    gapbeam_new_state(&state);
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved");
    gapbeam_get_contact(beam, state, 2, foundation, from, to, condition, force, &number);
    /* 2 (w - 1/4) + 1 + (w - 1/2) = 8 */
    check(number == 2 && foundation[1] == 1 && condition[1] == GAPBEAM_BRANCH + 2, "on the second piece");
    check_close(force[0], 12*2*(8/3.0 - 0.25), "the layer with the profile");
    check_close(force[0] + force[1], 96.0, "both");
    check(gapbeam_get_fields(beam, state, 1, places, 0, fields, NULL, 0) == GAPBEAM_SOLVED, "fields");
    check_close(fields[GAPBEAM_DEFLECTION], 8/3.0, "the deflection");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);

    /* The same by tables: a modulus, and the profile */
    static const int of_table[] = {0, 0, 0}, quantity[] = {GAPBEAM_TABLE_OF_K, GAPBEAM_TABLE_OF_K, GAPBEAM_TABLE_OF_GAP};
    static const double table_x[] = {2.0, 9.0, 5.0}, table_value[] = {2.0, 2.0, 0.25}, no_k[] = {0.0, 0.0};
    const int points = model.profile_points;
    model.profile_points = 0;
    model.foundation_k = no_k;
    model.foundation_k_to = NULL;
    model.table_points = 3;
    model.table_foundation = of_table;
    model.table_quantity = quantity;
    model.table_x = table_x;
    model.table_value = table_value;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "tables");
    gapbeam_new_state(&state);
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_SOLVED, "solved on them");
    gapbeam_get_contact(beam, state, 2, foundation, from, to, condition, force, &number);
    check_close(force[0], 12*2*(8/3.0 - 0.25), "the layer with tables");
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    model.table_value = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "table_value"),
          "tables without values");
    model.table_points = 0;
    model.foundation_k = k2;
    model.foundation_k_to = k2;
    model.profile_points = points;

    model.profile_gap = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "profile_gap"),
          "a profile without gaps");
    model.profile_points = -1;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "profile points"),
          "fewer points than none");
    model.profile_points = 0;
    model.ground_law_force = NULL;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "ground_law_force"),
          "a law without forces");
    model.ground_law_points = 0;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "foundation 2 of 2: k"), "ground without anything");
    model.foundations = -1;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && strstr(message, "foundations"),
          "fewer foundations than none");
    curved_ground();

    /* As compiled with the header of version 0.3: nothing behind its structure is written or read */
    const size_t old_size = offsetof(gapbeam_model, foundations);
    gapbeam_model *old = malloc(old_size);
    check(old && gapbeam_model_init(old, old_size) == GAPBEAM_SOLVED, "the structure of version 0.3");
    memcpy(&half, old, old_size);
    check(half.size == old_size && half.spans == 0 && !half.law_force, "is empty");
    model = two_spans();
    model.size = old_size;
    memcpy(old, &model, old_size);
    check(prepare(old, &beam) == GAPBEAM_SOLVED && gapbeam_count_supports(beam) == 3, "goes on");
    gapbeam_free_beam(beam);
    free(old);
}

/* EI is 1, so that curvature is the moment */
static void quantities_of_train(gapbeam_beam *beam, gapbeam_passing *passing, double place)
{
    static const int two[] = {GAPBEAM_OF_CURVATURE, GAPBEAM_OF_TRANSVERSE}, wrong[] = {GAPBEAM_OF_PRESSURE}, none[] = {GAPBEAM_QUANTITIES};
    double extremes[2][2][4], value[1][2][2], at[1][2][2];
    char message[200];

    check(gapbeam_get_train_quantity_extremes(beam, passing, 2, two, extremes, NULL, 0) == GAPBEAM_SOLVED, "quantities of a train");
    check_close(extremes[0][0][0], 32/17.0, "largest curvature");
    check_close(extremes[0][0][2], place, "its position");
    check(gapbeam_get_train_quantity_curves(beam, passing, 2, two, 1, &place, value[0], at[0], NULL, 0) == GAPBEAM_SOLVED, "curves");
    check_close(value[0][0][0], 32/17.0, "the same there");
    check(gapbeam_get_train_quantity_extremes(beam, passing, 1, wrong, extremes, message, sizeof message) == GAPBEAM_BAD_INPUT
          && !strcmp(message, "quantity[0]: a train has no pressure of the ground"), "no ground under a train");
    check(gapbeam_get_train_quantity_extremes(beam, passing, 1, none, extremes, message, sizeof message) == GAPBEAM_BAD_INPUT
          && !strcmp(message, "quantity[0]: expected a number from 0 to 8, got 9"), "no such quantity");
    check(gapbeam_get_train_quantity_extremes(beam, passing, 0, two, extremes, NULL, 0) == GAPBEAM_BAD_INPUT, "none asked for");
    check(gapbeam_get_train_quantity_extremes(beam, NULL, 1, two, extremes, NULL, 0) == GAPBEAM_NOT_PREPARED, "no train");
    check(gapbeam_get_train_quantity_curves(beam, passing, 1, two, 1, NULL, value[0], at[0], NULL, 0) == GAPBEAM_BAD_INPUT,
          "no places");
}

/* Two spans of 1 with a weight of 1 on supports from below: a force of 8 at s lifts the far end by P s (1 - s^2)/6 - 1/4 */
static void trains(void)
{
    static const double one[] = {1.0, 1.0}, two[] = {2.0}, weight[] = {1.0}, zero[] = {0.0}, eight[] = {8.0}, end = 1.0, place = 8/17.0;
    static const int below[] = {GAPBEAM_BELOW, GAPBEAM_BELOW, GAPBEAM_BELOW}, nodes[] = {0, 1, 2};
    static const int kind[] = {GAPBEAM_DISTRIBUTED}, dead[] = {GAPBEAM_DEAD};
    double position[2], from[1], to[1], fields[4][2][4], supports[3][4][2][4], value[1][4][2], at[1][4][2];
    int support[2], condition[2], change[2], reason[1], number = -1;
    char message[200];
    gapbeam_model model;
    gapbeam_beam *beam;
    gapbeam_passing *passing;

    gapbeam_model_init(&model, sizeof model);
    model.spans = 2;
    model.length = one;
    model.EI = one;
    model.supports = 3;
    model.support_node = nodes;
    model.support_side = below;
    model.loads = 1;
    model.load_kind = kind;
    model.load_case = dead;
    model.load_x = zero;
    model.load_to = two;
    model.load_value = weight;
    check(prepare(&model, &beam) == GAPBEAM_SOLVED, "prepared");
    check(gapbeam_follow_train(beam, 1, zero, eight, 0.0, 0, NULL, &end, &passing, NULL, 0) == GAPBEAM_SOLVED && passing, "it passes");
    check(gapbeam_get_train_events(passing, 2, position, support, condition, change, &number) == GAPBEAM_SOLVED && number == 2,
          "two events");
    check(support[0] == 2 && change[0] == GAPBEAM_OPENS && change[1] == GAPBEAM_CLOSES && condition[1] == GAPBEAM_CLOSED, "what");
    check_close(position[0], 0.19490392008291112, "where it opens");
    check_close(position[1], 0.88819977685765608, "and closes");
    check(gapbeam_get_train_gaps(passing, 1, from, to, reason, &number) == GAPBEAM_SOLVED && number == 0, "it stands");
    check(gapbeam_get_train_extremes(beam, passing, fields, supports) == GAPBEAM_SOLVED, "extremes");
    check_close(fields[GAPBEAM_MOMENT][0][0], 32/17.0, "largest moment");
    check_close(fields[GAPBEAM_MOMENT][0][2], place, "its position");
    check_close(supports[2][1][0][0], 8*sqrt(3.0)/27 - 0.25, "largest opening");
    check(gapbeam_get_train_extremes(beam, passing, NULL, NULL) == GAPBEAM_SOLVED, "for nobody");
    check(gapbeam_get_train_curves(beam, passing, 1, &place, value, at, NULL, 0) == GAPBEAM_SOLVED, "curves");
    check_close(value[0][GAPBEAM_MOMENT][0], 32/17.0, "the same there");
    check(gapbeam_get_train_curves(beam, passing, 1, NULL, value, at, NULL, 0) == GAPBEAM_BAD_INPUT, "no places");
    quantities_of_train(beam, passing, place);
    gapbeam_free_passing(passing);
    gapbeam_free_passing(NULL);
    check(gapbeam_follow_train(beam, 0, zero, eight, 0.0, 0, NULL, NULL, &passing, NULL, 0) == GAPBEAM_BAD_INPUT && !passing, "no axle");
    check(gapbeam_follow_train(beam, 1, zero, eight, 0.0, 0, &end, zero, &passing, message, sizeof message) == GAPBEAM_BAD_INPUT
          && strstr(message, "from must be"), "no position");
    check(gapbeam_follow_train(NULL, 1, zero, eight, 0.0, 0, NULL, NULL, &passing, NULL, 0) == GAPBEAM_NOT_PREPARED, "no beam");
    check(gapbeam_get_train_events(NULL, 0, NULL, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "no train");
    gapbeam_free_beam(beam);
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
    _Static_assert(sizeof(gapbeam_model) == 656 || sizeof(void *) != 8, "gapbeam_model is part of the ABI");
    _Static_assert(sizeof(gapbeam_options) == 16 || sizeof(void *) != 8, "gapbeam_options is part of the ABI");
    _Static_assert(sizeof(gapbeam_info) == 40 || sizeof(void *) != 8, "gapbeam_info is part of the ABI");
    _Static_assert(sizeof(gapbeam_history_info) == 32 || sizeof(void *) != 8, "gapbeam_history_info is part of the ABI");
    _Static_assert(sizeof(gapbeam_certificate) == 88 || sizeof(void *) != 8, "gapbeam_certificate is part of the ABI");
}

int main(void)
{
    refused_arguments();
    closed_form();
    counts_after_other_loads();
    no_equilibrium();
    all_loads();
    laws_and_histories();
    foundations();
    trains();
    environment();
    names_and_sizes();
    printf("1..%d\n", checks);
    return failures > 0;
}
