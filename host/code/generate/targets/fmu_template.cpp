// SPDX-License-Identifier: MIT
#include "fmu_template.hpp"
#include "fmu_code.hpp"

namespace tactus::host
{

const char* fmiHeader()
{
    return R"(/* SPDX-License-Identifier: MIT */
/* The functions of a unit for co-simulation and their types, as the standard "Functional Mock-up Interface 2.0" defines them. */
#ifndef FMI2_H
#define FMI2_H

#include <stddef.h>

#ifdef _WIN32
#define FMI2_EXPORT __declspec (dllexport)
#else
#define FMI2_EXPORT __attribute__ ((visibility ("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define fmi2TypesPlatform "default"
#define fmi2Version "2.0"
#define fmi2True 1
#define fmi2False 0

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef struct
{
    void (*logger) (fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void* (*allocateMemory) (size_t, size_t);
    void (*freeMemory) (void*);
    void (*stepFinished) (fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

FMI2_EXPORT const char* fmi2GetTypesPlatform (void);
FMI2_EXPORT const char* fmi2GetVersion (void);
FMI2_EXPORT fmi2Status fmi2SetDebugLogging (fmi2Component, fmi2Boolean, size_t, const fmi2String[]);
FMI2_EXPORT fmi2Component fmi2Instantiate (fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*, fmi2Boolean, fmi2Boolean);
FMI2_EXPORT void fmi2FreeInstance (fmi2Component);
FMI2_EXPORT fmi2Status fmi2SetupExperiment (fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
FMI2_EXPORT fmi2Status fmi2EnterInitializationMode (fmi2Component);
FMI2_EXPORT fmi2Status fmi2ExitInitializationMode (fmi2Component);
FMI2_EXPORT fmi2Status fmi2Terminate (fmi2Component);
FMI2_EXPORT fmi2Status fmi2Reset (fmi2Component);
FMI2_EXPORT fmi2Status fmi2GetReal (fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
FMI2_EXPORT fmi2Status fmi2GetInteger (fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]);
FMI2_EXPORT fmi2Status fmi2GetBoolean (fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]);
FMI2_EXPORT fmi2Status fmi2GetString (fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
FMI2_EXPORT fmi2Status fmi2SetReal (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
FMI2_EXPORT fmi2Status fmi2SetInteger (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]);
FMI2_EXPORT fmi2Status fmi2SetBoolean (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]);
FMI2_EXPORT fmi2Status fmi2SetString (fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]);
FMI2_EXPORT fmi2Status fmi2GetFMUstate (fmi2Component, fmi2FMUstate*);
FMI2_EXPORT fmi2Status fmi2SetFMUstate (fmi2Component, fmi2FMUstate);
FMI2_EXPORT fmi2Status fmi2FreeFMUstate (fmi2Component, fmi2FMUstate*);
FMI2_EXPORT fmi2Status fmi2SerializedFMUstateSize (fmi2Component, fmi2FMUstate, size_t*);
FMI2_EXPORT fmi2Status fmi2SerializeFMUstate (fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
FMI2_EXPORT fmi2Status fmi2DeSerializeFMUstate (fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate*);
FMI2_EXPORT fmi2Status fmi2GetDirectionalDerivative (fmi2Component, const fmi2ValueReference[], size_t, const fmi2ValueReference[], size_t,
                                                     const fmi2Real[], fmi2Real[]);
FMI2_EXPORT fmi2Status fmi2SetRealInputDerivatives (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], const fmi2Real[]);
FMI2_EXPORT fmi2Status fmi2GetRealOutputDerivatives (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], fmi2Real[]);
FMI2_EXPORT fmi2Status fmi2DoStep (fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
FMI2_EXPORT fmi2Status fmi2CancelStep (fmi2Component);
FMI2_EXPORT fmi2Status fmi2GetStatus (fmi2Component, const fmi2StatusKind, fmi2Status*);
FMI2_EXPORT fmi2Status fmi2GetRealStatus (fmi2Component, const fmi2StatusKind, fmi2Real*);
FMI2_EXPORT fmi2Status fmi2GetIntegerStatus (fmi2Component, const fmi2StatusKind, fmi2Integer*);
FMI2_EXPORT fmi2Status fmi2GetBooleanStatus (fmi2Component, const fmi2StatusKind, fmi2Boolean*);
FMI2_EXPORT fmi2Status fmi2GetStringStatus (fmi2Component, const fmi2StatusKind, fmi2String*);

#ifdef __cplusplus
}
#endif

#endif
)";
}

const char* fmuSource()
{
    return R"(// SPDX-License-Identifier: MIT
// The graph as a unit for co-simulation (FMI 2.0). A step of h seconds runs all ticks that begin within it, on the inputs that are set.
#include "@S@.hpp"
#include "fmi2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

namespace
{
constexpr std::size_t reals = @REALS@, roles = @ROLES@, integers = 2 * roles;   // of each role, the buttons, and those of its dead-man's switch
constexpr const char* kinds = "@KINDS@";   // by number of a real: an input or parameter, an output, or a limit
[[maybe_unused]] constexpr double largest = std::numeric_limits<double>::max();
constexpr const char* guid = "@GUID@";

struct Unit
{
    @C@ graph {};
    std::array<double, reals + 1> real {};   // one more, because an array may be empty
    std::array<fmi2Integer, integers + 1> integer {};
    std::array<fmi2Boolean, roles + 1> boolean {};
    double start = 0.0, now = 0.0;   // s
    std::uint64_t ticks = 0;         // since the start
    bool has_begun = false;          // the limits are fixed
};

Unit& unitOf (fmi2Component c) { return *static_cast<Unit*> (c); }

void makeNew (Unit& unit)
{
    tactus::exported::renew (unit.graph);
    unit.graph.prepare();
    unit.real.fill (0.0);
    unit.integer.fill (0);
    unit.boolean.fill (fmi2False);
    unit.start = unit.now = 0.0;
    unit.ticks = 0;
    unit.has_begun = false;
@STARTS@}

/// A limit that limits nothing is the largest number.
[[maybe_unused]] double unlimited (double limit) { return limit >= largest ? tactus::GuardLimits::none : limit; }

/// Tightens the limits to those that are set. From now on they are fixed.
void begin (Unit& unit)
{
    if (unit.has_begun) return;
    unit.has_begun = true;
@TIGHTEN@}

/// Sets a parameter or control of the graph.
void apply (Unit& unit, std::size_t number)
{
    (void) unit;
    switch (number)
    {
@SET@    default:
        break;
    }
}

void tick (Unit& unit)
{
    @C@::Inputs in;
    @C@::Outputs out;
    (void) in;
    (void) out;
@READ@    unit.graph.tick (in, out);
@WRITE@    ++unit.ticks;
}

void strike (Unit& unit)
{
    (void) unit;
@STRIKE@}

/// Ticks that begin before this time, counted from the start. A time within rounding error of a tick counts as that tick.
std::uint64_t ticksBefore (const Unit& unit, double time)
{
    constexpr double rounding = 1e-6;
    const double number = std::ceil ((time - unit.start) * @C@::rate_hz - rounding);
    return number > 0.0 ? static_cast<std::uint64_t> (number) : 0;
}

template <typename T, std::size_t size>
fmi2Status copy (const std::array<T, size>& from, std::size_t known, const fmi2ValueReference numbers[], std::size_t count, T to[])
{
    for (std::size_t i = 0; i < count; ++i)
        if (numbers[i] >= known) return fmi2Error;
    for (std::size_t i = 0; i < count; ++i)
        to[i] = from[numbers[i]];
    return fmi2OK;
}
}   // namespace

const char* fmi2GetTypesPlatform (void) { return fmi2TypesPlatform; }
const char* fmi2GetVersion (void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging (fmi2Component, fmi2Boolean, size_t, const fmi2String[]) { return fmi2OK; }

fmi2Component fmi2Instantiate (fmi2String, fmi2Type type, fmi2String given, fmi2String, const fmi2CallbackFunctions*, fmi2Boolean, fmi2Boolean)
{
    if (type != fmi2CoSimulation || given == nullptr || std::strcmp (given, guid) != 0) return nullptr;
    void* const memory = std::malloc (sizeof (Unit));
    if (memory == nullptr) return nullptr;
    auto* const unit = std::construct_at (static_cast<Unit*> (memory));
    makeNew (*unit);
    return unit;
}

void fmi2FreeInstance (fmi2Component c)
{
    if (c == nullptr) return;
    std::destroy_at (&unitOf (c));
    std::free (c);
}

fmi2Status fmi2SetupExperiment (fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean, fmi2Real)
{
    unitOf (c).start = unitOf (c).now = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode (fmi2Component) { return fmi2OK; }

fmi2Status fmi2ExitInitializationMode (fmi2Component c)
{
    begin (unitOf (c));
    return fmi2OK;
}

fmi2Status fmi2Terminate (fmi2Component) { return fmi2OK; }

fmi2Status fmi2Reset (fmi2Component c)
{
    makeNew (unitOf (c));
    return fmi2OK;
}

fmi2Status fmi2GetReal (fmi2Component c, const fmi2ValueReference numbers[], size_t count, fmi2Real to[])
{
    return copy (unitOf (c).real, reals, numbers, count, to);
}

fmi2Status fmi2GetInteger (fmi2Component c, const fmi2ValueReference numbers[], size_t count, fmi2Integer to[])
{
    return copy (unitOf (c).integer, integers, numbers, count, to);
}

fmi2Status fmi2GetBoolean (fmi2Component c, const fmi2ValueReference numbers[], size_t count, fmi2Boolean to[])
{
    return copy (unitOf (c).boolean, roles, numbers, count, to);
}

fmi2Status fmi2GetString (fmi2Component, const fmi2ValueReference[], size_t count, fmi2String[]) { return count == 0 ? fmi2OK : fmi2Error; }

fmi2Status fmi2SetReal (fmi2Component c, const fmi2ValueReference numbers[], size_t count, const fmi2Real from[])
{
    for (size_t i = 0; i < count; ++i)
        if (numbers[i] >= reals || kinds[numbers[i]] == 'o' || (kinds[numbers[i]] == 'l' && unitOf (c).has_begun)) return fmi2Error;
    for (size_t i = 0; i < count; ++i)
    {
        unitOf (c).real[numbers[i]] = from[i];
        apply (unitOf (c), numbers[i]);
    }
    return fmi2OK;
}

fmi2Status fmi2SetInteger (fmi2Component c, const fmi2ValueReference numbers[], size_t count, const fmi2Integer from[])
{
    for (size_t i = 0; i < count; ++i)
        if (numbers[i] >= (unitOf (c).has_begun ? roles : integers)) return fmi2Error;
    for (size_t i = 0; i < count; ++i)
        unitOf (c).integer[numbers[i]] = from[i];
    return fmi2OK;
}

fmi2Status fmi2SetBoolean (fmi2Component c, const fmi2ValueReference numbers[], size_t count, const fmi2Boolean from[])
{
    for (size_t i = 0; i < count; ++i)
        if (numbers[i] >= roles) return fmi2Error;
    for (size_t i = 0; i < count; ++i)
        unitOf (c).boolean[numbers[i]] = from[i];
    return fmi2OK;
}

fmi2Status fmi2SetString (fmi2Component, const fmi2ValueReference[], size_t count, const fmi2String[]) { return count == 0 ? fmi2OK : fmi2Error; }

// A unit uses no heap, and points only into itself and at constants. So its bytes are its whole state, for this unit.
fmi2Status fmi2GetFMUstate (fmi2Component c, fmi2FMUstate* state)
{
    if (*state == nullptr) *state = std::malloc (sizeof (Unit));
    if (*state == nullptr) return fmi2Error;
    std::memcpy (*state, c, sizeof (Unit));
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate (fmi2Component c, fmi2FMUstate state)
{
    if (state == nullptr) return fmi2Error;
    std::memcpy (c, state, sizeof (Unit));
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate (fmi2Component, fmi2FMUstate* state)
{
    std::free (*state);
    *state = nullptr;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize (fmi2Component, fmi2FMUstate, size_t*) { return fmi2Error; }
fmi2Status fmi2SerializeFMUstate (fmi2Component, fmi2FMUstate, fmi2Byte[], size_t) { return fmi2Error; }
fmi2Status fmi2DeSerializeFMUstate (fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate*) { return fmi2Error; }

fmi2Status fmi2GetDirectionalDerivative (fmi2Component, const fmi2ValueReference[], size_t, const fmi2ValueReference[], size_t, const fmi2Real[], fmi2Real[])
{
    return fmi2Error;
}

fmi2Status fmi2SetRealInputDerivatives (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], const fmi2Real[]) { return fmi2Error; }
fmi2Status fmi2GetRealOutputDerivatives (fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[], fmi2Real[]) { return fmi2Error; }

fmi2Status fmi2DoStep (fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean)
{
    if (! std::isfinite (now) || ! std::isfinite (step) || step < 0.0) return fmi2Error;
    auto& unit = unitOf (c);
    begin (unit);
    strike (unit);
    for (const auto end = ticksBefore (unit, now + step); unit.ticks < end;)
        tick (unit);
    unit.now = now + step;
    return fmi2OK;
}

fmi2Status fmi2CancelStep (fmi2Component) { return fmi2Error; }
fmi2Status fmi2GetStatus (fmi2Component, const fmi2StatusKind, fmi2Status*) { return fmi2Discard; }

fmi2Status fmi2GetRealStatus (fmi2Component c, const fmi2StatusKind kind, fmi2Real* value)
{
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = unitOf (c).now;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus (fmi2Component, const fmi2StatusKind, fmi2Integer*) { return fmi2Discard; }

fmi2Status fmi2GetBooleanStatus (fmi2Component, const fmi2StatusKind kind, fmi2Boolean* value)
{
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus (fmi2Component, const fmi2StatusKind, fmi2String*) { return fmi2Discard; }
)";
}

const char* fmuMake()
{
    return R"(
# make fmu: builds @S@.fmu for this computer: a zip file with the description, the shared library and the sources.
PLATFORM ?= linux64

fmu: @S@.fmu

@S@.fmu: modelDescription.xml @S@_fmu.cpp fmi2.h $(sources)
	rm -rf fmu @S@.fmu
	mkdir -p fmu/binaries/$(PLATFORM) fmu/sources
	$(CXX) $(CXXFLAGS) $(FLAGS) -fPIC -fvisibility=hidden -shared -o fmu/binaries/$(PLATFORM)/@S@.so @S@_fmu.cpp $(sources)
	cp modelDescription.xml fmu/
	cp -r *.cpp *.hpp *.h tactus Makefile LICENSE fmu/sources/
	cd fmu && (zip -qr ../@S@.fmu . || python3 -m zipfile -c ../@S@.fmu modelDescription.xml binaries sources || cmake -E tar cf ../@S@.fmu --format=zip .)

.PHONY: fmu
)";
}

}   // namespace tactus::host
