/* The floating-point environment of a caller. In Fortran a procedure cannot change rounding or traps for the one that calls it: they are
 * put back as it returns. So what is to hold for the rest of a procedure is set here. */
#include <fenv.h>

/* As environment_type in environment.f90 */
struct environment {
    union {
        fenv_t held;
        long long room[32];
    } of_caller;
};
_Static_assert(sizeof(struct environment) == sizeof(long long[32]), "fenv_t is larger than the room for it");

void gb_environment_hold(struct environment *environment)
{
    feholdexcept(&environment->of_caller.held);  /* traps are off from now on */
    fesetround(FE_TONEAREST);
}

void gb_environment_restore(const struct environment *environment)
{
    fesetenv(&environment->of_caller.held);
}
