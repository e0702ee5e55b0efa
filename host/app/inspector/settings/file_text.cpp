// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_text.hpp"

#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/kit/signal/clip_score.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
std::string shortText (double v) { return numberText (rounded (v)); }

FileText describe (const Signal& s)
{
    const auto n = s.channels.empty() ? std::size_t {} : s.channels.front().size();
    const auto text = s.channels.size() == 1 ? TRANS ("%1 channel, %2 s at %3 Hz") : TRANS ("%1 channels, %2 s at %3 Hz");
    return { filled (text, s.channels.size(), shortText (static_cast<double> (n) / s.rate_hz), numberText (s.rate_hz)).toStdString() };
}

FileText describe (const Mesh& m)
{
    Vec3 low = Vec3::Constant (INFINITY), high = -low;
    for (const auto& p : m.points)
    {
        low = low.cwiseMin (p);
        high = high.cwiseMax (p);
    }
    const Vec3 size = high - low;
    const std::string times = " \xc3\x97 ";
    const auto extent = shortText (size.x()) + times + shortText (size.y()) + times + shortText (size.z());
    auto text = filled (TRANS ("%1 vertices, %2 triangles, %3 units"), m.points.size(), m.triangles.size(), extent);
    constexpr double longest = 5.0;   // m, of what a hand feels
    if (size.maxCoeff() > longest) text << ". " << TRANS ("A unit is as long as Scale: 1 mm for a mesh in millimetres");
    return { text.toStdString() };
}

template <typename T, typename F>
FileText read (const Assets::Loaded<T>& loaded, F&& f)
{
    if (! loaded) return FileText { sentence (loaded.error()), true };
    return f (*loaded);
}
}   // namespace

FileText describeFile (const std::string& written, SettingSheet::Kind kind, const std::string& folder, Assets& assets)
{
    if (written.empty()) return { TRANS ("No file. Drop one here, or browse.").toStdString() };
    const auto path = resolved (written, folder);
    switch (kind)
    {
    case SettingSheet::Kind::signal:
        return read (assets.signal (path), [] (const auto& s) { return describe (*s); });
    case SettingSheet::Kind::image:
        return read (assets.image (path),
                     [] (const auto& g) {
                         const auto extent = std::to_string (g->columns) + " \xc3\x97 " + std::to_string (g->rows);
                         return FileText { filled (TRANS ("%1 pixels"), extent).toStdString(), false, g };
                     });
    case SettingSheet::Kind::table:
        return read (assets.table (path),
                     [] (const auto& g) {
                         const auto made = clipOf (*g);
                         if (! made.problem.empty() || g->values.empty())
                             return FileText { filled (TRANS ("%1 rows of %2 numbers"), g->rows, g->columns).toStdString() };
                         const auto tracks = made.clip.tracks.size();
                         const auto text = tracks == 1 ? TRANS ("%1 s long, %2 track") : TRANS ("%1 s long, %2 tracks");
                         return FileText { filled (text, shortText (ClipScore (made.clip).duration()), tracks).toStdString() };
                     });
    default:
        return read (assets.mesh (path), [] (const auto& m) { return describe (*m); });
    }
}

}   // namespace tactus::host
