/* A scene as a co-simulation unit of FMI 2.0: each instance is a process of the bench, stepped by whole blocks.
 *
 * Real outputs have the value references 0, 1 ... and the inputs those behind them; boolean 0 is whether the inputs take the
 * place of the scene's own vibration. What is held here is what the host set: the bench holds all else, and its state.
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <math.h>

#include "bench_process.h"
#ifndef fmi2Functions_h
#include "fmi2.h"
#endif

#define SAME_TIME 1e-6 /* of a block */
#define FIRST_MESSAGE 32
#define ERROR_CATEGORY "logStatusError"
#define DISCARD_CATEGORY "logStatusDiscard"

typedef struct {
    double length, duration; /* [s] of a block, of the scene */
    uint64_t outputs, inputs;
} Layout;

typedef struct {
    BenchProcess bench;
    char *name;
    fmi2CallbackFunctions functions;
    Layout layout;
    double *outputs;
    double *held;    /* whether the inputs act, their values, their derivatives */
    uint64_t blocks; /* done */
    double start;    /* [s] of the host's time */
    int is_over;     /* the last step was discarded since the scene has ended */
} Unit;

typedef struct {
    uint64_t length;
    unsigned char bytes[];
} State;

static fmi2Status report(Unit *unit, fmi2Status status, const char *sentence) {
    if (unit->functions.logger)
        unit->functions.logger(unit->functions.componentEnvironment, unit->name, status,
                               status == fmi2Discard ? DISCARD_CATEGORY : ERROR_CATEGORY, "%s", sentence);
    return status;
}

static fmi2Status failed(Unit *unit) { return report(unit, fmi2Error, unit->bench.said); }

static uint64_t held_bytes(const Unit *unit) { return (1 + 2 * unit->layout.inputs) * sizeof(double); }

static uint64_t output_bytes(const Unit *unit) { return unit->layout.outputs * sizeof(double); }

static double now(const Unit *unit) { return (double)unit->blocks * unit->layout.length; }

/* The path of a URI such as file:///tmp/a%20b, in `path`; a plain path stays as it is. */
static void path_of(const char *uri, char *path, size_t size) {
    size_t place = 0;
    if (!strncmp(uri, "file:", 5)) {
        uri += 5;
        if (!strncmp(uri, "//", 2)) {
            const char *behind_host = strchr(uri + 2, '/');
            uri = behind_host ? behind_host : uri + 2;
        }
        while (*uri && place + 1 < size) {
            unsigned int byte;
            if (uri[0] == '%' && uri[1] && uri[2] && sscanf(uri + 1, "%2x", &byte) == 1) {
                path[place++] = (char)byte;
                uri += 3;
            } else
                path[place++] = *uri++;
        }
        path[place] = '\0';
    } else
        snprintf(path, size, "%s", uri);
    while ((place = strlen(path)) > 1 && path[place - 1] == '/')
        path[place - 1] = '\0';
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
    (void)c, (void)on, (void)count, (void)categories;
    return fmi2OK; /* errors and discarded steps are always reported, and nothing else is */
}

void fmi2FreeInstance(fmi2Component c) {
    Unit *unit = c;
    if (!unit)
        return;
    bench_end(&unit->bench);
    free(unit->outputs);
    free(unit->held);
    free(unit->name);
    free(unit);
}

/* Keep what the first message says. A sentence where it does not fit, NULL otherwise. */
static const char *take_layout(Unit *unit, const char *guid) {
    if (unit->bench.answer != 'h' || unit->bench.length < FIRST_MESSAGE)
        return "the command that was started is no bench of this version";
    memcpy(&unit->layout, unit->bench.content, FIRST_MESSAGE);
    if (strcmp(guid, (char *)unit->bench.content + FIRST_MESSAGE))
        return "the GUID is not the one of this unit";
    unit->outputs = calloc(unit->layout.outputs + 1, sizeof(double));
    unit->held = calloc(1 + 2 * unit->layout.inputs, sizeof(double));
    return unit->outputs && unit->held ? NULL : "no memory for the values";
}

static fmi2Status start_again(Unit *unit) {
    if (!bench_ask(&unit->bench, 'r', NULL, 0, NULL, 0))
        return failed(unit);
    memcpy(unit->outputs, unit->bench.content, output_bytes(unit));
    memset(unit->held, 0, held_bytes(unit));
    unit->blocks = 0;
    unit->is_over = 0;
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
    Unit *unit = calloc(1, sizeof *unit);
    char folder[4096];
    const char *fault = NULL;
    (void)visible, (void)logging;
    if (!unit)
        return NULL;
    unit->bench.link = -1;
    unit->name = strdup(name ? name : "");
    if (functions)
        unit->functions = *functions;
    if (type != fmi2CoSimulation)
        fault = "the unit is for co-simulation alone";
    else if (!resources || !guid)
        fault = "the unit needs its GUID and the location of its resources";
    else {
        path_of(resources, folder, sizeof folder);
        fault = bench_start(&unit->bench, folder) ? take_layout(unit, guid) : unit->bench.said;
    }
    if (fault) {
        report(unit, fmi2Error, fault);
        fmi2FreeInstance(unit);
        return NULL;
    }
    if (start_again(unit) != fmi2OK) {
        fmi2FreeInstance(unit);
        return NULL;
    }
    return unit;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_defined, fmi2Real stop) {
    Unit *unit = c;
    char sentence[LONGEST_TEXT];
    (void)tolerance_defined, (void)tolerance; /* the scene has its own */
    unit->start = start;
    if (stop_defined && stop - start > unit->layout.duration + SAME_TIME * unit->layout.length) {
        snprintf(sentence, sizeof sentence, "the scene lasts %g s, %g s are wanted; export it with a longer duration",
                 unit->layout.duration, stop - start);
        return report(unit, fmi2Error, sentence);
    }
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component c) {
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) { return start_again(c); }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < count; i++) {
        if (vr[i] >= unit->layout.outputs + unit->layout.inputs)
            return report(unit, fmi2Error, "there is no real variable of this value reference");
        value[i] = vr[i] < unit->layout.outputs ? unit->outputs[vr[i]] : unit->held[1 + vr[i] - unit->layout.outputs];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < count; i++) {
        if (vr[i] < unit->layout.outputs || vr[i] >= unit->layout.outputs + unit->layout.inputs)
            return report(unit, fmi2Error, "a real variable that is to be set is no input");
        if (!isfinite(value[i]))
            return report(unit, fmi2Error, "an input is to be set to a value that is not finite");
        unit->held[1 + vr[i] - unit->layout.outputs] = value[i];
        unit->held[1 + vr[i] - unit->layout.outputs + unit->layout.inputs] = 0.0; /* a slope is that of its value */
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < count; i++) {
        if (vr[i] < unit->layout.outputs || vr[i] >= unit->layout.outputs + unit->layout.inputs || order[i] != 1 ||
            !isfinite(value[i]))
            return report(unit, fmi2Error, "a derivative is not finite, not of an input, or not the first");
        unit->held[1 + vr[i] - unit->layout.outputs + unit->layout.inputs] = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Boolean value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < count; i++) {
        if (vr[i] != 0 || !unit->layout.inputs)
            return report(unit, fmi2Error, "there is no boolean variable of this value reference");
        value[i] = unit->held[0] != 0.0;
    }
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Boolean value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < count; i++) {
        if (vr[i] != 0 || !unit->layout.inputs)
            return report(unit, fmi2Error, "there is no boolean variable of this value reference");
        unit->held[0] = value[i] ? 1.0 : 0.0;
    }
    return fmi2OK;
}

static fmi2Status none_of(Unit *unit, size_t count, const char *sentence) {
    return count ? report(unit, fmi2Error, sentence) : fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Integer value[]) {
    (void)vr, (void)value;
    return none_of(c, count, "there are no integer variables");
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer value[]) {
    (void)vr, (void)value;
    return none_of(c, count, "there are no integer variables");
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String value[]) {
    (void)vr, (void)value;
    return none_of(c, count, "there are no texts");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2String value[]) {
    (void)vr, (void)value;
    return none_of(c, count, "there are no texts");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)order, (void)value;
    return none_of(c, count, "outputs have no derivatives");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns,
                                        const fmi2ValueReference known[], size_t knowns, const fmi2Real direction[],
                                        fmi2Real change[]) {
    (void)unknown, (void)known, (void)knowns, (void)direction, (void)change;
    return none_of(c, unknowns, "there are no directional derivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real step, fmi2Boolean no_going_back) {
    Unit *unit = c;
    const double length = unit->layout.length;
    const double count = nearbyint(step / length);
    char sentence[LONGEST_TEXT];
    uint64_t blocks;
    (void)no_going_back;
    unit->is_over = 0;
    if (!(fabs(point - unit->start - now(unit)) <= SAME_TIME * length)) {
        snprintf(sentence, sizeof sentence, "a step begins at %.9g s; the unit is at %.9g s", point, unit->start + now(unit));
        return report(unit, fmi2Error, sentence);
    }
    if (!(count >= 1.0 && fabs(step - count * length) <= SAME_TIME * length)) {
        snprintf(sentence, sizeof sentence, "a step of %.9g s is discarded; the unit steps whole blocks of %.9g s", step, length);
        return report(unit, fmi2Discard, sentence);
    }
    if (now(unit) + step > unit->layout.duration + SAME_TIME * length) {
        unit->is_over = 1;
        snprintf(sentence, sizeof sentence, "a step is discarded; the scene ends at %g s", unit->layout.duration);
        return report(unit, fmi2Discard, sentence);
    }
    blocks = (uint64_t)count;
    if (!bench_ask(&unit->bench, 's', &blocks, sizeof blocks, unit->held, held_bytes(unit)))
        return failed(unit);
    memcpy(unit->outputs, unit->bench.content, output_bytes(unit));
    unit->blocks += blocks;
    return fmi2OK;
}

fmi2Status fmi2CancelStep(fmi2Component c) { return report(c, fmi2Error, "no step is pending"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    (void)kind, (void)value;
    return report(c, fmi2Discard, "no step is pending");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    Unit *unit = c;
    if (kind != fmi2LastSuccessfulTime)
        return report(unit, fmi2Discard, "this status is no real");
    *value = unit->start + now(unit);
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)kind, (void)value;
    return report(c, fmi2Discard, "there is no status that is an integer");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    Unit *unit = c;
    if (kind != fmi2Terminated)
        return report(unit, fmi2Discard, "this status is no boolean");
    *value = unit->is_over ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    (void)kind, (void)value;
    return report(c, fmi2Discard, "no step is pending");
}

/* Keep bytes in `state`, in the place of what it held. */
static fmi2Status keep(Unit *unit, const void *bytes, uint64_t length, fmi2FMUstate *state) {
    State *kept = realloc(*state, sizeof *kept + length);
    if (!kept)
        return report(unit, fmi2Error, "no memory for the state");
    kept->length = length;
    memcpy(kept->bytes, bytes, length);
    *state = kept;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    Unit *unit = c;
    if (!bench_ask(&unit->bench, 'g', unit->held, held_bytes(unit), NULL, 0))
        return failed(unit);
    return keep(unit, unit->bench.content, unit->bench.length, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    Unit *unit = c;
    const State *kept = state;
    const unsigned char *content;
    if (!kept)
        return report(unit, fmi2Error, "there is no state to go back to");
    if (!bench_ask(&unit->bench, 'l', kept->bytes, kept->length, NULL, 0))
        return failed(unit);
    content = unit->bench.content;
    memcpy(&unit->blocks, content, sizeof unit->blocks);
    memcpy(unit->held, content + sizeof unit->blocks, held_bytes(unit));
    memcpy(unit->outputs, content + sizeof unit->blocks + held_bytes(unit), output_bytes(unit));
    unit->is_over = 0;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    (void)c;
    if (state) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    if (!state)
        return report(c, fmi2Error, "there is no state to serialise");
    *size = ((State *)state)->length;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    const State *kept = state;
    if (!kept || size < kept->length)
        return report(c, fmi2Error, "there is no state to serialise, or no room for it");
    memcpy(bytes, kept->bytes, kept->length);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    return keep(c, bytes, size, state); /* checked where it is set */
}
