// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plugin/plugin_library.hpp>

#include <filesystem>
#include <string>

namespace tactus::test
{

/// A plugin that tests/plugins/objects builds.
inline std::filesystem::path pluginFile (const std::string& name) { return std::filesystem::path (TACTUS_TEST_PLUGINS) / (name + ".tactus"); }

/// The folder of the device drivers that it builds.
inline std::filesystem::path driverFolder() { return std::filesystem::path (TACTUS_TEST_PLUGINS) / "devices"; }
inline std::filesystem::path driverFile (const std::string& name) { return driverFolder() / (name + ".tactus-device"); }

/// Loads such a plugin. `present` is the catalogue that its nodes would be added to.
inline LoadedPlugins load (const std::string& name, const Catalogue& present = {}) { return loadPlugins ({ pluginFile (name) }, present); }

}   // namespace tactus::test
