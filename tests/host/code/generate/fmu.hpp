// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tactus::test
{

/// A minimal importer of units for co-simulation (FMI 2.0): reads a description and calls the functions of a shared library.
class Fmu
{
public:
    struct Variable
    {
        unsigned number = 0;
        std::string type, causality, start;
    };

    /// Makes an instance; of() is null if the unit refuses the GUID.
    Fmu (const std::string& description, const std::string& library, const std::string& guid = {});
    ~Fmu();
    Fmu (const Fmu&) = delete;
    Fmu& operator= (const Fmu&) = delete;

    bool isThere() const noexcept { return instance != nullptr; }
    const std::map<std::string, Variable>& variables() const noexcept { return all; }
    std::string attribute (const std::string& name) const;   ///< of the description itself

    bool set (const std::string& name, double value);
    double get (const std::string& name) const;
    bool step (double now, double h);
    bool reset();

    void* state();   ///< a copy of the state; to be freed
    bool setState (void* state);
    void freeState (void* state);

private:
    std::map<std::string, Variable> all;
    std::string text;
    void* library = nullptr;
    void* instance = nullptr;

    template <typename Function>
    Function function (const char* name) const;
};

}   // namespace tactus::test
