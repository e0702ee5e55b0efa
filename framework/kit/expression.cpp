// SPDX-License-Identifier: MIT
#include "expression.hpp"
#include "math/math.hpp"

#include <tactus/text/is_digit.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace tactus
{

/// A recursive-descent parser. Each level of precedence is one function, which emits the steps for what it has read.
class ExpressionParser
{
public:
    using Op = Expression::Op;

    ExpressionParser (std::string_view text_, int inputs_) : text (text_), inputs (inputs_) {}

    std::vector<Expression::Step> program;
    std::string error;   // only the first error

    void parse()
    {
        skipSpace();
        if (at == text.size())
        {
            fail (at, "the formula is empty; the simplest one is in0");
            return;
        }
        choice();
        if (error.empty() && at < text.size()) fail (at, "expected an operator or the end, found " + found());
    }

private:
    std::string_view text;
    int inputs;
    std::size_t at = 0;
    int depth = 0;     // nesting depth at this point
    int stacked = 0;   // values on the stack at this point

    struct Function
    {
        std::string_view name;
        Op op;
    };

    static constexpr Function functions[] {
        { "sin", Op::sin },
        { "cos", Op::cos },
        { "tan", Op::tan },
        { "asin", Op::asin },
        { "acos", Op::acos },
        { "atan", Op::atan },
        { "sqrt", Op::sqrt },
        { "exp", Op::exp },
        { "log", Op::log },
        { "abs", Op::abs },
        { "floor", Op::floor },
        { "ceil", Op::ceil },
        { "sign", Op::sign },
        { "atan2", Op::atan2 },
        { "pow", Op::power },
        { "min", Op::min },
        { "max", Op::max },
        { "clamp", Op::clamp },
    };

    struct Nested
    {
        ExpressionParser& parser;
        explicit Nested (ExpressionParser& p) : parser (p)
        {
            if (++p.depth > 2 * Expression::max_depth)   // a bracket counts twice
                p.fail (p.at, "the formula is nested too deeply");
        }
        ~Nested() { --parser.depth; }
    };

    void choice()
    {
        const Nested here { *this };
        if (! error.empty()) return;

        comparison();
        if (! take ("?")) return;
        choice();
        expect (":");
        choice();
        emit ({ Op::choose });
    }

    void comparison()
    {
        sum();
        for (;;)
        {
            if (take ("=="))
                sum(), emit ({ Op::equal });
            else if (take ("!="))
                sum(), emit ({ Op::unequal });
            else if (take ("<="))
                sum(), emit ({ Op::less_equal });
            else if (take (">="))
                sum(), emit ({ Op::greater_equal });
            else if (take ("<"))
                sum(), emit ({ Op::less });
            else if (take (">"))
                sum(), emit ({ Op::greater });
            else
                return;
        }
    }

    void sum()
    {
        product();
        for (;;)
        {
            if (take ("+"))
                product(), emit ({ Op::add });
            else if (take ("-"))
                product(), emit ({ Op::subtract });
            else
                return;
        }
    }

    void product()
    {
        sign();
        for (;;)
        {
            if (take ("*"))
                sign(), emit ({ Op::multiply });
            else if (take ("/"))
                sign(), emit ({ Op::divide });
            else
                return;
        }
    }

    void sign()
    {
        const Nested here { *this };
        if (! error.empty()) return;

        if (take ("-"))
            sign(), emit ({ Op::negate });
        else
            power();
    }

    void power()
    {
        value();
        if (take ("^")) sign(), emit ({ Op::power });   // calling sign() allows 2^-1, and makes ^ right-associative
    }

    void value()
    {
        if (! error.empty()) return;
        if (take ("("))
        {
            choice();
            expect (")");
        }
        else if (at < text.size() && (isDigit (text[at]) || text[at] == '.'))
            number();
        else if (at < text.size() && isLetter (text[at]))
            named();
        else
            fail (at, "expected a value, found " + found());
    }

    void number()
    {
        const auto read = readNumber (std::string_view (text).substr (at));
        if (! read.is_in_range) return fail (at, "this number does not fit into a double");
        at += read.size;
        skipSpace();
        emit ({ Op::constant, 0, read.value });
    }

    void named()
    {
        const auto start = at;
        while (at < text.size() && (isLetter (text[at]) || isDigit (text[at])))
            ++at;
        const auto name = text.substr (start, at - start);
        skipSpace();

        if (name == "pi") return emit ({ Op::constant, 0, std::numbers::pi });
        if (name == "e") return emit ({ Op::constant, 0, std::numbers::e });
        if (name == "in")
        {
            expect ("[");
            const auto from = at;
            while (at < text.size() && isDigit (text[at]))
                ++at;
            const auto index = text.substr (from, at - from);
            skipSpace();
            expect ("]");
            return input (start, index);
        }
        if (name.starts_with ("in") && name.find_first_not_of ("0123456789", 2) == name.npos) return input (start, name.substr (2));

        for (const auto& f : functions)
            if (name == f.name) return call (start, f);
        fail (start, "there is no \"" + std::string { name } + "\"; use in0, in1, …, pi, e, or functions such as sin (x)");
    }

    void input (std::size_t start, std::string_view digits)
    {
        int index = -1;
        const auto [end, problem] = std::from_chars (digits.data(), digits.data() + digits.size(), index);
        if (! error.empty()) return;
        if (problem != std::errc {} || index >= inputs)
        {
            const auto all = inputs == 1 ? "in0" : "in0 to in" + std::to_string (inputs - 1);
            return fail (start, "there is no input " + std::string { digits } + "; the inputs are " + all);
        }
        emit ({ Op::input, index });
    }

    void call (std::size_t start, const Function& f)
    {
        const int wanted = Expression::operandsOf (f.op);
        int given = 0;
        expect ("(");
        do
        {
            choice();
            ++given;
        } while (error.empty() && take (","));
        expect (")");
        if (error.empty() && given != wanted)
        {
            const auto values = std::to_string (wanted) + (wanted == 1 ? " value" : " values");
            fail (start, std::string { f.name } + " takes " + values + ", but is given " + std::to_string (given));
        }
        emit ({ f.op });
    }

    void emit (Expression::Step step)
    {
        if (! error.empty()) return;
        program.push_back (step);
        stacked += 1 - Expression::operandsOf (step.op);
        if (stacked > Expression::max_depth) fail (at, "the formula is nested too deeply");
    }

    bool take (std::string_view token)
    {
        if (! error.empty() || ! text.substr (at).starts_with (token)) return false;
        at += token.size();
        skipSpace();
        return true;
    }

    void expect (std::string_view token)
    {
        if (! take (token)) fail (at, "expected " + std::string { token } + ", found " + found());
    }

    void fail (std::size_t where, const std::string& what)
    {
        const auto column = 1 + std::count_if (text.begin(), text.begin() + static_cast<std::ptrdiff_t> (where), beginsCharacter);
        if (error.empty()) error = "column " + std::to_string (column) + ": " + what;
    }

    std::string found() const
    {
        if (at == text.size()) return "the end";
        const auto begin = text.begin() + static_cast<std::ptrdiff_t> (at);
        std::string quoted = "\"";
        quoted.append (begin, std::find_if (begin + 1, text.end(), beginsCharacter));
        return quoted + "\"";
    }

    void skipSpace()
    {
        while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\n' || text[at] == '\r'))
            ++at;
    }

    static bool beginsCharacter (char c) { return (static_cast<unsigned char> (c) & 0xc0u) != 0x80u; }   // in UTF-8
    static bool isLetter (char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
};

std::string Expression::compile (std::string_view text, int inputs)
{
    ExpressionParser parser { text, inputs };
    parser.parse();
    program = parser.error.empty() ? std::move (parser.program) : std::vector<Step> {};
    return parser.error;
}

int Expression::operandsOf (Op op) noexcept
{
    switch (op)
    {
    case Op::constant:
    case Op::input:
        return 0;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::equal:
    case Op::unequal:
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::atan2:
    case Op::min:
    case Op::max:
        return 2;
    case Op::choose:
    case Op::clamp:
        return 3;
    default:
        return 1;
    }
}

// One case per line; clang-format 14 would spread each over three lines.
// clang-format off
double Expression::result (const Step& step, const double* operands, const InputList<double>& in) noexcept
{
    const double *const x = operands, *const y = operands + 1, *const z = operands + 2;
    switch (step.op)
    {
    case Op::constant: return step.value;
    case Op::input: return in[step.input];
    case Op::negate: return -*x;
    case Op::add: return *x + *y;
    case Op::subtract: return *x - *y;
    case Op::multiply: return *x * *y;
    case Op::divide: return *x / *y;
    case Op::power: return math::pow (*x, *y);
    case Op::equal: return *x == *y ? 1.0 : 0.0;
    case Op::unequal: return *x != *y ? 1.0 : 0.0;
    case Op::less: return *x < *y ? 1.0 : 0.0;
    case Op::less_equal: return *x <= *y ? 1.0 : 0.0;
    case Op::greater: return *x > *y ? 1.0 : 0.0;
    case Op::greater_equal: return *x >= *y ? 1.0 : 0.0;
    case Op::choose: return *x != 0.0 ? *y : *z;
    case Op::sin: return math::sin (*x);
    case Op::cos: return math::cos (*x);
    case Op::tan: return math::tan (*x);
    case Op::asin: return math::asin (*x);
    case Op::acos: return math::acos (*x);
    case Op::atan: return math::atan (*x);
    case Op::sqrt: return std::sqrt (*x);
    case Op::exp: return math::exp (*x);
    case Op::log: return math::log (*x);
    case Op::abs: return std::abs (*x);
    case Op::floor: return std::floor (*x);
    case Op::ceil: return std::ceil (*x);
    case Op::sign:
        if (*x > 0.0) return 1.0;
        return *x < 0.0 ? -1.0 : *x;
    case Op::atan2: return math::atan2 (*x, *y);
    case Op::min: return *y < *x ? *y : *x;
    case Op::max: return *y > *x ? *y : *x;
    case Op::clamp:
        if (*x < *y) return *y;
        return *x > *z ? *z : *x;
    }
    return 0.0;
}
// clang-format on

double Expression::operator() (const InputList<double>& in) const noexcept
{
    if (program.empty()) return 0.0;

    double stack[max_depth + 2];
    double* top = stack;   // one past the last value
    for (const auto& step : program)
    {
        top -= operandsOf (step.op);
        *top = result (step, top, in);
        ++top;
    }
    return stack[0];
}

}   // namespace tactus
