// SPDX-License-Identifier: GPL-3.0-or-later
#include <chain100.hpp>   // written by `tactus export` during the build, with its own node headers

#undef tactus   // which is another name in this code, so that these headers do not clash with those of the project
#include "../variant.hpp"

namespace tactus::bench
{

namespace
{
class ExportedChain final : public Variant
{
public:
    ExportedChain() { graph.prepare(); }

    void tick (const double* in) noexcept override { graph.tick ({ .p0_in = *in }, out); }
    std::vector<double> outputs() const override { return { out.p99_out }; }

private:
    Chain100 graph {};
    Chain100::Outputs out {};
};
}   // namespace

std::unique_ptr<Variant> exportedChain() { return std::make_unique<ExportedChain>(); }

}   // namespace tactus::bench
