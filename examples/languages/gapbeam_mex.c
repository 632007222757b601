/* gapbeam for MATLAB and GNU Octave.
 *
 *     mkoctfile --mex gapbeam_mex.c $(pkg-config --cflags --libs gapbeam)        (Octave)
 *     mex gapbeam_mex.c -I.../include -L.../lib -lgapbeam                        (MATLAB)
 *
 * [supports, fields, message] = gapbeam_mex(model, factor, x)
 *
 * model    struct with the members of gapbeam_model in gapbeam.h as vectors of numbers: length, EI, GA, EA, hinge_x, support_x,
 *          support_node, support_side, ..., load_kind, ..., load_value_to. What is left out has the header's default.
 * factor   load factor; x: places for the fields.
 * supports struct with reaction, deflection, opening, couple, condition; fields: 6 by numel(x), rows as in gapbeam.h.
 * message  '' where the beam is solved; otherwise why not, and the other two are empty. Without it an error is thrown. */
#include <string.h>

#include "gapbeam.h"
#include "mex.h"

/* A member as doubles; NULL and 0 where it is not there */
static const double *reals(const mxArray *model, const char *name, int *count)
{
    const mxArray *field = mxGetField(model, 0, name);
    if (count)
        *count = field ? (int)mxGetNumberOfElements(field) : 0;
    if (!field || mxIsEmpty(field))
        return NULL;
    if (!mxIsDouble(field) || mxIsComplex(field))
        mexErrMsgIdAndTxt("gapbeam:input", "%s: expected real numbers", name);
    return mxGetPr(field);
}

/* A member as integers */
static const int *integers(const mxArray *model, const char *name)
{
    int count;
    const double *values = reals(model, name, &count);
    if (!values)
        return NULL;
    int *whole = mxCalloc(count, sizeof *whole); /* freed by the host when the call ends */
    for (int k = 0; k < count; k++)
        whole[k] = (int)values[k];
    return whole;
}

/* All members of one kind must have as many entries */
static void same_size(const mxArray *model, const char *const *names, int count)
{
    for (; *names; names++) {
        int found;
        if (reals(model, *names, &found) && found != count)
            mexErrMsgIdAndTxt("gapbeam:input", "%s has %d entries, expected %d", *names, found, count);
    }
}

void mexFunction(int outputs, mxArray *output[], int inputs, const mxArray *input[])
{
    static const char *const of_spans[] = {"EI", "GA", "EA", NULL};
    static const char *const of_supports[] = {"support_x", "support_node", "support_side", "support_stiffness", "support_gap",
                                              "support_settlement", "support_rotation", "support_direction", NULL};
    static const char *const of_loads[] = {"load_case", "load_x", "load_node", "load_to", "load_value", "load_value_to", NULL};
    static const char *result[] = {"reaction", "deflection", "opening", "couple", "condition"};
    double *values[5];
    char message[400] = "";
    gapbeam_model model;

    if (inputs < 2 || !mxIsStruct(input[0]))
        mexErrMsgIdAndTxt("gapbeam:usage", "[supports, fields, message] = gapbeam_mex(model, factor, x)");
    const mxArray *m = input[0];
    if (gapbeam_model_init(&model, sizeof model) != GAPBEAM_SOLVED)
        mexErrMsgIdAndTxt("gapbeam:version", "built with the header of another version");
    model.length = reals(m, "length", &model.spans);
    model.EI = reals(m, "EI", NULL);
    model.GA = reals(m, "GA", NULL);
    model.EA = reals(m, "EA", NULL);
    model.hinge_x = reals(m, "hinge_x", &model.hinges);
    model.support_x = reals(m, "support_x", &model.supports);
    if (!model.support_x)
        reals(m, "support_node", &model.supports);
    model.support_node = integers(m, "support_node");
    model.support_side = integers(m, "support_side");
    model.support_stiffness = reals(m, "support_stiffness", NULL);
    model.support_gap = reals(m, "support_gap", NULL);
    model.support_settlement = reals(m, "support_settlement", NULL);
    model.support_rotation = reals(m, "support_rotation", NULL);
    model.support_direction = integers(m, "support_direction");
    reals(m, "load_kind", &model.loads);
    model.load_kind = integers(m, "load_kind");
    model.load_case = integers(m, "load_case");
    model.load_x = reals(m, "load_x", NULL);
    model.load_node = integers(m, "load_node");
    model.load_to = reals(m, "load_to", NULL);
    model.load_value = reals(m, "load_value", NULL);
    model.load_value_to = reals(m, "load_value_to", NULL);
    same_size(m, of_spans, model.spans);
    same_size(m, of_supports, model.supports);
    same_size(m, of_loads, model.loads);

    const int count = inputs > 2 ? (int)mxGetNumberOfElements(input[2]) : 0;
    int *condition = mxCalloc(model.supports + 1, sizeof *condition);
    mxArray *supports = mxCreateStructMatrix(1, 1, 5, result);
    mxArray *fields = mxCreateDoubleMatrix(6, count, mxREAL);
    for (int k = 0; k < 5; k++) {
        mxArray *column = mxCreateDoubleMatrix(1, model.supports, mxREAL);
        values[k] = mxGetPr(column);
        mxSetFieldByNumber(supports, 0, k, column);
    }
    int status = gapbeam_solve_model(&model, mxGetScalar(input[1]), NULL, values[0], values[1], values[2], values[3], condition,
                                     count, count ? mxGetPr(input[2]) : NULL, mxGetPr(fields), message, sizeof message);
    for (int k = 0; k < model.supports; k++)
        values[4][k] = condition[k];
    if (status != GAPBEAM_SOLVED) {
        if (!message[0])
            strncpy(message, gapbeam_status_message(status), sizeof message - 1);
        if (outputs < 3)
            mexErrMsgIdAndTxt("gapbeam:status", "%s", message);
        supports = mxCreateStructMatrix(0, 0, 5, result);
        fields = mxCreateDoubleMatrix(0, 0, mxREAL);
    }
    output[0] = supports;
    if (outputs > 1)
        output[1] = fields;
    if (outputs > 2)
        output[2] = mxCreateString(message);
}
