// SPDX-License-Identifier: GPL-3.0-or-later
#include <padded_bench.hpp>   // written by `tactus export` during the build, with its own node headers

#undef tactus   // which is another name in this code, so that these headers do not clash with those of the project
#include "../variant.hpp"

namespace tactus::bench
{

namespace
{
class ExportedReference final : public Variant
{
public:
    ExportedReference() { graph.prepare(); }

    void tick (const double* position) noexcept override
    {
        in.stylus.position = { position[0], position[1], position[2] };
        graph.tick (in, out);
    }

    std::vector<double> outputs() const override { return { out.stylus.force[0], out.stylus.force[1], out.stylus.force[2] }; }

private:
    PaddedBench graph {};
    PaddedBench::Inputs in {};
    PaddedBench::Outputs out {};
};
}   // namespace

std::unique_ptr<Variant> exportedReference() { return std::make_unique<ExportedReference>(); }

}   // namespace tactus::bench
