/* Instructions of the processor: 2, 3 or 4 for x86-64-v2, v3, v4 of the psABI (cases/cpu_dispatch.F90) */

int lanes_level_of_processor(void);

int lanes_level_of_processor(void)
{
    __builtin_cpu_init();
    if (!(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma")))
        return 2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return 4;
    return 3;
}
