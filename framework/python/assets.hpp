// SPDX-License-Identifier: MIT
#pragma once

#include "messages.hpp"

#include <exception>
#include <string>

namespace tactus::python
{

/// The assets that a Python program supplies to one run: a function that tactus/_assets.py makes.
class PythonAssets
{
public:
    /// `function` takes the kind and the path, and returns None or a dict of arrays. None: all assets are read from files. [with the GIL]
    explicit PythonAssets (py::object f) : function (std::move (f)) {}
    PythonAssets (const PythonAssets&) = delete;
    PythonAssets& operator= (const PythonAssets&) = delete;

    /// What the C API asks. It refers to this object.
    capi::AssetReader reader() noexcept { return function.is_none() ? capi::AssetReader {} : capi::AssetReader { read, this }; }

    /// Frees the arrays of the latest answer. Call it when the C API has taken them, before another thread may ask. [without the GIL]
    void release();

    /// If the function has raised an exception, raises it again, but only once. [with the GIL]
    void raiseFailure();

private:
    static tactus_asset_answer read (void* context, tactus_asset_kind, const char* path, tactus_asset*) noexcept;
    tactus_asset_answer ask (tactus_asset_kind, const char* path, tactus_asset&);

    py::object function, latest;   // latest: keeps the arrays of the latest answer alive
    std::exception_ptr failure;
};

}   // namespace tactus::python
