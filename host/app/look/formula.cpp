// SPDX-License-Identifier: GPL-3.0-or-later
#include "formula.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tactus::host
{

namespace
{
using Level = FormulaRun::Level;
using Pair = std::pair<std::string_view, std::string_view>;

bool isLetter (char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit (char c) { return c >= '0' && c <= '9'; }

/// "" if the word is not the name of a Greek letter.
std::string_view greek (std::string_view word)
{
    constexpr std::array<Pair, 20> letters { { { "alpha", "α" },
                                               { "beta", "β" },
                                               { "gamma", "γ" },
                                               { "delta", "δ" },
                                               { "Delta", "Δ" },
                                               { "epsilon", "ε" },
                                               { "zeta", "ζ" },
                                               { "eta", "η" },
                                               { "theta", "θ" },
                                               { "kappa", "κ" },
                                               { "lambda", "λ" },
                                               { "mu", "μ" },
                                               { "nu", "ν" },
                                               { "pi", "π" },
                                               { "rho", "ρ" },
                                               { "sigma", "σ" },
                                               { "tau", "τ" },
                                               { "phi", "φ" },
                                               { "psi", "ψ" },
                                               { "omega", "ω" } } };
    const auto found = std::ranges::find (letters, word, &Pair::first);
    return found == letters.end() ? std::string_view {} : found->second;
}

constexpr std::string_view minus_sign = "−";

class Typesetter
{
public:
    explicit Typesetter (std::string_view text) : s (text) {}

    std::vector<FormulaRun> all()
    {
        while (at < s.size())
            step();
        return std::move (runs);
    }

private:
    char now (std::size_t ahead = 0) const { return at + ahead < s.size() ? s[at + ahead] : '\0'; }
    char before() const { return at > 0 ? s[at - 1] : ' '; }

    void put (std::string_view text, Level level = Level::base)
    {
        if (text.empty()) return;
        if (! runs.empty() && runs.back().level == level && level == Level::base)
            runs.back().text += text;
        else
            runs.push_back ({ std::string (text), level });
    }

    template <typename F>
    std::string_view take (F&& belongs)
    {
        const auto begin = at;
        while (at < s.size() && belongs (s[at]))
            ++at;
        return s.substr (begin, at - begin);
    }

    void step()
    {
        if (isLetter (now())) return word();
        if (isDigit (now())) return number();
        if (now() == '^' && at > 0) return ++at, put (group(), Level::raised);
        symbol();
    }

    void number()
    {
        put (take ([] (char c) { return isDigit (c) || c == '.'; }));
        const bool has_sign = now (1) == '-' || now (1) == '+';
        if (now() != 'e' || ! isDigit (now (has_sign ? 2 : 1))) return;
        put (s.substr (at, has_sign ? 2 : 1));
        at += has_sign ? 2 : 1;
        put (take (isDigit));
    }

    void word()
    {
        const auto w = take (isLetter);
        const bool has_lowered = now() == '_' && (isLetter (now (1)) || isDigit (now (1)) || now (1) == '(');
        if (w == "sqrt")
        {
            put ("√");
            if (now() == ' ' && now (1) == '(') ++at;
            return;
        }
        auto symbol_of = greek (w);
        std::string shown (symbol_of.empty() ? w : symbol_of);
        if (const auto of_small = w.size() > 2 && w.front() == 'd' ? greek (w.substr (1)) : std::string_view {}; ! of_small.empty())
            shown = 'd' + std::string (symbol_of = of_small);
        if (has_lowered && (w == "sum" || w == "integral")) shown = symbol_of = w == "sum" ? "Σ" : "∫";
        put (shown);
        if (w.size() == 1 || ! symbol_of.empty()) put (take (isDigit), Level::lowered);
        if (! has_lowered) return;
        if (w.size() > 2 && symbol_of.empty()) return put (take ([] (char c) { return isLetter (c) || isDigit (c) || c == '_'; }));   // a param
        ++at;
        put (group(), Level::lowered);
    }

    /// The text that a sign for raised or lowered text applies to: the inside of brackets, or a word or number with its sign.
    std::string group()
    {
        std::string_view inside;
        if (now() == '(')
        {
            const auto begin = ++at;
            for (int depth = 1; at < s.size(); ++at)
            {
                if (s[at] == '(') ++depth;
                if (s[at] == ')' && --depth == 0) break;
            }
            inside = s.substr (begin, at - begin);
            if (at < s.size()) ++at;
        }
        else
        {
            const auto begin = at;
            if (now() == '-' || now() == '+') ++at;
            take ([] (char c) { return isLetter (c) || isDigit (c); });
            if (now() == '.' && isDigit (now (1))) ++at, take (isDigit);
            inside = s.substr (begin, at - begin);
        }
        std::string text;
        for (const auto& run : typeset (inside))   // on one level: a second one would be too small to read
            text += run.text;
        for (auto i = text.find ('-'); i != std::string::npos; i = text.find ('-', i + minus_sign.size()))
            text.replace (i, 1, minus_sign);
        return text;
    }

    void symbol()
    {
        constexpr std::array<Pair, 5> signs { { { "<=", "≤" }, { ">=", "≥" }, { "<-", "←" }, { "->", "→" }, { "+-", "±" } } };
        for (const auto& [written, sign] : signs)
            if (s.substr (at).starts_with (written))
            {
                put (sign);
                at += written.size();
                return;
            }
        const bool is_alone = before() == ' ' && now (1) == ' ';
        const bool is_minus = now() == '-' && (before() == ' ' || before() == '(' || before() == '|') && now (1) != '-';
        if (is_minus)
            put (minus_sign);
        else if (is_alone && (now() == '.' || now() == '*'))
            put ("·");
        else if (now() != '`')
            put (s.substr (at, 1));
        ++at;
    }

    std::string_view s;
    std::size_t at = 0;
    std::vector<FormulaRun> runs;
};
}   // namespace

std::vector<FormulaRun> typeset (std::string_view text) { return Typesetter (text).all(); }

}   // namespace tactus::host
