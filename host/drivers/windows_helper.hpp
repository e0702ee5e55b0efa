// SPDX-License-Identifier: MIT
// The helper process of helper_program.hpp on Windows. The handles of the driver have the same numbers in the helper.
#pragma once

#include "helper_side.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tactus::host
{

inline std::filesystem::path findHelper (const void* in_driver, const std::string& name, std::string& why)
{
    HMODULE self = nullptr;
    std::wstring path (32768, L'\0');
    constexpr DWORD by_address = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    if (::GetModuleHandleExW (by_address, static_cast<LPCWSTR> (in_driver), &self) == 0)
        return why = "the driver does not know where it is", std::filesystem::path();
    path.resize (::GetModuleFileNameW (self, path.data(), static_cast<DWORD> (path.size())));
    const auto folder = std::filesystem::path (path).parent_path();
    why = "the program " + name + ".exe is not in " + folder.string() + ", next to the driver";
    std::error_code failed;
    for (const auto& file : { folder / (name + ".exe"), folder / "../lib/tactus/plugins" / (name + ".exe") })
        if (std::filesystem::exists (file, failed)) return file;
    return {};
}

class HelperProcess
{
public:
    HelperProcess() = default;
    HelperProcess (const HelperProcess&) = delete;
    HelperProcess& operator= (const HelperProcess&) = delete;

    ~HelperProcess()
    {
        constexpr int patience_ms = 3000;
        close (to_helper);
        if (process != nullptr && ! hasEnded (patience_ms)) kill();
        close (process);
        close (from_helper);
    }

    std::string start (const void* in_driver, const std::string& name, std::vector<std::string> arguments, std::vector<int> files, char* const*)
    {
        std::string why;
        const auto program = findHelper (in_driver, name, why);
        if (program.empty()) return why;
        HANDLE towards = nullptr, from = nullptr;
        if (::CreatePipe (&towards, &to_helper, nullptr, 0) == 0 || ::CreatePipe (&from_helper, &from, nullptr, 0) == 0) return "no pipes for " + name;
        files.insert (files.end(), { numberOf (towards), numberOf (from) });
        for (const int each : files)
        {
            ::SetHandleInformation (handleOf (each), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
            arguments.push_back (std::to_string (each));
        }
        auto command = L"\"" + program.wstring() + L"\"";
        for (const auto& argument : arguments)
            command += L" \"" + std::filesystem::path (argument).wstring() + L"\"";
        STARTUPINFOW how {};
        how.cb = sizeof how;
        PROCESS_INFORMATION started {};
        const bool runs = ::CreateProcessW (program.c_str(), command.data(), nullptr, nullptr, TRUE, CREATE_NEW_PROCESS_GROUP | CREATE_NO_WINDOW, nullptr,
                                            nullptr, &how, &started)
                          != 0;
        const auto error = static_cast<int> (::GetLastError());
        for (const int each : files)
            ::SetHandleInformation (handleOf (each), HANDLE_FLAG_INHERIT, 0);
        close (towards);
        close (from);
        if (! runs) return program.string() + " cannot be started: " + std::system_category().message (error);
        close (started.hThread);
        process = started.hProcess;
        return {};
    }

    std::optional<std::string> firstLine() const
    {
        std::string said;
        DWORD got = 0;
        for (char byte = 0; ::ReadFile (from_helper, &byte, 1, &got, nullptr) != 0 && got == 1; said += byte)
            if (byte == '\n') return said;
        return std::nullopt;
    }

    bool hasEnded (int wait_ms) const { return ::WaitForSingleObject (process, static_cast<DWORD> (wait_ms)) == WAIT_OBJECT_0; }
    void kill() const { ::TerminateProcess (process, 1); }

private:
    static void close (HANDLE& handle) noexcept
    {
        if (handle != nullptr) ::CloseHandle (std::exchange (handle, nullptr));
    }

    HANDLE to_helper = nullptr, from_helper = nullptr, process = nullptr;
};

}   // namespace tactus::host
