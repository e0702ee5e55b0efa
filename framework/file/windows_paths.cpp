// SPDX-License-Identifier: MIT
// On Windows, file names have 16-bit characters. Tactus has them as UTF-8, and so has path::string(). But libstdc++ 12 makes a path of a narrow text by the
// locale of the C library, which knows no UTF-8: "größe.json" would be another name. This is what it calls for that, with UTF-8 in place of the locale.
// A definition in the program itself goes before that of the library (framework/CMakeLists.txt).
#if defined(_WIN32)
#include <codecvt>
#include <locale>

#if defined(__GLIBCXX__)

namespace
{
const std::codecvt_utf8_utf16<wchar_t>& utf8()
{
    static const auto& kept = *new std::codecvt_utf8_utf16<wchar_t> (1);   // never destroyed: other static objects may have names of files
    return kept;
}
}   // namespace

using Narrowing = std::codecvt<wchar_t, char, std::mbstate_t>;

Narrowing::result Narrowing::do_out (state_type& state, const wchar_t* from, const wchar_t* from_end, const wchar_t*& from_next, char* to, char* to_end,
                                     char*& to_next) const
{
    return utf8().out (state, from, from_end, from_next, to, to_end, to_next);
}

Narrowing::result Narrowing::do_in (state_type& state, const char* from, const char* from_end, const char*& from_next, wchar_t* to, wchar_t* to_end,
                                    wchar_t*& to_next) const
{
    for (;; from = from_next, to = to_next)
    {
        const auto result = utf8().in (state, from, from_end, from_next, to, to_end, to_next);
        const bool has_room = to_end - to_next >= 2, is_cut = result == partial && has_room;
        if (from_next == from_end || ! has_room || (result != error && ! is_cut)) return result;
        // A byte that is no UTF-8 becomes the replacement character: the file of this name does not exist. Otherwise, making the path would throw.
        ++from_next;
        *to_next++ = L'\xfffd';
        if (from_next == from_end) return ok;
    }
}

int Narrowing::do_encoding() const noexcept
{
    return utf8().encoding();
}

int Narrowing::do_length (state_type& state, const char* from, const char* end, std::size_t most) const
{
    return utf8().length (state, from, end, most);
}

int Narrowing::do_max_length() const noexcept
{
    return utf8().max_length();
}

#endif
#endif
