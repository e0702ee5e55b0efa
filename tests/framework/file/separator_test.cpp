// SPDX-License-Identifier: MIT
// The separator of a table, and its decimal commas. tests/framework/file/dialects_test.cpp reads whole tables.
#include <tactus/file/separator.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("a row of numbers decides about its separator, even if its decimal sign is a comma", "[file][csv]")
{
    CHECK (separatorOf ("1,2,3") == ',');
    CHECK (separatorOf ("1;2;3") == ';');
    CHECK (separatorOf ("1,5;2,5") == ';');
    CHECK (separatorOf ("1,5\t2,5\t") == '\t');
    CHECK (separatorOf ("-1.5e-3 2 3") == ' ');
    CHECK (separatorOf ("\"1,5\";\"2,5\"") == ';');
    CHECK (separatorOf ("1,5;;2") == ';');
    CHECK (separatorOf (";1,5;2") == ';');
    CHECK (separatorOf ("1;2,5,7") == ';');   // its last field is no number, which the reader says
    CHECK (separatorOf ("") == ' ');
}

TEST_CASE ("a row of names is separated by the first of comma, semicolon and tab outside of quotes", "[file][csv]")
{
    CHECK (separatorOf ("time,force") == ',');
    CHECK (separatorOf ("time;force") == ';');
    CHECK (separatorOf ("time\tforce") == '\t');
    CHECK (separatorOf ("time (s);force, filtered") == ',');
    CHECK (separatorOf ("time (s);\"force, filtered\"") == ';');
    CHECK (separatorOf ("time force") == ' ');
}

TEST_CASE ("the first row decides for a row with something that is no number", "[file][csv]")
{
    CHECK (separatorOf ("1.000,5;2", ';') == ';');
    CHECK (separatorOf ("1.000,5;2") == ',');
    CHECK (separatorOf ("1,2", ';') == ',');
    CHECK (separatorOf ("1;2", ',') == ';');
}

TEST_CASE ("a decimal comma is the only comma of a field without a point", "[file][csv]")
{
    CHECK (withPoint ("1,5") == "1.5");
    CHECK (withPoint ("-,5e3") == "-.5e3");
    CHECK (withPoint ("1,000,5") == "1,000,5");
    CHECK (withPoint ("1.000,5") == "1.000,5");
    CHECK (withPoint ("15") == "15");
    CHECK (withPoint ("").empty());
}
