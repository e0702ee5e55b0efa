// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// A function for each file that the settings of a graph name. It returns true if loading the file now gives the same content as when the
/// graph was compiled. It also returns false if no node uses that content any more. [main thread]
using FileChecks = std::vector<std::function<bool (Assets&)>>;

template <typename T>
void addCheck (FileChecks& all, Assets::Loaded<T> (Assets::*kind) (const std::string&), std::string path, const std::shared_ptr<const T>& content)
{
    all.push_back ([kind, path = std::move (path), then = std::weak_ptr<const T> (content)] (Assets& assets) {
        const auto same = then.lock();
        if (same == nullptr) return false;
        const auto now = (assets.*kind) (path);
        return now && *now == same;
    });
}

}   // namespace tactus::plan
