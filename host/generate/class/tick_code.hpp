// SPDX-License-Identifier: MIT
#pragma once

#include "plan_names.hpp"

#include <span>
#include <string>

namespace tactus::host
{

/// Writes what the records of a plan do in one tick.
class TickCode
{
public:
    explicit TickCode (PlanNames& w) : wiring (w) {}

    /// The statements of a tick, in running order.
    std::string write();

private:
    void records (std::span<const Record>, const std::string& indent, const std::string& ticks);
    void record (const Record&, const std::string& indent, const std::string& ticks);
    void node (const ExportedNode&, const Record&, const std::string& indent);
    void driven (const ExportedNode&, const plan::DrivenNode&, const std::string& indent);
    void bypass (const plan::Bypass&, const double* const* sources, const std::string& indent);
    void every (const ExportedSection&, const std::string& indent, const std::string& ticks);
    void times (const ExportedSection&, const std::string& indent, const std::string& ticks);
    std::vector<std::string> inputs (const ExportedNode&, const std::string& driven, const std::string& indent);
    std::string sumOf (const plan::Sum&);
    std::string parameter (const plan::DrivenNode::Drive&, const ExportedNode&, std::string& stored);
    void each (const std::vector<plan::ConversionLink>&, const std::string& indent, std::string (*call) (const std::string& object, const std::string& from));
    void line (const std::string& indent, const std::string& text) { code += indent + text + "\n"; }

    PlanNames& wiring;
    std::string code;
};

}   // namespace tactus::host
