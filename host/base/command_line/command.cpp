// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

namespace tactus::host
{

namespace
{
Check checkOf (const CLI::Validator& v)
{
    return { [v] (const std::string& value) { return v (value); },
             v.get_description() };
}

/// The command, or the program if no command was given.
const CLI::App& givenCommand (const CLI::App& program)
{
    const auto given = program.get_subcommands();
    return given.empty() ? program : *given.front();
}

/// The option that may have been meant by an argument that the command does not know.
std::string suggestionFor (const CLI::App& program)
{
    const auto& command = givenCommand (program);
    std::vector<std::string> known;
    for (const auto* sub : command.get_subcommands ([] (const CLI::App*) { return true; }))
        known.push_back (sub->get_name());
    for (const auto* option : command.get_options())
        for (const auto& name : option->get_lnames())
            known.push_back ("--" + name);
    for (const auto& argument : program.remaining (true))
        if (const auto meant = didYouMean (argument.substr (0, argument.find ('=')), known); ! meant.empty()) return meant;
    return "";
}

/// The message about a wrong command line. CLI11 repeats arguments as they are, so this escapes what could disturb a terminal, and line ends, which
/// could forge a message.
std::string usageMessage (const CLI::App* app, const CLI::Error& error)
{
    std::string what = error.what();
    const std::string help = CLI::FailureMessage::simple (app, error).substr (what.size());   // how to ask for help
    if (error.get_name() == "RequiredError")
    {
        auto* within = app;
        while (! within->get_subcommands().empty())
            within = within->get_subcommands().front();
        if (const auto unknown = within->remaining(); ! unknown.empty() && ! within->get_subcommands ({}).empty())
            what = "There is no command " + quote (within == app ? unknown.front() : within->get_name() + " " + unknown.front());
    }
    what += suggestionFor (*app);
    std::string shown;
    for (const char c : printable (what))
        shown += c == '\n' ? "\\x0A" : std::string (1, c);
    return shown + help;
}

template <typename Parse>
std::optional<int> statusOf (CLI::App& app, Parse&& parse)
{
    try
    {
        parse();
        return std::nullopt;
    }
    catch (const UsageError& error)
    {
        return app.exit (CLI::ValidationError (error.what()));
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit (error);
    }
}
}   // namespace

//==============================================================================
Check within (int min, int max) { return checkOf (CLI::Range (min, max)); }
Check within (double min, double max) { return checkOf (CLI::Range (min, max)); }
Check positive() { return checkOf (CLI::PositiveNumber); }
Check oneOf (const std::vector<std::string>& values) { return checkOf (CLI::IsMember (values)); }

Check finiteWithin (double min, double max)
{
    const auto range = "from " + numberText (min) + " to " + numberText (max);
    return { [=] (const std::string& text) {
                const auto value = wholeNumber (text);
                const bool fits = value && *value >= min && *value <= max;
                const bool has_unit = text.find_first_of ("0123456789") == 0 && std::isalpha (static_cast<unsigned char> (text.back()));
                return fits ? std::string() : "'" + text + "' is not a number " + range + (has_unit ? "; write it without a unit" : "");
            },
             range };
}

//==============================================================================
Option Option::required (bool is) const
{
    option->required (is);
    return *this;
}

Option Option::check (const Check& check) const
{
    option->check ([problem = check.problem] (const std::string& text) { return problem (text); },
                   check.type);
    return *this;
}

Option Option::needs (Option other) const
{
    option->needs (other.option);
    return *this;
}

Option Option::excludes (Option other) const
{
    option->excludes (other.option);
    return *this;
}

Option Option::separatedBy (char delimiter) const
{
    option->delimiter (delimiter);
    return *this;
}

Option Option::oneValueEach() const
{
    option->allow_extra_args (false);
    return *this;
}

Option Option::type (const std::string& name) const
{
    option->type_name (name);
    return *this;
}

bool Option::isGiven() const { return option->count() > 0; }

//==============================================================================
Command::Command (const std::string& about, const std::string& name) : app (std::make_shared<CLI::App> (about, name))
{
    app->failure_message (usageMessage);
    app->allow_windows_style_options (false);   // options are the same on all systems, and /name is a file
}

Command Command::add (const std::string& name, const std::string& about) const
{
    return Command ({ app, app->add_subcommand (name, about) });   // the program owns the command
}

Option Command::addOption (const std::string& name, std::string& value, const std::string& about) const
{
    return Option (app->add_option (name, value, about));
}

Option Command::addOption (const std::string& name, double& value, const std::string& about) const
{
    const CLI::callback_t take = [&value] (const CLI::results_t& given) {
        const auto number = given.size() == 1 ? wholeNumber (given.front()) : std::nullopt;
        value = number.value_or (value);
        return number.has_value();
    };
    auto* option = app->add_option (name, take, about);
    option->type_name ("FLOAT");
    return Option (option);
}

Option Command::addOption (const std::string& name, int& value, const std::string& about) const
{
    return Option (app->add_option (name, value, about));
}

Option Command::addOption (const std::string& name, std::optional<int>& value, const std::string& about) const
{
    return Option (app->add_option (name, value, about));
}

Option Command::addOption (const std::string& name, std::vector<std::string>& values, const std::string& about) const
{
    return Option (app->add_option (name, values, about));
}

Option Command::addOption (const std::string& name, std::function<void (const std::string&)> take, const std::string& about) const
{
    return Option (app->add_option_function<std::string> (name, std::move (take), about));
}

Option Command::addFlag (const std::string& name, bool& value, const std::string& about) const { return Option (app->add_flag (name, value, about)); }

Option Command::addHiddenFlag (const std::string& name, bool& value) const
{
    auto* flag = app->add_flag (name, value);
    flag->group ("");
    return Option (flag);
}

Option Command::get (const std::string& name) const { return Option (app->get_option (name)); }

void Command::footer (const std::string& text) const
{
    app->footer (text);
}

void Command::version (const std::string& text) const
{
    app->set_version_flag ("--version", text);
}

void Command::requireCommand() const
{
    app->require_subcommand (1);
}

void Command::callback (std::function<void()> run) const
{
    app->callback (std::move (run));
}

void Command::passOn (std::function<void (const std::vector<std::string>&)> run) const
{
    app->prefix_command();
    app->set_help_flag();
    app->callback ([run = std::move (run), command = app.get()] { run (command->remaining()); });
}

std::optional<int> Command::parse (std::vector<std::string> arguments) const
{
    std::ranges::reverse (arguments);   // CLI11 takes arguments from the back
    return statusOf (*app, [&] { app->parse (std::move (arguments)); });
}

std::optional<int> Command::parse (int argc, const char* const* argv) const
{
    return statusOf (*app, [&] { app->parse (argc, argv); });
}

}   // namespace tactus::host
