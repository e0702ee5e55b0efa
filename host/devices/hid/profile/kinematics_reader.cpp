// SPDX-License-Identifier: MIT
#include "kinematics_reader.hpp"

#include <Eigen/LU>

#include <utility>

namespace tactus::host::hid
{
namespace
{
/// An axis such as "-x" as a row of a matrix; zero if it is not an axis.
Vec3 directionOf (std::string_view text)
{
    const bool back = text.starts_with ('-');
    if (back) text.remove_prefix (1);
    Vec3 row = Vec3::Zero();
    if (text == "x" || text == "y" || text == "z") row[text.front() - 'x'] = back ? -1.0 : 1.0;
    return row;
}

/// Reads three rows, each of which is three numbers or a string for directionOf. Empty for anything else.
std::optional<Mat3> matrixOf (const Json& json)
{
    if (! json.is_array() || json.size() != 3) return {};
    Mat3 m = Mat3::Zero();
    for (int row = 0; row < 3; ++row)
    {
        const auto& entry = json[static_cast<std::size_t> (row)];
        if (entry.is_string())
        {
            m.row (row) = directionOf (entry.get<std::string>()).transpose();
            continue;
        }
        if (! entry.is_array() || entry.size() != 3) return {};
        for (int column = 0; column < 3; ++column)
        {
            const auto& number = entry[static_cast<std::size_t> (column)];
            if (! number.is_number() || ! isFinite (number.get<double>())) return {};
            m (row, column) = number.get<double>();
        }
    }
    return m;
}

Drive readDrive (ProfileFields& in)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    Drive d;
    in.require ("counts_per_turn", "give the \"counts_per_turn\" of the motor's encoder; negative if it counts in the opposite direction to the motor");
    d.counts_per_turn = in.number ("counts_per_turn", unit::count, {}, 1.0);
    const double capstan = in.number ("capstan", unit::metre, Bounds::positive(), 1.0);
    const double body = in.number ("body", unit::metre, Bounds::positive(), 1.0);
    if (in.has ("capstan") != in.has ("body"))
        in.error ("capstan", "profile/missing", "capstan and body must be given together",
                  "write the diameters of both, or neither if the motor turns the joint directly");
    d.ratio = (in.flag ("reversed") ? -1.0 : 1.0) * capstan / body;
    d.offset = in.number ("offset", unit::radian, {}, 0.0);
    d.torque_constant = in.number ("torque_constant", unit::count, {}, 1.0);   // N m/A
    d.max_current = in.number ("max_current", unit::count, Bounds::positive(), none);
    if (d.counts_per_turn == 0.0)
        in.error ("counts_per_turn", "profile/out_of_range", "the encoder has 0 counts per turn", "write the encoder's counts per turn of the motor");
    if (d.torque_constant == 0.0)
        in.error ("torque_constant", "profile/out_of_range", "the torque constant is 0", "write the motor's torque per current, in N m/A");
    return d;
}

template <std::size_t n>
void readDrives (ProfileFields& in, std::array<Drive, n>& drives)
{
    std::size_t read = 0;
    in.each ("drives", [&] (ProfileFields& d) {
        const auto drive = readDrive (d);
        if (read < n) drives[read] = drive;
        ++read;
    });
    if (read != n)
        in.error ("drives", "profile/kinematics", "there are " + std::to_string (read) + " drives; this mechanism has " + std::to_string (n),
                  "list one drive for each motor");
}

/// Reads link lengths, all above 0.
template <std::size_t n>
std::array<double, n> readLinks (ProfileFields& in, std::string_view remedy)
{
    std::array<double, n> links;
    links.fill (1.0);
    const auto numbers = in.numbers ("links");
    bool good = numbers.size() == n;
    for (std::size_t i = 0; good && i < n; ++i)
    {
        links[i] = numbers[i];
        good = links[i] > 0.0;
    }
    if (! good) in.error ("links", "profile/kinematics", "the links must be " + std::to_string (n) + " lengths in m, above 0", std::string (remedy));
    return links;
}

SerialArm readSerial (ProfileFields& in)
{
    SerialArm arm;
    readDrives (in, arm.drives);
    const auto links = readLinks<3> (in, "write [column, upper, lower]");
    arm.links = { links[0], links[1], links[2] };
    arm.origin = in.vector ("origin", unit::metre, arm.origin);
    return arm;
}

FiveBar readFiveBar (ProfileFields& in)
{
    FiveBar bar;
    readDrives (in, bar.drives);
    bar.links = readLinks<4> (in, "write [right driven, right passive, left passive, left driven]");
    bar.base = in.number ("base", unit::metre, Bounds::notNegative(), 0.0);
    bar.origin = in.vector ("origin", unit::metre, bar.origin);
    return bar;
}

LinearMap readLinear (ProfileFields& in)
{
    LinearMap map;
    in.require ("matrix", "write three rows of three numbers: p = matrix q + origin");
    const auto matrix = matrixOf (in.object ("matrix"));
    if (matrix)
        map.matrix = *matrix;
    else if (in.has ("matrix"))
        in.error ("matrix", "profile/kinematics", "the matrix must be three rows of three numbers",
                  "write three rows, such as [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
    map.origin = in.vector ("origin", unit::metre, map.origin);
    return map;
}
}   // namespace

std::optional<Mat3> axesOf (const Json& json)
{
    auto m = matrixOf (json);
    if (m && ! ((*m * m->transpose() - Mat3::Identity()).norm() < 1e-9)) m.reset();
    return m;
}

Mat3 readAxes (ProfileFields& in)
{
    const Json& json = in.object ("axes");
    if (! in.has ("axes")) return Mat3::Identity();

    const auto m = axesOf (json);
    const auto remedy = "write which axis points right, away and up, such as [\"y\", \"-x\", \"z\"]; for a left-handed device negate the scale of one field";
    if (m && m->determinant() > 0.0) return *m;
    in.error ("axes", "profile/axes",
              matrixOf (json) ? "the axes are not right-handed, of length 1 and perpendicular" : "axes must list three axes or three rows of numbers", remedy);
    return Mat3::Identity();
}

KinematicsModel readKinematics (ProfileFields& profile)
{
    KinematicsModel model;
    profile.within ("kinematics",
                    [&] (ProfileFields& in) {
                        int kinds = 0;
                        const auto take = [&] (std::string_view kind, auto read) {
                            in.within (kind,
                                       [&] (ProfileFields& k) {
                                           ++kinds;
                                           model = read (k);
                                       });
                        };
                        take ("linear", readLinear);
                        take ("serial", readSerial);
                        take ("five_bar", readFiveBar);
                        if (kinds != 1)
                            profile.error ("kinematics", "profile/kinematics", "kinematics must be one of linear, serial and five_bar",
                                           "write {\"serial\": { … }}");
                    });
    return model;
}

}   // namespace tactus::host::hid
