/* base/quadruple.c gives the bits of the compiler's library, for numbers of all kinds */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef __float128 quad;

enum { CASES = 400000 };
static const uint64_t SIGN = (uint64_t)1 << 63;
static int failed;

#define DECLARED(type, name, arguments) type __real_##name arguments, __wrap_##name arguments;
DECLARED(quad, __addtf3, (quad, quad))
DECLARED(quad, __subtf3, (quad, quad))
DECLARED(quad, __multf3, (quad, quad))
DECLARED(quad, __extenddftf2, (double))
DECLARED(double, __trunctfdf2, (quad))
DECLARED(long, __eqtf2, (quad, quad))
DECLARED(long, __netf2, (quad, quad))
DECLARED(long, __lttf2, (quad, quad))
DECLARED(long, __letf2, (quad, quad))
DECLARED(long, __gttf2, (quad, quad))
DECLARED(long, __getf2, (quad, quad))

/* G. Marsaglia, Xorshift RNGs, J. Statistical Software 8 (2003) */
static uint64_t draw(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state * 2685821657736338717u;
}

static uint64_t with_exponent(uint64_t high, uint64_t exponent)
{
    return (high & (SIGN | 0xffffffffffffu)) | (exponent & 0x7fff) << 48;
}

/* A number, often near another one or with few bits */
static quad number_beside(quad other)
{
    uint64_t beside[2], bits[2] = {draw(), draw()};
    quad drawn;

    memcpy(beside, &other, sizeof beside);
    switch (draw() % 12) {
    case 0: case 1: bits[1] = with_exponent(bits[1], 16383 - 130 + draw() % 260); break;
    case 2: case 3: bits[1] = with_exponent(bits[1], (beside[1] >> 48) + draw() % 5 - 2); break;
    case 4: bits[0] = 0; bits[1] &= SIGN | 0xffff00000000u << 16; break;                  /* powers of two, zeros */
    case 5: bits[0] = beside[0] + draw() % 9 - 4; bits[1] = beside[1] ^ (draw() & SIGN); break;
    case 6: bits[0] = draw() % 3 ? 0 : draw(); bits[1] &= SIGN; break;                    /* zeros, subnormal */
    case 7: bits[0] = draw() % 2; bits[1] = with_exponent((bits[1] & SIGN), 0x7fff); break;   /* infinite, none */
    case 8: bits[0] = 0; bits[1] = with_exponent(bits[1], 16383 - 20 + draw() % 40); break;
    case 9: bits[1] = with_exponent(bits[1], draw() % 4 + (draw() & 1 ? 0 : 32763)); break;
    case 10: bits[0] = (draw() & 0xf) << 60 | (draw() % 3 - 1);                           /* between two doubles */
        bits[1] = with_exponent(bits[1], 16383 - 1030 + draw() % 2060); break;
    default: bits[0] = ~(uint64_t)0 << draw() % 64; bits[1] |= 0xffffffffffffu; break;
    }
    memcpy(&drawn, bits, sizeof drawn);
    return drawn;
}

static int sign_of(long x)
{
    return (x > 0) - (x < 0);
}

static void check(int right, const char *what)
{
    if (right) return;
    if (failed < 9) printf("# %s\n", what);
    failed++;
}

/* The same bits, or both not a number */
#define SAME(name, value, arguments)                                                                        \
    do {                                                                                                    \
        const value one = __wrap_##name arguments, other = __real_##name arguments;                         \
        check((one != one && other != other) || memcmp(&one, &other, sizeof one) == 0, #name);              \
    } while (0)
#define SAME_ORDER(name) check(sign_of(__wrap_##name(a, b)) == sign_of(__real_##name(a, b)), #name)
#define SAME_TRUTH(name) check(!__wrap_##name(a, b) == !__real_##name(a, b), #name)

int main(void)
{
    quad a = 1, b = 1;

    for (int i = 0; i < CASES; i++) {
        const uint64_t bits = i % 7 ? draw() : draw() & SIGN;
        double x;
        memcpy(&x, &bits, sizeof x);
        a = number_beside(b);
        b = number_beside(a);
        SAME(__addtf3, quad, (a, b));
        SAME(__subtf3, quad, (a, b));
        SAME(__multf3, quad, (a, b));
        SAME(__extenddftf2, quad, (x));
        SAME(__trunctfdf2, double, (a));
        SAME_TRUTH(__eqtf2);
        SAME_TRUTH(__netf2);
        SAME_ORDER(__lttf2);
        SAME_ORDER(__letf2);
        SAME_ORDER(__gttf2);
        SAME_ORDER(__getf2);
    }
    printf("1..1\n%sok 1 - the bits of the library\n", failed ? "not " : "");
    return failed != 0;
}
