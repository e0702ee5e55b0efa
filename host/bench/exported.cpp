// SPDX-License-Identifier: GPL-3.0-or-later
#include "exported.hpp"

#include "exported/exported_code.hpp"

namespace tactus::bench
{

namespace
{
class ExportedReference final : public Variant
{
public:
    void tick (const double* in) noexcept override { graph.tick (in); }

    std::vector<double> outputs() const override
    {
        std::vector<double> force (3);
        graph.forceOf (force.data());
        return force;
    }

private:
    exported_code::Reference graph;
};

class ExportedChain final : public Variant
{
public:
    void tick (const double* in) noexcept override { graph.tick (*in); }
    std::vector<double> outputs() const override { return { graph.out() }; }

private:
    exported_code::Chain graph;
};
}   // namespace

std::unique_ptr<Variant> exportedReference() { return std::make_unique<ExportedReference>(); }
std::unique_ptr<Variant> exportedChain() { return std::make_unique<ExportedChain>(); }

}   // namespace tactus::bench
