// SPDX-License-Identifier: MIT
#include "budget.hpp"

#include "closest_match.hpp"
#include "number_text.hpp"
#include "quote.hpp"
#include "read_number.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace tactus
{

namespace
{
Budgets current_budgets;
thread_local double charged = 0.0;   // bytes

const BudgetSheet& sheetOf (double Budgets::*which) noexcept { return *std::ranges::find (budget_sheets, which, &BudgetSheet::value); }

bool isInBytes (const BudgetSheet& sheet) noexcept { return sheet.unit == "bytes"; }
bool isInSeconds (const BudgetSheet& sheet) noexcept { return sheet.unit == "s"; }

/// Without an exponent, unlike numberText.
std::string plainText (double v) { return v == std::floor (v) && v < 1e15 ? std::to_string (static_cast<long long> (v)) : numberText (v); }

/// "64 MB", "200000 nodes", "7.5 s".
std::string amountText (const BudgetSheet& sheet, double amount)
{
    if (isInBytes (sheet) && amount < 1e5) return plainText (amount) + " bytes";
    if (isInBytes (sheet)) return plainText (std::ceil (amount / 1e5) / 10.0) + " MB";
    return plainText (isInSeconds (sheet) ? std::ceil (10.0 * amount) / 10.0 : std::ceil (amount)) + " " + std::string (sheet.unit);
}

/// An amount with room to spare, as --limits takes it: "400k", "2GB", "60s".
std::string limitText (const BudgetSheet& sheet, double amount)
{
    const double digit = std::pow (10.0, std::floor (std::log10 (std::max (amount, 1.0))));
    double rounded = std::ceil (amount / digit) * digit;
    const char* suffix = "";
    for (const auto& [size, name] : { std::pair (1e9, "G"), std::pair (1e6, "M"), std::pair (1e3, "k") })
        if (rounded >= size)
        {
            rounded /= size;
            suffix = name;
            break;
        }
    return plainText (std::round (rounded)) + suffix + (isInBytes (sheet) ? "B" : isInSeconds (sheet) ? "s"
                                                                                                      : "");
}

std::optional<double> amountIn (std::string_view text, const BudgetSheet& sheet)
{
    const auto number = readNumber (text);
    if (! number.is_in_range) return std::nullopt;
    double amount = number.value;
    auto suffix = text.substr (number.size);
    if ((isInBytes (sheet) && suffix.ends_with ('B')) || (isInSeconds (sheet) && suffix.ends_with ('s'))) suffix.remove_suffix (1);
    if (suffix == "k")
        amount *= 1e3;
    else if (suffix == "M")
        amount *= 1e6;
    else if (suffix == "G")
        amount *= 1e9;
    else if (! suffix.empty())
        return std::nullopt;
    constexpr double most = 1e15;   // counts stay exact
    const double least = isInSeconds (sheet) ? 1e-6 : 1.0;
    return amount >= least && amount <= most ? std::optional (amount) : std::nullopt;
}

Result<> readLimit (std::string_view text, Budgets& to)
{
    const auto fail = [] (std::string what, std::string remedy) { return Message::error ("limits/value", "--limits", std::move (what), std::move (remedy)); };
    const auto equals = text.find ('=');
    const auto name = text.substr (0, equals);
    const auto sheet = std::ranges::find (budget_sheets, name, &BudgetSheet::name);
    if (sheet == std::end (budget_sheets))
    {
        std::vector<std::string> names;
        for (const auto& s : budget_sheets)
            names.emplace_back (s.name);
        return fail ("there is no budget " + quote (name), suggestion (name, names));
    }
    const auto value = equals == text.npos ? std::string_view {} : text.substr (equals + 1);
    const auto amount = amountIn (value, *sheet);
    if (! amount)
        return fail (quote (value) + " is not an amount for the budget `" + std::string (name) + "`",
                     "give a positive number, such as " + std::string (name) + "=" + limitText (*sheet, Budgets {}.*sheet->value));
    to.*sheet->value = *amount;
    return {};
}
}   // namespace

const Budgets& budgets() noexcept { return current_budgets; }

void setBudgets (const Budgets& b) noexcept { current_budgets = b; }

Result<Budgets> readLimits (std::string_view text)
{
    Budgets read;
    while (! text.empty())
    {
        const auto one = text.substr (0, text.find (','));
        if (auto taken = readLimit (one, read); ! taken) return taken.error();
        text.remove_prefix (std::min (one.size() + 1, text.size()));
    }
    return read;
}

Message overBudget (std::string id, double Budgets::*which, const std::string& what, double needed, const std::string& remedy)
{
    const auto& sheet = sheetOf (which);
    const double allowed = current_budgets.*which;
    const std::string name (sheet.name);
    return Message::error (std::move (id), {},
                           what + " takes " + amountText (sheet, needed) + " or more; the budget `" + name + "` allows " + amountText (sheet, allowed),
                           remedy + ", or raise the budget: --limits " + name + "=" + limitText (sheet, std::max (needed, 2.0 * allowed)));
}

void beginReading() noexcept { charged = 0.0; }

bool chargeReading (double bytes) noexcept
{
    charged += bytes;
    return charged <= current_budgets.reading;
}

Message overReading (std::string id, const std::string& what)
{
    return overBudget (std::move (id), &Budgets::reading, "with " + what + ", reading the files of the graph", charged, "use fewer or smaller files");
}

}   // namespace tactus
