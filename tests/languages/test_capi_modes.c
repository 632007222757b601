/* Axial forces that bending feels through the C interface: the column with a stop, buckling, frequencies, what is refused. Reports in
 * the Test Anything Protocol; tests/languages/test_language_modes.py holds the digits against Python. */
#include <math.h>
#include <stddef.h>
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

static void check_close(double found, double expected, double relative, const char *name)
{
    int good = fabs(found - expected) <= relative * fabs(expected);
    if (!good)
        fprintf(stderr, "%s: %.17g, expected %.17g\n", name, found, expected);
    check(good, name);
}

/* Length, stiffness and load 1, a stop at midspan below a gap of 0.02 */
static const double one[] = {1.0}, zero[] = {0.0}, place[] = {0.0, 0.5, 1.0}, gap[] = {0.0, 0.02, 0.0};
static const int side[] = {GAPBEAM_BOTH, GAPBEAM_BELOW, GAPBEAM_BOTH}, distributed[] = {GAPBEAM_DISTRIBUTED};

static gapbeam_model column(const double *N)
{
    gapbeam_model model;
    gapbeam_model_init(&model, sizeof model);
    model.spans = 1;
    model.length = one;
    model.EI = one;
    model.N = N;
    model.supports = 3;
    model.support_x = place;
    model.support_side = side;
    model.support_gap = gap;
    model.loads = 1;
    model.load_kind = distributed;
    model.load_x = zero;
    model.load_to = one;
    model.load_value = one;
    return model;
}

static void stands(double euler)
{
    const double compression[] = {0.5, 0.9, 2.0}, force[] = {0.14714005862549203, 0.53807030793317657, 1.6440875059318176};
    double N = 0.0, reaction[3], factors[3], x[17], w[17], moment[17][2], share = 7.0, values[2], swing = 7.0;
    const int quantities[] = {GAPBEAM_OF_TRANSVERSE, GAPBEAM_SHEAR};
    int number, event[4], change[4], support = 7;
    char message[200];
    gapbeam_model model = column(&N);
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    gapbeam_info info = {0};

    info.size = sizeof info;
    check(gapbeam_new_state(&state) == GAPBEAM_SOLVED, "state");
    for (int i = 0; i < 3; i++) {
        gapbeam_free_beam(beam);
        N = -compression[i] * euler;
        check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_SOLVED, "prepare");
        check(gapbeam_solve(beam, 1.0, NULL, state, message, sizeof message) == GAPBEAM_SOLVED, "solve");
        check(gapbeam_get_info(state, &info) == GAPBEAM_SOLVED && info.unique == (compression[i] < 1.0), "the only one below Euler");
        check(gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL) == GAPBEAM_SOLVED, "supports");
        check_close(reaction[1], force[i], 1e-13, "stop");
        factors[2] = 7.0;
        check(gapbeam_get_modes(beam, state, GAPBEAM_BUCKLING, 2, factors, &number, NULL, 0) == GAPBEAM_SOLVED, "modes");
        check(number == 2 && factors[2] == 7.0, "two of them");
        check_close(factors[0], 4.0 / compression[i], 1e-14, "in two waves");
    }
    check(gapbeam_get_quantities(beam, state, 2, quantities, 1, zero, 0, values, NULL, 0) == GAPBEAM_SOLVED, "quantities");
    check_close(values[0], reaction[0], 1e-13, "the transverse force is what the support balances");
    check(fabs(values[1] - reaction[0]) > 0.1, "the shear is not");
    check(gapbeam_get_mode_shape(beam, state, GAPBEAM_BUCKLING, factors[0], 4, 17, x, w, moment, &number, message, sizeof message)
              == GAPBEAM_SOLVED && !*message, "shape");
    check(number == 17 && x[4] == 0.25 && fabs(w[4]) == 1.0, "at seventeen places");
    check(gapbeam_get_mode_amplitude(beam, state, GAPBEAM_BUCKLING, factors[0], 4, &swing, &support, message, sizeof message)
              == GAPBEAM_SOLVED, "amplitude");
    check(isinf(swing) && support == -1, "the stop is where the mode has a node");
    check_close(moment[4][0], 4.0 * euler * w[4], 1e-9, "moment");
    x[0] = 7.0;
    check(gapbeam_get_mode_shape(beam, state, GAPBEAM_BUCKLING, factors[0], 4, 0, x, NULL, NULL, &number, NULL, 0) == 0, "no room");
    check(number == 17 && x[0] == 7.0, "how many there are");
    check(gapbeam_get_modes(beam, state, GAPBEAM_VIBRATION, 1, factors, &number, NULL, 0) == 0 && number == 0, "no mass");
    check(gapbeam_get_modes(beam, state, 3, 1, factors, &number, message, sizeof message) == GAPBEAM_BAD_INPUT, "no such kind");
    check(strstr(message, "got 3") != NULL, "names it");
    check(gapbeam_get_modes(beam, state, 1, -1, factors, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "a negative number");
    check(gapbeam_get_modes(beam, state, 1, 1, NULL, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "no room for values");
    check(gapbeam_get_mode_shape(beam, state, 1, NAN, 4, 0, NULL, NULL, NULL, NULL, NULL, 0) == GAPBEAM_BAD_INPUT, "no number");
    check(gapbeam_get_buckling(beam, state, &share, 0, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED && share == 7.0, "it stands");
    check(gapbeam_follow(beam, 1.0, NULL, 0, NULL, NULL, NULL, NULL, state, message, sizeof message) == GAPBEAM_BAD_INPUT, "follow");
    check(!strcmp(message, "the beam has an axial force N: use follow_ground"), "says how");
    gapbeam_free_beam(beam);
    N = -0.5 * euler;
    check(gapbeam_prepare(&model, &beam, NULL, 0) == GAPBEAM_SOLVED, "prepare");
    check(gapbeam_follow_ground(beam, 1.0, NULL, 4, NULL, event, NULL, NULL, NULL, change, &number, state, NULL, 0) == 0, "follow");
    check(number == 1 && event[0] == 1 && change[0] == GAPBEAM_CLOSES, "the stop closes");
    gapbeam_free_beam(beam);
    gapbeam_free_state(state);
}

static void buckles(double euler)
{
    const double N = -5.0 * euler;
    double share = 0.0, x[40], w[40], reaction[3] = {7.0, 7.0, 7.0};
    int number = 0;
    gapbeam_model model = column(&N);
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    gapbeam_info info = {0};

    info.size = sizeof info;
    check(gapbeam_prepare(&model, &beam, NULL, 0) == 0 && gapbeam_new_state(&state) == 0, "prepare");
    check(gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == GAPBEAM_BUCKLES, "it buckles");
    check(gapbeam_get_info(state, &info) == GAPBEAM_SOLVED && info.status == GAPBEAM_BUCKLES, "info");
    check(gapbeam_get_buckling(beam, state, &share, 40, x, w, &number) == GAPBEAM_SOLVED, "how");
    check_close(share, 0.8, 1e-12, "share");
    check(number > 16 && number <= 40, "places");
    for (int i = 0; i < number && i < 40; i++)
        if (fabs(copysign(1.0, w[1]) * w[i] - sin(2.0 * sqrt(euler) * x[i])) > 1e-9)
            check(0, "in two waves");
    check(gapbeam_get_buckling(NULL, state, NULL, 0, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED, "no beam");
    check(gapbeam_get_buckling(beam, state, NULL, 0, NULL, NULL, NULL) == GAPBEAM_SOLVED, "nothing asked for");
    check(gapbeam_get_motion(beam, state, x, w) == GAPBEAM_NOT_PREPARED, "no free motion");
    check(gapbeam_get_supports(beam, state, reaction, NULL, NULL, NULL, NULL) == GAPBEAM_NOT_PREPARED && reaction[0] == 7.0, "no values");
    check(gapbeam_get_modes(beam, state, GAPBEAM_BUCKLING, 1, x, NULL, NULL, 0) == GAPBEAM_NOT_PREPARED, "no modes");
    check(gapbeam_solve_model(&model, 1.0, NULL, reaction, NULL, NULL, NULL, NULL, 0, NULL, NULL, NULL, 0) == GAPBEAM_BUCKLES, "at once");
    check(reaction[0] == 7.0, "nothing written");
    gapbeam_free_beam(beam);
    gapbeam_free_state(state);
}

/* A free span of 4 between two stretches of 10 on ground */
static void frequencies(void)
{
    const double length[] = {24.0}, ends[] = {0.0, 24.0}, from[] = {0.0, 14.0, 0.0}, to[] = {10.0, 24.0, 24.0};
    const double k[] = {100.0, 100.0, 1e-11}, shear[] = {0.0, 0.0, 5.0};
    const double N = 5.0;
    double omega[2];
    int number;
    gapbeam_model model = column(NULL);
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;

    model.length = length;
    model.mass = one;
    model.supports = 2;
    model.support_x = ends;
    model.support_side = NULL;
    model.support_gap = NULL;
    model.load_to = length;
    model.foundations = 2;
    model.foundation_from = from;
    model.foundation_to = to;
    model.foundation_k = k;
    check(gapbeam_new_state(&state) == GAPBEAM_SOLVED, "state");
    for (int i = 0; i < 3; i++) {
        model.N = i == 1 ? &N : NULL;
        model.foundations = i == 2 ? 3 : 2;
        model.foundation_shear = i == 2 ? shear : NULL;
        check(gapbeam_prepare(&model, &beam, NULL, 0) == 0 && gapbeam_solve(beam, 1.0, NULL, state, NULL, 0) == 0, "on ground");
        check(gapbeam_get_modes(beam, state, GAPBEAM_VIBRATION, 2, omega, &number, NULL, 0) == 0 && number == 2, "frequencies");
        check_close(omega[0], i == 0 ? 0.923729504793 : 1.76512387529, 1e-10, "the first");
        check_close(omega[1], i == 0 ? 2.4934881405 : 3.80941611761, 1e-10, "the second");
        gapbeam_free_beam(beam);
        beam = NULL;
    }
    gapbeam_free_state(state);
}

/* Two spans compressed by more than they bear without the support in the middle, off which a train lifts them: there
   F G(x) + q U is the gap, with G = (sin kx sin k/(k sin 2k) - x/2)/N and U = (1/cos k - 1)/N^2 - 1/(2N) */
static void under_a_train(double euler)
{
    const double ends[] = {0.0, 1.0, 2.0}, slack[] = {0.0, 0.005, 0.0}, two[] = {2.0}, lengths[] = {1.0, 1.0}, stiffness[] = {1.0, 1.0};
    const double N[] = {-0.3 * euler, -0.3 * euler}, q[] = {0.01}, at[] = {0.0}, force[] = {-0.05};
    const double thrust = 0.3 * euler, k = sqrt(0.3 * euler);
    const double weight = 0.01 * ((1.0 / cos(k) - 1.0) / (thrust * thrust) - 1.0 / (2.0 * thrust));
    double from, to, x;
    int number = 0, reason = 0;
    gapbeam_model model = column(N);
    gapbeam_beam *beam = NULL;
    gapbeam_passing *passing = NULL;
    char message[200];

    model.spans = 2;
    model.length = lengths;
    model.EI = stiffness;
    model.support_x = ends;
    model.support_gap = slack;
    model.load_to = two;
    model.load_value = q;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_SOLVED, "two spans");
    check(gapbeam_follow_train(beam, 1, at, force, 0.0, 0, NULL, NULL, &passing, message, sizeof message) == GAPBEAM_SOLVED,
          "a train on its way");
    check(gapbeam_get_train_gaps(passing, 1, &from, &to, &reason, &number) == GAPBEAM_SOLVED && number == 1, "buckles once");
    x = from;
    check_close(weight - 0.05 * (sin(k * x) * sin(k) / (k * sin(2.0 * k)) - x / 2.0) / thrust, 0.005, 1e-12, "where the support opens");
    gapbeam_free_passing(passing);
    passing = NULL;
    check(gapbeam_follow_train(beam, 1, at, force, 0.0, 1, NULL, NULL, &passing, message, sizeof message)
          == GAPBEAM_BAD_INPUT && !passing, "the way back is refused");
    check(strstr(message, "snap or buckle on the way") != NULL, "says why");
    gapbeam_free_beam(beam);
}

static void refused(void)
{
    double numbers[] = {1e308 * 10.0};
    char message[200];
    gapbeam_model model = column(numbers);
    gapbeam_beam *beam = NULL;

    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT && !beam, "an infinite axial force");
    check(strstr(message, "N") != NULL && !strncmp(message, "span 1 of 1", 11), "names it");
    numbers[0] = -1.0;
    model.N = NULL;
    model.mass = numbers;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "a negative mass");
    model.mass = NULL;
    model.foundations = 1;
    model.foundation_k = one;
    model.foundation_shear = numbers;
    check(gapbeam_prepare(&model, &beam, message, sizeof message) == GAPBEAM_BAD_INPUT, "a negative shear of ground");
    check(strstr(message, "shear") != NULL, "names it");
    /* Models of version 0.3 end before the foundations, and have none of this */
    model = column(numbers);
    model.size = offsetof(gapbeam_model, foundations);
    check(gapbeam_prepare(&model, &beam, NULL, 0) == GAPBEAM_SOLVED, "an old model");
    gapbeam_free_beam(beam);
}

int main(void)
{
    const double pi = acos(-1.0);
    stands(pi * pi);
    buckles(pi * pi);
    frequencies();
    under_a_train(pi * pi);
    refused();
    printf("1..%d\n", checks);
    return failures > 0;
}
