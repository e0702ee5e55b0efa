// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/message_text.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("a message in the window names no option of the command line", "[app][text]")
{
    const auto shown = [] (const char* remedy) { return messageText (Message::error ("some/id", "", "it does not fit", remedy)); };
    CHECK (shown ("") == "it does not fit");
    CHECK (shown ("make it smaller") == "it does not fit; make it smaller");
    CHECK (shown ("make it smaller; or allow more: --limits nodes=3") == "it does not fit; make it smaller");
    CHECK (shown ("--limits nodes=3 allows more; make it smaller; then save") == "it does not fit; make it smaller; then save");
    CHECK (shown ("leave out --rate") == "it does not fit");
    CHECK (shown ("write a--b") == "it does not fit; write a--b");   // no option
}
