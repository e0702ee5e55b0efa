// SPDX-License-Identifier: MIT
// Properties of RapidCheck whose bodies have one type. rc::prop compiles forty functions for each body, which would be half of the code of the tests
// of nodes.
#pragma once

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <functional>
#include <string>
#include <tuple>
#include <type_traits>

namespace tactus::test
{
/// A section of a test. RapidCheck runs the body many times, each time with new random inputs, which the body draws (*rc::gen::…), and searches for
/// the simplest inputs with which it fails.
void property (const std::string& name, const std::function<void()>& body);

template <class... Inputs>
void propertyOf (const std::string& name, const std::function<void (Inputs...)>& body)
{
    property (name, [&] {
        const std::tuple<std::decay_t<Inputs>...> inputs { *rc::gen::arbitrary<std::decay_t<Inputs>>()... };
        std::apply (body, inputs);
    });
}

template <class Body>
concept TakesInputs = ! std::is_invocable_v<Body>;

/// The same with a body that takes its random inputs as arguments.
template <TakesInputs Body>
void property (const std::string& name, Body body)
{
    propertyOf (name, std::function (std::move (body)));
}
}   // namespace tactus::test
