/* As many multiplications and additions as one core can do: what arithmetic alone would take. By the widest registers that the
 * processor has, in ten chains that do not wait for each other. */

/* x = 0.5 x + 0.5 in every part of ten registers, which a compiler with -ffp-contract=fast does in one instruction where there is one */
#define PEAK(name, bytes, attribute)                                                                                              \
    attribute static double name(int turns)                                                                                       \
    {                                                                                                                             \
        typedef double wide __attribute__((vector_size(bytes)));                                                                  \
        const wide zero = {0.0}, half = zero + 0.5;                                                                               \
        wide a = zero, b = zero + 1.0, c = zero + 2.0, d = zero + 3.0, e = zero + 4.0;                                            \
        wide f = zero + 5.0, g = zero + 6.0, h = zero + 7.0, i = zero + 8.0, j = zero + 9.0;                                      \
        for (int turn = 0; turn < turns; turn++) {                                                                                \
            a = a * half + half, b = b * half + half, c = c * half + half, d = d * half + half, e = e * half + half;              \
            f = f * half + half, g = g * half + half, h = h * half + half, i = i * half + half, j = j * half + half;              \
        }                                                                                                                         \
        a += b + c + d + e + f + g + h + i + j;                                                                                   \
        return a[0];                                                                                                              \
    }

PEAK(narrow, 16, )
#ifdef __x86_64__
PEAK(wide, 32, __attribute__((target("avx2,fma"))))
PEAK(widest, 64, __attribute__((target("avx512f"))))
#endif

/* TURNS of them: what comes of it, which is 10, and how many operations they were */
double yardstick_peak(int turns, double *operations);

double yardstick_peak(int turns, double *operations)
{
    int numbers = 2;
    double (*work)(int) = narrow;
#ifdef __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f"))
        work = widest, numbers = 8;
    else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        work = wide, numbers = 4;
#endif
    *operations = 2.0 * 10.0 * numbers * turns;
    return work(turns);
}
