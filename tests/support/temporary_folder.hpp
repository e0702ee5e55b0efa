// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

/// A temporary folder for a test, removed at its end.
class TemporaryFolder
{
public:
    TemporaryFolder()
    {
        static std::atomic<int> count { 0 };
        const auto name = "tactus-test-" + std::to_string (std::random_device {}()) + "-" + std::to_string (count++);
        folder = std::filesystem::temp_directory_path() / name;
        std::filesystem::create_directories (folder);
    }

    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all (folder, ignored);
    }

    TemporaryFolder (const TemporaryFolder&) = delete;
    TemporaryFolder& operator= (const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return folder; }
    std::filesystem::path operator/ (const std::string& name) const { return folder / name; }
    bool isEmpty() const { return std::filesystem::is_empty (folder); }

    std::string textOf (const std::string& name) const
    {
        std::ifstream in (folder / name, std::ios::binary);
        return { std::istreambuf_iterator<char> (in), {} };
    }

    void write (const std::string& name, const std::string& text) const
    {
        std::ofstream (folder / name, std::ios::binary) << text;
    }

private:
    std::filesystem::path folder;
};
