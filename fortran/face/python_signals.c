/* Signals in the midst of a call: Python hears them between its own instructions only, so a call that takes long asks it now and then. */
#include <Python.h>
#include <stdint.h>

/* Let Python see to what has come. Not 0 where that raised an exception, which is then raised where the call returns. Signals are
 * for the main thread alone, which is known by its number; others need not wait for Python's lock. */
int gb_hear_signals(void *thread)
{
    if ((uintptr_t)PyThread_get_thread_ident() != (uintptr_t)thread)
        return 0;
    const PyGILState_STATE state = PyGILState_Ensure();
    const int raised = PyErr_CheckSignals();
    PyGILState_Release(state);
    return raised;
}
