// SPDX-License-Identifier: MIT
#include "fmu.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <limits>

namespace tactus::test
{

namespace
{
using Status = int;

std::string attributeOf (const std::string& tag, const std::string& name)
{
    const auto key = " " + name + "=\"";
    const auto at = tag.find (key);
    if (at == std::string::npos) return {};
    return tag.substr (at + key.size(), tag.find ('"', at + key.size()) - at - key.size());
}
}   // namespace

template <typename Function>
Function Fmu::function (const char* name) const
{
    return reinterpret_cast<Function> (dlsym (library, name));
}

Fmu::Fmu (const std::string& description, const std::string& path, const std::string& guid) : text (description)
{
    for (std::size_t at = 0; (at = text.find ("<ScalarVariable", at)) != std::string::npos; ++at)
    {
        const auto tag = text.substr (at, text.find ("</ScalarVariable>", at) - at);
        const auto inner = tag.substr (tag.find ('>') + 1);
        const auto number = static_cast<unsigned> (std::stoul (attributeOf (tag, "valueReference")));
        all[attributeOf (tag, "name")] = { number, inner.substr (1, inner.find_first_of (" /") - 1),
                                           attributeOf (tag, "causality"), attributeOf (inner, "start") };
    }
    library = dlopen (path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return;
    const auto instantiate = function<void* (*)(const char*, int, const char*, const char*, const void*, int, int)> ("fmi2Instantiate");
    if (instantiate == nullptr) return;
    instance = instantiate ("test", 1, (guid.empty() ? attribute ("guid") : guid).c_str(), "", nullptr, 0, 0);
    if (instance == nullptr) return;
    function<Status (*) (void*, int, double, double, int, double)> ("fmi2SetupExperiment") (instance, 0, 0.0, 0.0, 0, 0.0);
    function<Status (*) (void*)> ("fmi2EnterInitializationMode") (instance);
    function<Status (*) (void*)> ("fmi2ExitInitializationMode") (instance);
}

Fmu::~Fmu()
{
    if (instance != nullptr) function<void (*) (void*)> ("fmi2FreeInstance") (instance);
    if (library != nullptr) dlclose (library);
}

std::string Fmu::attribute (const std::string& name) const
{
    const auto at = text.find ("<fmiModelDescription");
    return attributeOf (text.substr (at, text.find ('>', at) - at), name);
}

bool Fmu::set (const std::string& name, double value)
{
    const auto& v = all.at (name);
    using SetReal = Status (*) (void*, const unsigned*, std::size_t, const double*);
    if (v.type == "Real") return function<SetReal> ("fmi2SetReal") (instance, &v.number, 1, &value) == 0;
    const int whole = static_cast<int> (value);
    return function<Status (*) (void*, const unsigned*, std::size_t, const int*)> (v.type == "Integer" ? "fmi2SetInteger" : "fmi2SetBoolean") (
               instance, &v.number, 1, &whole)
           == 0;
}

double Fmu::get (const std::string& name) const
{
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto& v = all.at (name);
    function<Status (*) (void*, const unsigned*, std::size_t, double*)> ("fmi2GetReal") (instance, &v.number, 1, &value);
    return value;
}

bool Fmu::step (double now, double h) { return function<Status (*) (void*, double, double, int)> ("fmi2DoStep") (instance, now, h, 1) == 0; }
bool Fmu::reset() { return function<Status (*) (void*)> ("fmi2Reset") (instance) == 0; }

void* Fmu::state()
{
    void* copy = nullptr;
    function<Status (*) (void*, void**)> ("fmi2GetFMUstate") (instance, &copy);
    return copy;
}

bool Fmu::setState (void* copy) { return function<Status (*) (void*, void*)> ("fmi2SetFMUstate") (instance, copy) == 0; }
void Fmu::freeState (void* copy) { function<Status (*) (void*, void**)> ("fmi2FreeFMUstate") (instance, &copy); }

}   // namespace tactus::test
