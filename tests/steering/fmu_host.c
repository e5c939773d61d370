/* A host of FMI 2.0 that knows no Python: it steps a unit, and prints outputs as hexadecimal doubles, a line a step.
 *
 * fmu_host LIBRARY GUID RESOURCES OUTPUTS LENGTH STEPS SAVE_TO   saves the state half-way, goes on, goes back, and goes on again;
 * fmu_host LIBRARY GUID RESOURCES OUTPUTS LENGTH STEPS -STATE    loads the state, and goes on to the same end.
 */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"

#define FUNCTION(result, name, ...) result (*name)(__VA_ARGS__) = (result (*)(__VA_ARGS__))dlsym(library, "fmi2" #name)
#define MUST(call)                                     \
    if ((call) != fmi2OK) {                            \
        fprintf(stderr, "%s is not fmi2OK\n", #call); \
        return 1;                                      \
    }

static void logger(void *environment, fmi2String instance, fmi2Status status, fmi2String category, fmi2String message, ...) {
    va_list arguments;
    (void)environment, (void)instance, (void)status, (void)category;
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

int main(int count, char **arguments) {
    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    void *library = count == 8 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    FUNCTION(fmi2Component, Instantiate, fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *,
             fmi2Boolean, fmi2Boolean);
    FUNCTION(fmi2Status, SetupExperiment, fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
    FUNCTION(fmi2Status, EnterInitializationMode, fmi2Component);
    FUNCTION(fmi2Status, ExitInitializationMode, fmi2Component);
    FUNCTION(fmi2Status, DoStep, fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
    FUNCTION(fmi2Status, GetReal, fmi2Component, const fmi2ValueReference *, size_t, fmi2Real *);
    FUNCTION(fmi2Status, GetFMUstate, fmi2Component, fmi2FMUstate *);
    FUNCTION(fmi2Status, SetFMUstate, fmi2Component, fmi2FMUstate);
    FUNCTION(fmi2Status, FreeFMUstate, fmi2Component, fmi2FMUstate *);
    FUNCTION(fmi2Status, SerializedFMUstateSize, fmi2Component, fmi2FMUstate, size_t *);
    FUNCTION(fmi2Status, SerializeFMUstate, fmi2Component, fmi2FMUstate, fmi2Byte *, size_t);
    FUNCTION(fmi2Status, DeSerializeFMUstate, fmi2Component, const fmi2Byte *, size_t, fmi2FMUstate *);
    FUNCTION(fmi2Status, Terminate, fmi2Component);
    FUNCTION(void, FreeInstance, fmi2Component);

    const size_t outputs = strtoul(arguments[4], NULL, 10);
    const double length = atof(arguments[5]);
    const int steps = atoi(arguments[6]), half = steps / 2, loads = arguments[7][0] == '-';
    fmi2ValueReference *references = malloc(outputs * sizeof *references);
    double *values = malloc(outputs * sizeof *values);
    fmi2FMUstate state = NULL;
    size_t size;
    char *bytes;
    for (size_t i = 0; i < outputs; i++)
        references[i] = (fmi2ValueReference)i;

    fmi2Component unit = Instantiate("host", fmi2CoSimulation, arguments[2], arguments[3], &callbacks, fmi2False, fmi2False);
    if (!unit)
        return 1;
    MUST(SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    MUST(EnterInitializationMode(unit));
    MUST(ExitInitializationMode(unit));
    if (loads) {
        FILE *file = fopen(arguments[7] + 1, "rb");
        if (!file || fseek(file, 0, SEEK_END))
            return 1;
        size = (size_t)ftell(file);
        bytes = malloc(size);
        rewind(file);
        if (fread(bytes, 1, size, file) != size)
            return 1;
        fclose(file);
        MUST(DeSerializeFMUstate(unit, bytes, size, &state));
        MUST(SetFMUstate(unit, state));
        free(bytes);
    }
    for (int round = 0, step = loads ? half : 0; round < 2 - loads; round++) {
        for (; step < steps; step++) {
            if (step == half && !round && !loads) {
                MUST(GetFMUstate(unit, &state));
            }
            MUST(DoStep(unit, step * length, length, fmi2True));
            MUST(GetReal(unit, references, outputs, values));
            for (size_t i = 0; i < outputs; i++)
                printf("%a ", values[i]);
            printf("\n");
        }
        if (!loads && !round) {
            FILE *file = fopen(arguments[7], "wb");
            MUST(SerializedFMUstateSize(unit, state, &size));
            bytes = malloc(size);
            MUST(SerializeFMUstate(unit, state, bytes, size));
            if (!file || fwrite(bytes, 1, size, file) != size)
                return 1;
            fclose(file);
            free(bytes);
            MUST(SetFMUstate(unit, state));
            step = half;
        }
    }
    MUST(FreeFMUstate(unit, &state));
    MUST(Terminate(unit));
    FreeInstance(unit);
    free(references);
    free(values);
    return 0;
}
