// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}   // namespace CLI

namespace tactus::host
{

/// Thrown when the command line is wrong in a way that only the command itself can detect. Gives the exit status of wrong usage.
struct UsageError : std::runtime_error
{
    explicit UsageError (const std::string& what) : runtime_error (what) {}
    UsageError (const std::string& option, const std::string& what) : runtime_error (option + ": " + what) {}
};

/// A condition on the value of an option.
struct Check
{
    std::function<std::string (const std::string& value)> problem;   ///< what is wrong with the value; empty if it is fine
    std::string type;                                                ///< shown in the help, after the option
};

Check within (int min, int max);
Check within (double min, double max);
Check finiteWithin (double min, double max);   ///< like within, but also refuses nan
Check positive();
Check oneOf (const std::vector<std::string>&);

/// An option, flag or positional argument of a command. A handle: copies refer to the same option.
class Option
{
public:
    Option required (bool is = true) const;
    Option check (const Check&) const;
    Option needs (Option) const;
    Option excludes (Option) const;
    Option separatedBy (char) const;   ///< allows several values in one argument
    Option oneValueEach() const;       ///< allows the option several times, with one value each time
    Option type (const std::string&) const;

    bool isGiven() const;   ///< valid after parsing

private:
    friend class Command;
    explicit Option (CLI::Option* o) : option (o) {}

    CLI::Option* option;
};

/// A program or one of its commands, with options and help. A handle: copies refer to the same command. CLI11 does the work;
/// only command.cpp includes it, because it takes ten seconds to compile.
class Command
{
public:
    Command (const std::string& about, const std::string& name = {});   ///< makes the top-level command, the program itself; add() makes its subcommands
    Command add (const std::string& name, const std::string& about) const;

    /// Options are named --like-this, positional arguments without dashes.
    Option addOption (const std::string& name, std::string& value, const std::string& about) const;
    Option addOption (const std::string& name, double& value, const std::string& about) const;
    Option addOption (const std::string& name, int& value, const std::string& about) const;
    Option addOption (const std::string& name, std::optional<int>& value, const std::string& about) const;
    Option addOption (const std::string& name, std::vector<std::string>& values, const std::string& about) const;
    Option addOption (const std::string& name, std::function<void (const std::string&)> take, const std::string& about) const;
    Option addFlag (const std::string& name, bool& value, const std::string& about) const;
    Option addHiddenFlag (const std::string& name, bool& value) const;
    Option get (const std::string& name) const;

    void footer (const std::string& text) const;
    void version (const std::string& text) const;                                ///< adds --version
    void requireCommand() const;                                                 ///< requires one of the commands that were added
    void callback (std::function<void()>) const;                                 ///< called after the command line has been parsed
    void passOn (std::function<void (const std::vector<std::string>&)>) const;   ///< passes on all arguments unchanged, including --help

    /// Parses, then runs the callbacks. Returns a value if the program should end here: 0 after --help and --version, or a nonzero
    /// status for wrong usage, which it reports to stderr. Passes on exceptions from callbacks, except UsageError.
    std::optional<int> parse (std::vector<std::string> arguments) const;
    std::optional<int> parse (int argc, const char* const* argv) const;

private:
    explicit Command (std::shared_ptr<CLI::App> a) : app (std::move (a)) {}

    std::shared_ptr<CLI::App> app;
};

}   // namespace tactus::host
