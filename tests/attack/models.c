/* Models drawn at random, right and wrong ones, through every function of the C interface: statuses are those documented for each
 * function, an error writes nothing, what is solved is finite, and the flags of floating-point arithmetic are the caller's. To be
 * built with the address and the undefined-behaviour sanitizers: every array is as long as it says and no longer.
 *
 *     attack_models FIRST COUNT SECONDS    the models of the seeds FIRST, FIRST + 1, ...; a line "SEED" before and "= OUTCOME" after
 *                                          each, lines "! what is wrong" between; SECONDS for one model
 *     attack_models SEED                   prints that model
 */
#define _POSIX_C_SOURCE 200809L /* alarm */
#include <fenv.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gapbeam.h"

static uint64_t random_state;
static int faults;

/* splitmix64 */
static uint64_t random_bits(void)
{
    uint64_t z = random_state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static double uniform(void) { return (double)(random_bits() >> 11) * 0x1p-53; }
static int below(int n) { return (int)(random_bits() % (uint64_t)n); }
static int likely(double share) { return uniform() < share; }

static const char *called = "";

static void complain(const char *what, int value)
{
    printf("! %s: %s (%d)\n", called, what, value);
    faults++;
}

/* A positive number near `usual`, over `decades` powers of ten to either side */
static double around(double usual, double decades) { return usual * pow(10.0, decades * (2.0 * uniform() - 1.0)); }

static const double odd_numbers[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0, 1.0, 5e-324, 1e-310, 1e-200, 1e200, 1e308, -1e308, 1e-12};
static const int odd_integers[] = {INT_MAX, INT_MIN, -1, -2, 0, 1, 2, 3, 5, 6, 7, 100, 1 << 30};
enum { ODD_NUMBERS = sizeof odd_numbers / sizeof *odd_numbers, ODD_INTEGERS = sizeof odd_integers / sizeof *odd_integers };

/* An array of exactly n entries, NULL where n is 0 */
static void *room(int n, size_t size)
{
    void *array = n > 0 ? malloc((size_t)n * size) : NULL;
    if (n > 0 && !array)
        abort();
    return array;
}

static double *numbers(int n) { return room(n, sizeof(double)); }
static int *integers(int n) { return room(n, sizeof(int)); }

/* Every array of a model, to print, to break and to free them */
enum { ARRAYS = 20 };
typedef struct {
    const char *name;
    void **array;
    const int *count;
    int is_integer;
} entry;

static void list(gapbeam_model *m, entry *e)
{
#define ENTRY(k, member, number, kind) e[k] = (entry){#member, (void **)(uintptr_t)&m->member, &m->number, kind}
    ENTRY(0, length, spans, 0);
    ENTRY(1, EI, spans, 0);
    ENTRY(2, GA, spans, 0);
    ENTRY(3, EA, spans, 0);
    ENTRY(4, hinge_x, hinges, 0);
    ENTRY(5, support_x, supports, 0);
    ENTRY(6, support_node, supports, 1);
    ENTRY(7, support_side, supports, 1);
    ENTRY(8, support_stiffness, supports, 0);
    ENTRY(9, support_gap, supports, 0);
    ENTRY(10, support_settlement, supports, 0);
    ENTRY(11, support_rotation, supports, 0);
    ENTRY(12, support_direction, supports, 1);
    ENTRY(13, load_kind, loads, 1);
    ENTRY(14, load_case, loads, 1);
    ENTRY(15, load_x, loads, 0);
    ENTRY(16, load_node, loads, 1);
    ENTRY(17, load_to, loads, 0);
    ENTRY(18, load_value, loads, 0);
    ENTRY(19, load_value_to, loads, 0);
#undef ENTRY
}

static void draw_loads(gapbeam_model *m, double length, double decades)
{
    int n = m->loads = below(6), *kind = integers(n), *load_case = integers(n), *node = integers(n);
    double *x = numbers(n), *to = numbers(n), *value = numbers(n), *value_to = numbers(n);
    for (int i = 0; i < n; i++) {
        kind[i] = likely(0.9) ? 1 + below(4) : GAPBEAM_AXIAL_FORCE;
        load_case[i] = below(2);
        node[i] = likely(0.3) && kind[i] < GAPBEAM_DISTRIBUTED ? below(m->spans + 1) : GAPBEAM_BY_X;
        x[i] = length * below(64) / 64.0;
        to[i] = likely(0.3) ? length : x[i] + (length - x[i]) * (1 + below(63)) / 64.0;
        value[i] = (likely(0.3) ? -1.0 : 1.0) * around(kind[i] == GAPBEAM_CURVATURE ? 1e-3 : 10.0, decades);
        value_to[i] = likely(0.5) ? value[i] : -value[i] * uniform();
    }
    m->load_kind = kind;
    m->load_case = load_case;
    m->load_node = node;
    m->load_x = x;
    m->load_to = to;
    m->load_value = value;
    m->load_value_to = value_to;
}

static void draw(gapbeam_model *m)
{
    static const double spreads[] = {0.5, 0.5, 3.0, 9.0, 30.0};
    double decades = spreads[below(5)], total = 0.0;
    gapbeam_model_init(m, sizeof *m);
    int n = m->spans = 1 + below(likely(0.1) ? 200 : 6);
    double *length = numbers(n), *EI = numbers(n), *GA = numbers(n), *EA = numbers(n);
    for (int i = 0; i < n; i++) {
        total += length[i] = around(4.0, decades < 4.0 ? 0.5 : decades / 6.0);
        EI[i] = likely(0.05) ? INFINITY : around(1e4, decades);
        GA[i] = likely(0.7) ? INFINITY : around(1e4, decades);
        EA[i] = likely(0.5) ? INFINITY : around(1e4, decades);
    }
    m->length = length;
    m->EI = EI;
    m->GA = GA;
    m->EA = EA;
    n = m->hinges = likely(0.25) ? 1 + below(3) : 0;
    double *hinge = numbers(n);
    for (int i = 0; i < n; i++)
        hinge[i] = total * (1 + below(62)) / 64.0;
    m->hinge_x = hinge;
    n = m->supports = below(likely(0.1) ? 100 : 8);
    double *x = numbers(n), *stiffness = numbers(n), *gap = numbers(n), *settlement = numbers(n), *rotation = numbers(n);
    int *node = integers(n), *side = integers(n), *direction = integers(n);
    for (int i = 0; i < n; i++) {
        node[i] = likely(0.6) ? below(m->spans + 1) : GAPBEAM_BY_X;
        x[i] = total * below(65) / 64.0;
        side[i] = likely(0.4) ? GAPBEAM_BOTH : likely(0.6) ? GAPBEAM_BELOW : GAPBEAM_ABOVE;
        direction[i] = likely(0.05) ? GAPBEAM_AXIAL : GAPBEAM_NORMAL;
        if (direction[i] == GAPBEAM_AXIAL)
            side[i] = GAPBEAM_BOTH;
        stiffness[i] = likely(0.6) ? INFINITY : around(1e4, decades);
        gap[i] = side[i] == GAPBEAM_BOTH || likely(0.4) ? 0.0 : around(0.01, decades);
        settlement[i] = likely(0.8) ? 0.0 : around(0.01, decades);
        rotation[i] = likely(0.85) ? 0.0 : likely(0.5) ? INFINITY : around(1e4, decades);
    }
    m->support_x = x;
    m->support_node = node;
    m->support_side = side;
    m->support_direction = direction;
    m->support_stiffness = stiffness;
    m->support_gap = gap;
    m->support_settlement = settlement;
    m->support_rotation = rotation;
    draw_loads(m, total, decades);
}

static void free_model(gapbeam_model *m)
{
    entry e[ARRAYS];
    list(m, e);
    for (int k = 0; k < ARRAYS; k++)
        free(*e[k].array);
}

/* Spoil a copy of a model: entries, counts that arrays allow, missing arrays, the size. The arrays stay with the original. */
static void spoil(gapbeam_model *m)
{
    entry e[ARRAYS];
    list(m, e);
    for (int times = 1 + below(2); times > 0; times--) {
        int k = below(ARRAYS), what = below(20);
        if (what == 0) {
            *(int *)(uintptr_t)e[k].count = likely(0.5) ? INT_MIN : -1;
        } else if (what == 1) { /* more of what is not there */
            m->loads = m->load_kind ? m->loads : INT_MAX;
            m->load_kind = m->loads == INT_MAX ? NULL : m->load_kind;
        } else if (what == 2) {
            m->size = likely(0.5) ? 0 : m->size + 8;
        } else if (what == 3) { /* fewer */
            *(int *)(uintptr_t)e[k].count = *e[k].count > 0 ? below(*e[k].count) : 0;
        } else if (what < 6) {
            *e[k].array = NULL;
        } else if (*e[k].array && *e[k].count > 0) {
            int i = below(*e[k].count);
            if (e[k].is_integer)
                ((int *)*e[k].array)[i] = odd_integers[below(ODD_INTEGERS)];
            else
                ((double *)*e[k].array)[i] = odd_numbers[below(ODD_NUMBERS)];
        }
    }
}

static void print_model(gapbeam_model *m)
{
    entry e[ARRAYS];
    list(m, e);
    printf("size %zu of %zu, spans %d, hinges %d, supports %d, loads %d\n", m->size, sizeof *m, m->spans, m->hinges, m->supports, m->loads);
    for (int k = 0; k < ARRAYS; k++) {
        printf("%s:", e[k].name);
        for (int i = 0; *e[k].array && i < *e[k].count; i++)
            if (e[k].is_integer)
                printf(" %d", ((int *)*e[k].array)[i]);
            else
                printf(" %.17g", ((double *)*e[k].array)[i]);
        printf("%s\n", *e[k].array ? "" : " NULL");
    }
}

/* Whether a status is one of those documented, and the floating-point flags are as they were */
static int documented(const char *function, int status, const char *message, const int *allowed)
{
    int known = 0, raised = fetestexcept(FE_ALL_EXCEPT);
    called = function;
    for (; *allowed >= 0; allowed++)
        known = known || status == *allowed;
    if (!known)
        complain("a status that is not documented", status);
    if (message && (status > 10) != (message[0] != '\0'))
        complain("a message without error, or none with it", status);
    if (message && strlen(message) > 100 && memchr(message, '\n', 200))
        complain("a message of more than one line", status);
    if (raised)
        complain("flags of floating-point arithmetic are raised", raised);
    return status;
}
#define CHECKED(function, call, message, allowed) documented(function, (feclearexcept(FE_ALL_EXCEPT), (call)), message, allowed)
#define ALLOWED(...) ((const int[]){__VA_ARGS__, -1})
#define SOLVING ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NO_EQUILIBRIUM, GAPBEAM_BUCKLES, GAPBEAM_BAD_INPUT, GAPBEAM_INDETERMINATE, \
                        GAPBEAM_NOT_CONVERGED, \
                        GAPBEAM_NOT_FINITE, GAPBEAM_NO_MEMORY)

static void all_finite(const char *name, int n, const double *values)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(values[i])) {
            complain(name, i);
            return;
        }
}

static const double SENTINEL = 123456789.0;

static double *sentinels(int n)
{
    double *values = numbers(n);
    for (int i = 0; i < n; i++)
        values[i] = SENTINEL;
    return values;
}

static void untouched(const char *name, int n, const double *values)
{
    for (int i = 0; i < n; i++)
        if (values[i] != SENTINEL) {
            complain(name, i);
            return;
        }
}

/* Everything that can be asked of a state */
static void ask(const gapbeam_beam *beam, gapbeam_state *state, int solved)
{
    int supports = gapbeam_count_supports(beam), nodes = gapbeam_count_nodes(beam), asked = below(5);
    double *reaction = sentinels(supports), *opening = numbers(supports), *x = numbers(nodes), *motion = sentinels(nodes);
    double extreme[GAPBEAM_FIELDS][2], place[GAPBEAM_FIELDS][2], *where = numbers(asked), *fields = sentinels(asked * GAPBEAM_FIELDS);
    int *condition = integers(supports), *undecided = integers(supports), bad_place = 0;
    gapbeam_info info = {.size = sizeof info};
    gapbeam_certificate certificate = {.size = sizeof certificate};
    char message[200] = "";
    int from_left = below(2);
    int status = CHECKED("get_info", gapbeam_get_info(state, &info), NULL, ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NOT_PREPARED));
    if (status == GAPBEAM_SOLVED && info.status != GAPBEAM_SOLVED && info.status != GAPBEAM_NO_EQUILIBRIUM
        && info.status != GAPBEAM_BUCKLES)
        complain("status of a state", info.status);
    status = CHECKED("get_supports", gapbeam_get_supports(beam, state, reaction, NULL, opening, NULL, condition), NULL,
                        ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NOT_PREPARED, GAPBEAM_NO_MEMORY));
    if ((status == GAPBEAM_SOLVED) != solved)
        complain("values at supports, of a state that is", solved);
    if (solved) {
        all_finite("a reaction is no number, of support", supports, reaction);
        all_finite("an opening is no number, of support", supports, opening);
    } else {
        untouched("reactions are written without solution, of support", supports, reaction);
    }
    for (int i = 0; i < asked; i++) {
        where[i] = likely(0.1) ? odd_numbers[below(ODD_NUMBERS)] : 4.0 * uniform();
        bad_place = bad_place || !(where[i] >= 0.0 && where[i] < 4.0);
    }
    status = CHECKED("get_fields", gapbeam_get_fields(beam, state, asked, where, from_left, fields, message, sizeof message), message,
                        ALLOWED(GAPBEAM_SOLVED, GAPBEAM_BAD_INPUT, GAPBEAM_NOT_FINITE, GAPBEAM_NOT_PREPARED, GAPBEAM_NO_MEMORY));
    if (status == GAPBEAM_SOLVED)
        all_finite("a field is no number, at place", asked * GAPBEAM_FIELDS, fields);
    else
        untouched("fields are written after an error, at place", asked * GAPBEAM_FIELDS, fields);
    status = CHECKED("get_extremes", gapbeam_get_extremes(beam, state, extreme, place), NULL,
                        ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NOT_FINITE, GAPBEAM_NOT_PREPARED, GAPBEAM_NO_MEMORY));
    if (status == GAPBEAM_SOLVED)
        all_finite("an extreme is no number, of field", GAPBEAM_FIELDS * 2, &extreme[0][0]);
    status = CHECKED("get_motion", gapbeam_get_motion(beam, state, x, motion), NULL, ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NOT_PREPARED));
    if (status == GAPBEAM_SOLVED)
        all_finite("a motion is no number, at node", nodes, motion);
    else
        untouched("a motion is written of a state that has none, at node", nodes, motion);
    status = CHECKED("get_certificate", gapbeam_get_certificate(beam, state, &certificate, undecided), NULL,
                        ALLOWED(GAPBEAM_SOLVED, GAPBEAM_INDETERMINATE, GAPBEAM_NOT_CONVERGED, GAPBEAM_NOT_PREPARED,
                                GAPBEAM_NO_MEMORY));
    if (status == GAPBEAM_SOLVED && !(certificate.deflection_bound >= 0.0 && certificate.reaction_bound >= 0.0))
        complain("a bound is no number, or negative", certificate.known);
    free(reaction), free(opening), free(x), free(motion), free(where), free(fields), free(condition), free(undecided);
}

static double draw_factor(void) { return likely(0.1) ? odd_numbers[below(ODD_NUMBERS)] : likely(0.3) ? 1.0 : 2.0 * uniform(); }

/* Solve or follow, then ask; the status */
static int try_state(const gapbeam_beam *beam, gapbeam_state *state)
{
    char message[200] = "";
    gapbeam_options options;
    double factor = draw_factor();
    int status;
    gapbeam_options_init(&options, sizeof options);
    const gapbeam_options *chosen = likely(0.5) ? &options : NULL;
    options.rule = likely(0.02) ? odd_integers[below(ODD_INTEGERS)] : below(2);
    if (likely(0.6)) {
        status = CHECKED("solve", gapbeam_solve(beam, factor, chosen, state, message, sizeof message), message, SOLVING);
    } else {
        int capacity = below(6), number = -1, *support = integers(capacity), *condition = integers(capacity);
        double *at = numbers(capacity);
        status = CHECKED("follow", gapbeam_follow(beam, factor, chosen, capacity, at, support, condition, &number,
                                                     state, message, sizeof message), message, SOLVING);
        if (status <= GAPBEAM_NO_EQUILIBRIUM && number < 0)
            complain("number of events", number);
        for (int i = 0; status <= GAPBEAM_NO_EQUILIBRIUM && i < capacity && i < number; i++)
            if (!isfinite(at[i]) || at[i] < 0.0 || at[i] > factor || support[i] < 0 || support[i] >= gapbeam_count_supports(beam))
                complain("an event at no factor or of no support", support[i]);
        free(at), free(support), free(condition);
    }
    ask(beam, state, status == GAPBEAM_SOLVED);
    return status;
}

/* One model from beginning to end; the status of the last solve, or of preparing it */
static int attack(gapbeam_model *model)
{
    char message[200] = "";
    gapbeam_beam *beam = NULL;
    gapbeam_state *state = NULL;
    size_t size = likely(0.9) ? sizeof message : (size_t)below(3);
    int status = CHECKED("prepare", gapbeam_prepare(model, &beam, message, size), NULL,
                            ALLOWED(GAPBEAM_SOLVED, GAPBEAM_BAD_INPUT, GAPBEAM_NOT_FINITE, GAPBEAM_NO_MEMORY, GAPBEAM_OTHER_VERSION));
    if ((status == GAPBEAM_SOLVED) != (beam != NULL))
        complain("a handle after an error, or none", status);
    if (status != GAPBEAM_SOLVED)
        return status;
    if (CHECKED("new_state", gapbeam_new_state(&state), NULL, ALLOWED(GAPBEAM_SOLVED, GAPBEAM_NO_MEMORY)) == GAPBEAM_SOLVED) {
        for (int times = 1 + below(3); times > 0; times--)
            status = try_state(beam, state);
        gapbeam_model loads;
        gapbeam_model_init(&loads, sizeof loads);
        loads.spans = model->spans;
        draw_loads(&loads, 4.0, 1.0);
        gapbeam_model spoilt = loads;
        if (likely(0.3))
            spoil(&spoilt);
        int replaced = CHECKED("replace_loads", gapbeam_replace_loads(beam, &spoilt, message, sizeof message), message,
                                  ALLOWED(GAPBEAM_SOLVED, GAPBEAM_BAD_INPUT, GAPBEAM_NOT_FINITE, GAPBEAM_NO_MEMORY,
                                          GAPBEAM_OTHER_VERSION));
        free_model(&loads);
        if (replaced == GAPBEAM_SOLVED || likely(0.5))
            try_state(beam, state);
    }
    int supports = model->supports;
    double *reaction = sentinels(supports), x = 0.0, fields[GAPBEAM_FIELDS];
    int again = CHECKED("solve_model", gapbeam_solve_model(model, 1.0, NULL, reaction, NULL, NULL, NULL, NULL, 1, &x, fields, message,
                                                              sizeof message), message, SOLVING);
    if (again == GAPBEAM_SOLVED)
        all_finite("a reaction is no number, of support", supports, reaction);
    else
        untouched("reactions are written without solution, of support", supports, reaction);
    free(reaction);
    gapbeam_free_state(state);
    gapbeam_free_beam(beam);
    return status;
}

int main(int count, char **arguments)
{
    long first = count > 1 ? atol(arguments[1]) : 0, number = count > 2 ? atol(arguments[2]) : 1;
    for (long seed = first; seed < first + number; seed++) {
        gapbeam_model model, spoilt;
        random_state = (uint64_t)seed * 2654435761u + 1;
        draw(&model);
        spoilt = model;
        if (likely(0.5))
            spoil(&spoilt);
        if (count == 2) {
            print_model(&spoilt);
        } else {
            printf("%ld\n", seed);
            fflush(stdout);
            alarm(count > 3 ? (unsigned)atoi(arguments[3]) : 20);
            printf("= %d\n", attack(&spoilt));
            alarm(0);
        }
        free_model(&model);
    }
    return faults > 0;
}
