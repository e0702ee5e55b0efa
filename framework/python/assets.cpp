// SPDX-License-Identifier: MIT
#include "assets.hpp"

#include <pybind11/numpy.h>

#include <utility>

namespace tactus::python
{

namespace
{
const char* nameOf (tactus_asset_kind kind)
{
    switch (kind)
    {
    case TACTUS_ASSET_SIGNAL:
        return "signal";
    case TACTUS_ASSET_IMAGE:
        return "image";
    case TACTUS_ASSET_TABLE:
        return "table";
    case TACTUS_ASSET_MESH:
        return "mesh";
    }
    return "";
}

/// An array of the answer, which tactus/_assets.py has brought into this form.
template <typename T>
py::array_t<T, py::array::c_style> arrayIn (const py::dict& answer, const char* key)
{
    return answer[key].cast<py::array_t<T, py::array::c_style>>();
}
}   // namespace

void PythonAssets::release()
{
    if (! latest) return;
    const py::gil_scoped_acquire gil;
    latest = py::object();
}

void PythonAssets::raiseFailure()
{
    if (failure) std::rethrow_exception (std::exchange (failure, nullptr));
}

tactus_asset_answer PythonAssets::read (void* context, tactus_asset_kind kind, const char* path, tactus_asset* asset) noexcept
{
    auto& mine = *static_cast<PythonAssets*> (context);
    const py::gil_scoped_acquire gil;
    try
    {
        return mine.ask (kind, path, *asset);
    }
    catch (...)
    {
        if (! mine.failure) mine.failure = std::current_exception();
    }
    asset->problem = "the Python program has raised an exception";
    return TACTUS_ASSET_REFUSED;
}

tactus_asset_answer PythonAssets::ask (tactus_asset_kind kind, const char* path, tactus_asset& asset)
{
    latest = function (nameOf (kind), path);
    if (latest.is_none()) return TACTUS_ASSET_FROM_FILE;
    const auto answer = latest.cast<py::dict>();
    const auto count = [] (const py::array& a, int axis) { return static_cast<std::size_t> (a.shape (axis)); };
    if (kind == TACTUS_ASSET_MESH)
    {
        const auto points = arrayIn<double> (answer, "points");
        const auto triangles = arrayIn<std::int32_t> (answer, "triangles");
        asset.points = points.data();
        asset.point_count = count (points, 0);
        asset.triangles = triangles.data();
        asset.triangle_count = count (triangles, 0);
        return TACTUS_ASSET_SUPPLIED;
    }
    const auto values = arrayIn<double> (answer, "values");
    asset.rows = count (values, 0);
    asset.columns = count (values, 1);
    asset.values = values.data();
    asset.rate_hz = answer["rate"].cast<double>();
    return TACTUS_ASSET_SUPPLIED;
}

}   // namespace tactus::python
