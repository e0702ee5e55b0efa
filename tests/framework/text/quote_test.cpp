// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/text/quote.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("quote: whatever could disturb a terminal is escaped", "[text]")
{
    CHECK (quote ("dry wood, 0.3 µm, 木") == "'dry wood, 0.3 µm, 木'");
    CHECK (quote ("a\x1b[31mb\n") == "'a\\x1B[31mb\\x0A'");
    CHECK (quote ("c1 \xc2\x9b") == "'c1 \\xC2\\x9B'");   // U+009B begins a control sequence, like ESC [
    CHECK (quote ("\xe2\x80\xae"
                  "gpj")
           == "'\\xE2\\x80\\xAEgpj'");   // U+202E writes from right to left
    CHECK (quote ("in\xe2\x80\x8b"
                  "visible")
           == "'in\\xE2\\x80\\x8Bvisible'");   // U+200B has no width
    CHECK (quote ("\xff\xc3") == "'\\xFF\\xC3'");
    CHECK (quotePath ("/" + std::string (200, 'a') + "\n.json") == "'/" + std::string (200, 'a') + "\\x0A.json'");
    CHECK (quote (std::string (100, 'a')) == "'" + std::string (60, 'a') + "…'");
    CHECK (printable ("two\nlines\r") == "two\nlines\\x0D");
}

TEST_CASE ("quote: a name takes one line of at most 200 characters and is never cut within one", "[text]")
{
    CHECK (printableName ("dry wood, 木") == "dry wood, 木");
    CHECK (printableName ("a\nb\x1b") == "a\\x0Ab\\x1B");
    CHECK (printableName (std::string (200, 'a')) == std::string (200, 'a'));
    CHECK (printableName (std::string (201, 'a')) == std::string (200, 'a') + "…");
    std::string woods, whole;
    for (int i = 0; i < 300; ++i)
    {
        woods += "木";
        if (i < 200) whole += "木";
    }
    CHECK (printableName (woods) == whole + "…");
    CHECK (printableName (std::string (199, 'a') + "\x1b") == std::string (199, 'a') + "…");   // an escape has four characters
}

TEST_CASE ("quote: any bytes become text without control characters", "[text]")
{
    test::property ("any bytes", [] (const std::string& bytes) {
        for (const auto& out : { quote (bytes), printable (bytes), printableName (bytes) })
            for (const char c : out)
                RC_ASSERT (static_cast<unsigned char> (c) >= 0x20u || c == '\n');
        RC_ASSERT (quote (bytes).find ('\n') == std::string::npos);
        RC_ASSERT (printableName (bytes).find ('\n') == std::string::npos);
        RC_ASSERT (printable (printable (bytes)) == printable (bytes));
    });
}
