/* Arithmetic of real128: sums, products, comparisons, to doubles and from them. On x86-64 the compiler calls its library for that, whose
 * procedures look up how to round and raise flags that nothing here reads. These round to nearest, give the same bits, and take a half to a
 * fifth of the time. Numbers that are not normal, and results that may not be, are left to the library. The linker puts these in place of
 * those (--wrap): __real_ is what the library has. IEEE 754 (2008), sections 3.4 and 4.3.1. */
#include <emmintrin.h>
#include <stdint.h>

typedef __float128 quad;
typedef unsigned __int128 wide;

/* A number is a sign, 15 bits of the exponent and 112 of the fraction, whose first bit, 1, is hidden */
enum { INFINITE = 0x7fff, BIAS = 16383, SPARE = 15, BIAS_OF_DOUBLE = 1023, INFINITE_DOUBLE = 0x7ff };
static const uint64_t SIGN = (uint64_t)1 << 63, HIDDEN = (uint64_t)1 << 48;

typedef union { quad number; __m128i bits; } view;
typedef union { double number; uint64_t bits; } view_of_double;

quad __real___addtf3(quad, quad), __wrap___addtf3(quad, quad);
quad __real___subtf3(quad, quad), __wrap___subtf3(quad, quad);
quad __real___multf3(quad, quad), __wrap___multf3(quad, quad);
quad __real___extenddftf2(double), __wrap___extenddftf2(double);
double __real___trunctfdf2(quad), __wrap___trunctfdf2(quad);

static inline int rarely(int what)
{
    return __builtin_expect(what, 0);
}

static inline uint64_t low(quad x)
{
    view v = {.number = x};
    return (uint64_t)_mm_cvtsi128_si64(v.bits);
}

static inline uint64_t high(quad x)
{
    view v = {.number = x};
    return (uint64_t)_mm_cvtsi128_si64(_mm_unpackhi_epi64(v.bits, v.bits));
}

static inline quad made_of(uint64_t high, uint64_t low)
{
    view v;
    v.bits = _mm_unpacklo_epi64(_mm_cvtsi64_si128((int64_t)low), _mm_cvtsi64_si128((int64_t)high));
    return v.number;
}

static inline unsigned exponent_of(uint64_t high)
{
    return (unsigned)(high >> 48) & INFINITE;
}

/* Is an exponent not that of a normal number */
static inline int is_special(unsigned exponent)
{
    return exponent - 1 >= INFINITE - 1;
}

/* Might it become one by rounding */
static inline int is_extreme(unsigned exponent)
{
    return exponent - 2 >= INFINITE - 4;
}

/* The number nearest to a fraction of 128 bits, the first of them 1, the last also what is lost behind it; of two the even one */
static inline quad rounded(uint64_t sign, unsigned exponent, wide fraction)
{
    const unsigned rest = (unsigned)fraction & ((1u << SPARE) - 1), odd = (unsigned)(fraction >> SPARE) & 1u;
    /* The first bit of the fraction is added to the exponent */
    const wide sum = ((wide)(sign | (uint64_t)(exponent - 1) << 48) << 64) + (fraction >> SPARE) + (rest + odd > 1u << (SPARE - 1));
    return made_of((uint64_t)(sum >> 64), (uint64_t)sum);
}

quad __wrap___multf3(quad a, quad b)
{
    const uint64_t ah = high(a), al = low(a), bh = high(b), bl = low(b), sign = (ah ^ bh) & SIGN;
    const unsigned ea = exponent_of(ah), eb = exponent_of(bh), e = ea + eb - (BIAS - 1);
    if (rarely(is_special(ea) || is_special(eb) || is_extreme(e))) {
        const int zero = (ah << 1 | al) == 0 || (bh << 1 | bl) == 0;
        return zero && ea != INFINITE && eb != INFINITE ? made_of(sign, 0) : __real___multf3(a, b);
    }
    const uint64_t xh = ((ah & (HIDDEN - 1)) | HIDDEN) << SPARE | al >> (64 - SPARE), xl = al << SPARE;
    const uint64_t yh = ((bh & (HIDDEN - 1)) | HIDDEN) << SPARE | bl >> (64 - SPARE), yl = bl << SPARE;
    const wide outer = (wide)xh*yl, inner = (wide)xl*yh, last = (wide)xl*yl;
    const wide middle = (last >> 64) + (uint64_t)outer + (uint64_t)inner;
    const wide first = (wide)xh*yh + (outer >> 64) + (inner >> 64) + (middle >> 64);
    const unsigned shift = first >> 127 ? 0 : 1;
    return rounded(sign, e - shift, first << shift | (((uint64_t)middle | (uint64_t)last) != 0));
}

/* A sum; *known: is it told */
static inline quad sum_of(uint64_t ah, uint64_t al, uint64_t bh, uint64_t bl, int *known)
{
    const wide hidden = (wide)1 << 112;
    wide x = (wide)(ah & ~SIGN) << 64 | al, y = (wide)(bh & ~SIGN) << 64 | bl;
    const int opposite = (int64_t)(ah ^ bh) < 0, swapped = x < y;
    const uint64_t sign = (swapped ? bh : ah) & SIGN;
    const wide larger = swapped ? y : x, smaller = swapped ? x : y;
    const unsigned e = (unsigned)(larger >> 112), less = (unsigned)(smaller >> 112), apart = e - less;
    uint64_t xh;
    unsigned zeros, exponent;

    *known = 1;
    if (rarely(less == 0 || e == INFINITE)) {
        *known = smaller == 0 && (larger == 0 || !is_special(e));
        return made_of((larger == 0 ? ah & bh & SIGN : sign) | (uint64_t)(larger >> 64), (uint64_t)larger);
    }
    x = ((larger & (hidden - 1)) | hidden) << (SPARE - 1);
    y = ((smaller & (hidden - 1)) | hidden) << (SPARE - 1);
    if (apart < 64) {
        /* By halves: a shift of both takes some times as long */
        const uint64_t yh = (uint64_t)(y >> 64), yl = (uint64_t)y, lost = yl << 1 << (63 - apart);
        y = (wide)(yh >> apart) << 64 | (yl >> apart | yh << 1 << (63 - apart)) | (lost != 0);
    } else {
        y = apart > 127 ? 1 : y >> apart | (y >> apart << apart != y);
    }
    x = opposite ? x - y : x + y;
    xh = (uint64_t)(x >> 64);
    if (rarely(xh == 0)) {
        if (x == 0) return made_of(0, 0);
        zeros = 64 + (unsigned)__builtin_clzll((uint64_t)x);
        x = x << zeros;
    } else {
        const uint64_t xl = (uint64_t)x;
        zeros = (unsigned)__builtin_clzll(xh);
        x = (wide)(xh << zeros | xl >> 1 >> (63 - zeros)) << 64 | xl << zeros;
    }
    exponent = e + 1 - zeros;
    *known = !is_extreme(exponent);
    return rounded(sign, exponent, x);
}

quad __wrap___addtf3(quad a, quad b)
{
    int known;
    const quad sum = sum_of(high(a), low(a), high(b), low(b), &known);
    return rarely(!known) ? __real___addtf3(a, b) : sum;
}

quad __wrap___subtf3(quad a, quad b)
{
    int known;
    const quad sum = sum_of(high(a), low(a), high(b) ^ SIGN, low(b), &known);
    return rarely(!known) ? __real___subtf3(a, b) : sum;
}

quad __wrap___extenddftf2(double a)
{
    const view_of_double v = {.number = a};
    const uint64_t size = v.bits & ~SIGN, exponent = size >> 52;
    if (rarely(exponent - 1 >= INFINITE_DOUBLE - 1)) return size == 0 ? made_of(v.bits, 0) : __real___extenddftf2(a);
    return made_of((v.bits & SIGN) | ((size >> 4) + ((uint64_t)(BIAS - BIAS_OF_DOUBLE) << 48)), v.bits << 60);
}

double __wrap___trunctfdf2(quad a)
{
    const uint64_t ah = high(a), al = low(a), sign = ah & SIGN, rest = al << 4;
    const uint64_t fraction = (ah & (HIDDEN - 1)) << 4 | al >> 60, exponent = (uint64_t)exponent_of(ah) - (BIAS - BIAS_OF_DOUBLE);
    /* More than half of the last place, or half and the last bit is 1 */
    const uint64_t up = rest > SIGN - (fraction & 1);
    const view_of_double zero = {.bits = sign}, v = {.bits = sign | ((exponent << 52) + fraction + up)};
    if (rarely(exponent - 1 >= INFINITE_DOUBLE - 2)) return (ah << 1 | al) == 0 ? zero.number : __real___trunctfdf2(a);
    return v.number;
}

/* Of a beside b: -1 less, 0 equal, 1 greater; the library tells it of what is not normal */
static inline long order_of(quad a, quad b, long (*library)(quad, quad))
{
    const uint64_t ah = high(a), al = low(a), bh = high(b), bl = low(b), infinite = (uint64_t)INFINITE << 48;
    const wide x = (wide)ah << 64 | al, y = (wide)bh << 64 | bl;
    const long order = (x > y) - (x < y);
    if (rarely((ah & ~SIGN) >= infinite || (bh & ~SIGN) >= infinite)) return library(a, b);
    if (((ah | bh) << 1 | al | bl) == 0) return 0;
    if ((int64_t)(ah ^ bh) < 0) return (int64_t)ah < 0 ? -1 : 1;
    return (int64_t)ah < 0 ? -order : order;
}

#define COMPARISON(name)                         \
    long __real_##name(quad, quad);              \
    long __wrap_##name(quad, quad);              \
    long __wrap_##name(quad a, quad b)           \
    {                                            \
        return order_of(a, b, __real_##name);    \
    }
COMPARISON(__eqtf2)
COMPARISON(__netf2)
COMPARISON(__lttf2)
COMPARISON(__letf2)
COMPARISON(__gttf2)
COMPARISON(__getf2)
