/* A program that links libgapbeam and embeds Python: the paper's beam by the library, by the package, and by the library again.
 *
 *     embedding paper_beam.py
 */
#include <Python.h>

#define main paper_beam
#include "paper_beam.c"
#undef main

int main(int argc, char **argv)
{
    FILE *script = argc == 2 ? fopen(argv[1], "r") : NULL;
    if (script == NULL || paper_beam() != EXIT_SUCCESS)
        return EXIT_FAILURE;
    fflush(stdout);
    Py_Initialize();
    int failed = PyRun_SimpleFileEx(script, argv[1], 1);
    if (Py_FinalizeEx() != 0 || failed)
        return EXIT_FAILURE;
    return paper_beam();
}
