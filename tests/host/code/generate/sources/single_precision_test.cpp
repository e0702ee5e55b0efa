// SPDX-License-Identifier: MIT

#include <host/code/generate/sources/single_precision.hpp>

#include <catch2/catch.hpp>

using tactus::host::inSinglePrecision;

TEST_CASE ("code in single precision has float and f", "[export]")
{
    CHECK (inSinglePrecision ("double x = 0.5 * y;") == "float x = 0.5f * y;");
    CHECK (inSinglePrecision ("std::array<double, 3> a { 1, 2.0, .5 };") == "std::array<float, 3> a { 1, 2.0f, .5f };");
    CHECK (inSinglePrecision ("1e-9 + 0x1p-3 + 0xff + 0x1f + 1'000.5 - 3u + 2.5f") == "1e-9f + 0x1p-3f + 0xff + 0x1f + 1'000.5f - 3u + 2.5f");
    CHECK (inSinglePrecision ("2.0 * std::numbers::pi") == "2.0f * std::numbers::pi_v<float>");
    CHECK (inSinglePrecision ("Eigen::Vector3d v; Eigen::Matrix3d m;") == "Eigen::Vector3f v; Eigen::Matrix3f m;");
    CHECK (inSinglePrecision ("doubled (x.y, v1.x)") == "doubled (x.y, v1.x)");
}

TEST_CASE ("comments, texts and includes keep their doubles", "[export]")
{
    CHECK (inSinglePrecision ("// a double of 0.5\ndouble a;") == "// a double of 0.5\nfloat a;");
    CHECK (inSinglePrecision ("/* double */ double a;") == "/* double */ float a;");
    CHECK (inSinglePrecision ("\"double 0.5 \\\" 1.5\" 1.5 '\"' 2.5") == "\"double 0.5 \\\" 1.5\" 1.5f '\"' 2.5f");
    CHECK (inSinglePrecision ("#include <tactus/double.hpp>\ndouble a;") == "#include <tactus/double.hpp>\nfloat a;");
}

TEST_CASE ("numbers beyond the range of float are found, or become bounds of its range", "[export]")
{
    CHECK (inSinglePrecision ("x > 1e-280 && x < 1e280") == "x > 1e-35f && x < 1e35f");
    std::vector<std::string> outside;
    CHECK (inSinglePrecision ("a (1e300, 0.0, 1e30, 1e-50)", &outside) == "a (0.0f, 0.0f, 1e30f, 0.0f)");
    CHECK (outside == std::vector<std::string> { "1e300", "1e-50" });
}
