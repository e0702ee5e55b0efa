// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>

namespace tactus
{

/// A loaded shared object. [main thread]
class SharedObject
{
public:
    /// Runs the code that the object runs when it is loaded.
    static Result<std::unique_ptr<SharedObject>> load (const std::filesystem::path&);

    ~SharedObject();
    SharedObject (const SharedObject&) = delete;
    SharedObject& operator= (const SharedObject&) = delete;

    /// Null if there is no such symbol.
    const void* find (const char* symbol) const noexcept;

private:
    explicit SharedObject (void* h) noexcept : handle (h) {}

    void* handle;
};

}   // namespace tactus
